//! A program: its faults, its circuits, its tests and its claims, and the verdicts on these.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use super::written::WrittenProgram;
#[cfg(test)]
use crate::request::TestLevel;
use nbc_base::budget::Limit;
use nbc_base::diag::{Diagnostic, Label, Severity};
use nbc_base::model::{Claim, Column, Property, Value};
use nbc_base::source::Sources;
use nbc_session::{ClaimReport, PropertyReport};
use nbc_swarm::{Level, RowVerdict, TestVerdict};

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

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct Finding {
    code: String,
    #[cfg_attr(test, ts(type = "\"error\" | \"warning\""))]
    severity: Severity,
    message: String,
    help: Option<String>,
    /// The main one first.
    labels: Vec<FindingLabel>,
    /// Notes at other places.
    related: Vec<FindingLabel>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct FindingLabel {
    file: String,
    start: TextPlace,
    end: TextPlace,
    text: String,
}

/// A place in a text: its byte from 0, its line and column from 1.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct TextPlace {
    byte: u32,
    line: usize,
    column: usize,
}

pub(crate) fn findings(diagnostics: &[Diagnostic], sources: &Sources) -> Vec<Finding> {
    let labels = |labels: &[Label]| labels.iter().map(|one| label(one, sources)).collect();
    let finding = |one: &Diagnostic| Finding {
        code: one.code.to_string(),
        severity: one.severity,
        message: one.message.clone(),
        help: one.help.clone(),
        labels: labels(&one.labels),
        related: labels(&one.related),
    };
    diagnostics.iter().map(finding).collect()
}

fn label(label: &Label, sources: &Sources) -> FindingLabel {
    let file = sources.file(label.span.file);
    let place = |byte: u32| {
        let at = file.line_column(byte as usize);
        TextPlace { byte, line: at.line, column: at.column }
    };
    FindingLabel {
        file: file.name.clone(),
        start: place(label.span.start),
        end: place(label.span.end),
        text: label.text.clone(),
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClaimEntry {
    index: usize,
    circuit: String,
    title: String,
    line: usize,
    properties: Vec<PropertyEntry>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct PropertyEntry {
    property: String,
    line: usize,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ClaimAnswer {
    properties: Vec<PropertyAnswer>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct PropertyAnswer {
    #[cfg_attr(test, ts(type = "\"proved\" | \"refuted\" | \"undecided\""))]
    verdict: &'static str,
    /// What the verdict is based on, in words.
    how: String,
    /// The test that refutes it, as text.
    test: Option<String>,
}

impl ClaimEntry {
    pub(crate) fn of(index: usize, claim: &Claim) -> Self {
        let property = |one: &Property| PropertyEntry { property: one.text.clone(), line: one.line };
        Self {
            index,
            circuit: claim.circuit.to_string(),
            title: claim.title.clone(),
            line: claim.line,
            properties: claim.wanted().map(property).collect(),
        }
    }
}

impl From<&ClaimReport> for ClaimAnswer {
    fn from(report: &ClaimReport) -> Self {
        let answer = |known: &PropertyReport| {
            let (verdict, how, test) = (known.verdict, known.how(), known.test.clone());
            PropertyAnswer { verdict, how, test }
        };
        Self { properties: report.properties().iter().map(answer).collect() }
    }
}

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
    #[cfg_attr(test, ts(as = "TestLevel"))]
    level: Level,
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
            level: verdict.level,
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
