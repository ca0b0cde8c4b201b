//! What is known of claims, as text and as data.

use std::fmt::Write;

use serde::Serialize;

use crate::claims::DecidedClaim;
use crate::property_report::PropertyReport;
use crate::swarm_run::RunEnd;
use crate::test::TestRun;
use nbc_base::model::{CircuitTest, Property, PropertyKind, Stimulation, TestRow};
use nbc_base::source::Sources;
use nbc_circuit::formats::AigerModel;
use nbc_circuit::properties::{EmptyProof, PropertySearch};
use nbc_lang::syntax;

/// A claim, or the properties of a model.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClaimReport {
    file: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    circuit: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    title: Option<String>,
    properties: Vec<PropertyReport>,
    /// Calls of the solver plus learned clauses.
    work: u64,
}

impl ClaimReport {
    pub fn of(decided: &DecidedClaim) -> Self {
        let DecidedClaim { claim, system, verdicts, empty, tests, work } = decided;
        let known = claim.wanted().zip(verdicts).zip(tests).enumerate();
        let properties = known.map(|(number, ((property, verdict), test))| PropertyReport {
            line: Some(property.line),
            test: test.as_ref().map(text_of_test),
            empty: empty[number].map(|why| why_empty(why, property, &claim.properties)),
            ..PropertyReport::of(system, number, property.text.clone(), verdict)
        });
        Self {
            file: claim.file.clone(),
            line: Some(claim.line),
            circuit: Some(claim.circuit.to_string()),
            title: Some(claim.title.clone()).filter(|title| !title.is_empty()),
            properties: properties.collect(),
            work: *work,
        }
    }

    pub fn of_model(file: &str, model: &AigerModel, search: &PropertySearch) -> Self {
        let verdicts = search.verdicts();
        let known = model.properties.iter().zip(&verdicts).enumerate();
        let properties = known.map(|(number, (name, verdict))| PropertyReport {
            empty: search.empty_proof(number).map(|_| "no step satisfies the constraints".to_owned()),
            witness: Some(model.witness(number, verdict)),
            ..PropertyReport::of(&model.system, number, name.clone(), verdict)
        });
        let (line, circuit, title) = (None, None, None);
        Self { file: file.to_owned(), line, circuit, title, properties: properties.collect(), work: search.work() }
    }

    /// Notes whether robots did the same in the test that refutes a property.
    pub fn note_runs(&mut self, property: usize, runs: &[TestRun]) {
        let is_same = runs.iter().all(|run| run.verdict.passed && run.end == RunEnd::Complete);
        self.properties[property].physics = Some(is_same);
    }

    pub fn properties(&self) -> &[PropertyReport] {
        &self.properties
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

fn why_empty(why: EmptyProof, property: &Property, all: &[Property]) -> String {
    let is_assumed = all.iter().any(|other| other.kind == PropertyKind::Assume);
    let under = if is_assumed { " under the assumptions" } else { "" };
    match why {
        EmptyProof::NoStep => "no step satisfies the assumptions".to_owned(),
        EmptyProof::NeverChecked if property.has_condition => format!("its condition is never true{under}"),
        EmptyProof::NeverChecked => format!("no run is long enough{under}"),
    }
}

fn text_of_test(test: &CircuitTest) -> String {
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
