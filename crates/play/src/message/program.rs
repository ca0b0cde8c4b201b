//! A program: its faults, its circuits and its tests.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use super::claim::ClaimEntry;
use super::finding::Finding;
use super::written::WrittenProgram;
use nbc_base::model::Column;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ProgramReport {
    pub(crate) errors: usize,
    pub(crate) diagnostics: Vec<Finding>,
    pub(crate) circuits: Vec<CircuitEntry>,
    pub(crate) tests: Vec<TestEntry>,
    pub(crate) claims: Vec<ClaimEntry>,
    pub(crate) written: WrittenProgram,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct CircuitEntry {
    pub(crate) name: String,
    /// What `compile` takes, such as `adder[8]`.
    pub(crate) circuit: String,
    pub(crate) swarms: Vec<String>,
    pub(crate) line: usize,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct TestEntry {
    pub(crate) index: usize,
    pub(crate) circuit: String,
    pub(crate) title: String,
    pub(crate) line: usize,
    /// Whether it is decided for ever, at the level of logic alone.
    pub(crate) ever: bool,
    pub(crate) inputs: Vec<PortEntry>,
    pub(crate) outputs: Vec<PortEntry>,
    /// What it gives to its circuit, in words: `all inputs`, `for ever`, or the number of rows.
    pub(crate) extent: String,
    /// The first rows. None if they are found only when the test runs.
    pub(crate) rows: Vec<TestRowEntry>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct TestRowEntry {
    pub(crate) row: usize,
    pub(crate) line: usize,
    pub(crate) inputs: Vec<String>,
    pub(crate) outputs: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct PortEntry {
    pub(crate) name: String,
    pub(crate) width: usize,
    /// The members of its enumeration, each with its name and its digits.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(test, ts(optional))]
    pub(crate) members: Option<Vec<[String; 2]>>,
}

impl PortEntry {
    pub(crate) fn of(columns: &[Column]) -> Vec<Self> {
        let one = |Column { name, width, members, .. }: &Column| {
            let digits = |value: u128| format!("{value:0width$b}", width = *width);
            let members = members.as_ref().map(|known| &known.members);
            let members = members.map(|all| all.iter().map(|one| [one.name.clone(), digits(one.value)]).collect());
            Self { name: name.clone(), width: *width, members }
        };
        columns.iter().map(one).collect()
    }
}
