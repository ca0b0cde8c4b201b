//! A program: its faults, its circuits, its tests and its claims, and the verdicts on these.

use serde::Serialize;

use super::written::WrittenProgram;
use nbc_base::budget::Limit;
use nbc_base::diag::Finding;
use nbc_base::model::{Claim, Column};
use nbc_swarm::TestVerdict;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ProgramReport {
    pub(crate) errors: usize,
    pub(crate) diagnostics: Vec<Finding>,
    pub(crate) circuits: Vec<CircuitEntry>,
    pub(crate) tests: Vec<TestEntry>,
    pub(crate) claims: Vec<Claim>,
    pub(crate) written: WrittenProgram,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct CircuitEntry {
    pub(crate) name: String,
    /// What `compile` takes, such as `adder[8]`.
    pub(crate) circuit: String,
    pub(crate) swarms: Vec<String>,
    pub(crate) line: usize,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct TestEntry {
    pub(crate) index: usize,
    pub(crate) circuit: String,
    pub(crate) title: String,
    pub(crate) line: usize,
    /// Whether it is decided for ever, at the level of logic alone.
    pub(crate) ever: bool,
    pub(crate) inputs: Vec<Column>,
    pub(crate) outputs: Vec<Column>,
    /// What it gives to its circuit, in words: `all inputs`, `for ever`, or the number of rows.
    pub(crate) extent: String,
    /// The first rows. None if they are found only when the test runs.
    pub(crate) rows: Vec<TestRowEntry>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct TestRowEntry {
    pub(crate) row: usize,
    pub(crate) line: usize,
    pub(crate) inputs: Vec<String>,
    pub(crate) outputs: Vec<String>,
}

/// A result for each swarm of its circuit in each world of the test.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct TestAnswer {
    pub(crate) results: Vec<TestVerdict>,
}

/// The most rows of a test with these ports that a page gets.
pub(crate) fn listed(inputs: &[Column], outputs: &[Column]) -> usize {
    let bits: usize = inputs.iter().chain(outputs).map(|port| port.width).sum();
    (Limit::PageRows.most().min(Limit::PageRowBits.most() / (bits as u64).max(1))) as usize
}
