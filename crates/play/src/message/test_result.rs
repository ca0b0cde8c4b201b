//! The verdict of a test, as far as a page shows it.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use super::program::PortEntry;
use crate::request::TestLevel;
use nbc_base::budget::Limit;
use nbc_base::model::{Column, Value};
use nbc_swarm::{RowVerdict, TestVerdict};

/// A result for each swarm of its circuit in each world of the test.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct TestAnswer {
    pub(crate) results: Vec<TestResult>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct TestResult {
    circuit: String,
    title: String,
    swarm: Option<String>,
    /// The world of the swarm; none at the level of logic.
    world: Option<String>,
    fault: Option<String>,
    level: TestLevel,
    passed: bool,
    line: usize,
    inputs: Vec<PortEntry>,
    outputs: Vec<PortEntry>,
    rows: Vec<RowResult>,
    printed: Option<String>,
    /// How a test for ever was decided, in words.
    proof: Option<String>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct RowResult {
    /// Its number, from 1; both halves of a pulse have the same.
    row: usize,
    line: usize,
    /// The thread of a wave machine, from 0.
    thread: Option<usize>,
    inputs: Vec<RowValue>,
    expected: Vec<RowValue>,
    observed: Vec<RowValue>,
    passed: bool,
    /// Cycles for which the row was held; none at the level of logic.
    cycles: Option<usize>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct RowValue {
    /// The digits `0`, `1` and `-`.
    bits: String,
    /// As the user writes it.
    text: String,
}

/// The most rows of a test with these ports that a page gets.
pub(crate) fn listed(inputs: &[Column], outputs: &[Column]) -> usize {
    let bits: usize = inputs.iter().chain(outputs).map(|port| port.width).sum();
    (Limit::PageRows.most().min(Limit::PageRowBits.most() / (bits as u64).max(1))) as usize
}

impl From<&TestVerdict> for TestResult {
    fn from(verdict: &TestVerdict) -> Self {
        Self {
            circuit: verdict.circuit.clone(),
            title: verdict.title.clone(),
            swarm: verdict.swarm.clone(),
            world: verdict.world.clone(),
            fault: verdict.fault().map(ToString::to_string),
            level: verdict.level.into(),
            passed: verdict.passed,
            line: verdict.line,
            inputs: PortEntry::of(&verdict.inputs),
            outputs: PortEntry::of(&verdict.outputs),
            rows: verdict.rows.iter().take(listed(&verdict.inputs, &verdict.outputs)).map(RowResult::from).collect(),
            printed: verdict.printed.clone(),
            proof: verdict.proof.clone(),
        }
    }
}

impl From<&RowVerdict> for RowResult {
    fn from(verdict: &RowVerdict) -> Self {
        let values = |values: &[Value]| {
            values.iter().map(|value| RowValue { bits: value.digits(), text: value.to_string() }).collect()
        };
        Self {
            row: verdict.row,
            line: verdict.line,
            thread: verdict.thread,
            inputs: values(&verdict.inputs),
            expected: values(&verdict.expected),
            observed: values(&verdict.observed),
            passed: verdict.passed,
            cycles: verdict.cycles,
        }
    }
}
