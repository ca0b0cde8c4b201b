//! A decided claim, and its text.

use std::fmt::Write;

use serde::Serialize;

use crate::decided_property::DecidedProperty;
use crate::swarm_run::RunEnd;
use crate::test::TestRun;
use nbc_base::model::{CircuitTest, Stimulation, TestRow};
use nbc_base::source::Sources;
use nbc_lang::syntax;

/// A claim, or the properties of a model, with a verdict on each property except assumptions.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DecidedClaim {
    pub file: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub circuit: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    pub properties: Vec<DecidedProperty>,
    /// Calls of the solver plus learned clauses.
    pub work: u64,
}

impl DecidedClaim {
    /// The tests that refute properties, with the numbers of these.
    pub fn refuted(&self) -> impl Iterator<Item = (usize, &CircuitTest)> {
        self.properties.iter().enumerate().filter_map(|(number, property)| Some((number, property.shown.as_ref()?)))
    }

    /// Notes whether robots did the same in the test that refutes a property.
    pub fn note_runs(&mut self, property: usize, runs: &[TestRun]) {
        let is_same = runs.iter().all(|run| run.verdict.passed && run.end == RunEnd::Complete);
        self.properties[property].physics = Some(is_same);
    }

    pub fn count(&self, verdict: &str) -> usize {
        self.properties.iter().filter(|property| property.verdict == verdict).count()
    }

    pub fn witnesses(&self) -> String {
        self.properties.iter().filter_map(|property| property.witness.as_deref()).collect()
    }

    pub fn text(&self) -> String {
        let mut text = match (&self.circuit, &self.title) {
            (Some(circuit), Some(title)) => format!("{circuit} \"{title}\"\n"),
            (Some(circuit), None) => format!("{circuit}\n"),
            (None, _) => format!("{}\n", self.file),
        };
        self.properties.iter().for_each(|property| text += &property.text());
        text
    }
}

pub(super) fn text_of_test(test: &CircuitTest) -> String {
    let Stimulation::Rows(rows) = &test.stimulation else { unreachable!("a run has rows") };
    let ports = |columns: &[nbc_base::model::Column]| {
        columns.iter().map(|column| column.name.clone()).collect::<Vec<_>>().join(" ")
    };
    let title = test.title.replace('"', "'");
    let mut text =
        format!("test {} \"{title}\" {{\n{} | {}\n", test.circuit, ports(&test.inputs), ports(&test.outputs));
    for (at, row) in rows.iter().enumerate().filter(|(_, row)| !row.is_half) {
        let half = at.checked_sub(1).map(|at| &rows[at]).filter(|before| before.is_half);
        let inputs = input_words(test, row, half);
        let outputs = row.output_values(&test.inputs, &test.outputs, row.expected.iter().copied());
        let outputs: Vec<String> = outputs.iter().map(ToString::to_string).collect();
        let _ = writeln!(text, "{} | {}", inputs.join(" "), outputs.join(" "));
    }
    text += "}\n";
    let mut sources = Sources::default();
    let file = sources.add("shown.nb", text);
    let parsed = syntax::parse(&sources, file);
    assert_eq!(parsed.errors, [], "a test that is written can be read");
    syntax::format(&sources, file, &parsed.tree)
}

/// `^` stands for a bit that is 0 in the first half of its row.
fn input_words(test: &CircuitTest, row: &TestRow, half: Option<&TestRow>) -> Vec<String> {
    let mut first = 0;
    let values = row.input_values(&test.inputs);
    let word = |(column, value): (&nbc_base::model::Column, &nbc_base::model::Value)| {
        let at = first;
        first += column.width;
        let rises = half.is_some_and(|half| column.width == 1 && row.inputs[at] && !half.inputs[at]);
        if rises { "^".to_owned() } else { value.to_string() }
    };
    test.inputs.iter().zip(&values).map(word).collect()
}
