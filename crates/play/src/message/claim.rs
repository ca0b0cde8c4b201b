//! What is claimed of the circuits of a program, and what is known of it.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use nbc_base::model::Claim;
use nbc_session::{ClaimReport, PropertyReport};

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
        let property = |one: &nbc_base::model::Property| PropertyEntry { property: one.text.clone(), line: one.line };
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
