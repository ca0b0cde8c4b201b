//! What is known of claims, as text and as data.

use std::fmt::Write;

use serde::Serialize;

use crate::claims::DecidedClaim;
use nbc_base::diag::counted;
use nbc_base::model::{CircuitTest, Stimulation, TestRow};
use nbc_base::source::Sources;
use nbc_circuit::formats::AigerModel;
use nbc_circuit::properties::{InductiveProof, PropertyVerdict, TransitionSystem};
use nbc_lang::syntax;

/// A claim, or the properties of a model.
#[derive(Clone, Debug, Serialize)]
pub struct ClaimReport {
    /// The file.
    file: String,
    /// The line of the claim.
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    /// The circuit.
    #[serde(skip_serializing_if = "Option::is_none")]
    circuit: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    title: Option<String>,
    properties: Vec<PropertyReport>,
    /// Calls of the solver, and clauses that it learned.
    work: u64,
}

/// A property and what is known of it.
#[derive(Clone, Debug, Serialize)]
struct PropertyReport {
    property: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    /// `proved`, `refuted` or `undecided`.
    verdict: &'static str,
    /// `induction` or `invariant`.
    #[serde(skip_serializing_if = "Option::is_none")]
    method: Option<&'static str>,
    /// The steps of an induction or of a run, or the first steps in which it is known to hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    steps: Option<usize>,
    /// The clauses of the invariant.
    #[serde(skip_serializing_if = "Option::is_none")]
    invariant: Option<Vec<String>>,
    /// The properties without which this proof does not hold, as their numbers, counted from 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    with: Vec<usize>,
    /// A test that shows it, as text.
    #[serde(skip_serializing_if = "Option::is_none")]
    test: Option<String>,
    /// A witness in AIGER's format.
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<String>,
    /// Whether robots do the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    physics: Option<bool>,
}

impl PropertyReport {
    fn of(system: &TransitionSystem, number: usize, property: String, verdict: &PropertyVerdict) -> Self {
        let mut report = Self {
            property,
            line: None,
            verdict: "proved",
            method: None,
            steps: None,
            invariant: None,
            with: Vec::new(),
            test: None,
            witness: None,
            physics: None,
        };
        match verdict {
            PropertyVerdict::Proved(InductiveProof::Steps { steps, together }) => {
                (report.method, report.steps) = (Some("induction"), Some(*steps));
                report.with = together.iter().copied().filter(|&other| other != number).collect();
            }
            PropertyVerdict::Proved(InductiveProof::Invariant { clauses, given }) => {
                let clause = |clause: &Vec<(usize, bool)>| {
                    let literal = |&(at, value): &(usize, bool)| {
                        let name = &system.registers[at].name;
                        if value { name.clone() } else { format!("not {name}") }
                    };
                    clause.iter().map(literal).collect::<Vec<_>>().join(" or ")
                };
                (report.method, report.invariant) = (Some("invariant"), Some(clauses.iter().map(clause).collect()));
                report.with = given.iter().copied().collect();
            }
            PropertyVerdict::Refuted(run) => {
                (report.verdict, report.steps) = ("refuted", Some(run.inputs.len()));
            }
            PropertyVerdict::Undecided { steps } => (report.verdict, report.steps) = ("undecided", Some(*steps)),
        }
        report
    }

    fn text(&self) -> String {
        let steps = counted(self.steps.unwrap_or(0), "step");
        let how = match (self.verdict, &self.invariant) {
            ("refuted", _) => format!("after {steps}"),
            ("undecided", _) => format!("it holds in the first {steps}"),
            (_, Some(clauses)) => format!("by an invariant of {}", counted(clauses.len(), "clause")),
            _ => format!("by induction over {steps}"),
        };
        let mut text = format!("    {:<9}  {}  ({how})\n", self.verdict, self.property);
        for shown in self.test.iter().flat_map(|test| test.lines()) {
            let _ = if shown.is_empty() { writeln!(text) } else { writeln!(text, "        {shown}") };
        }
        if let Some(physics) = self.physics {
            let words = if physics { "robots do the same" } else { "robots do something else" };
            let _ = writeln!(text, "        // in physics: {words}");
        }
        text
    }
}

impl ClaimReport {
    /// What is known of a claim.
    pub fn of(decided: &DecidedClaim) -> Self {
        let DecidedClaim { claim, system, verdicts, tests, work } = decided;
        let known = claim.wanted().zip(verdicts).zip(tests).enumerate();
        let properties = known.map(|(number, ((property, verdict), test))| PropertyReport {
            line: Some(property.line),
            test: test.as_ref().map(text_of_test),
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

    /// What is known of the properties of a model.
    pub fn of_model(file: &str, model: &AigerModel, verdicts: &[PropertyVerdict], work: u64) -> Self {
        let known = model.properties.iter().zip(verdicts).enumerate();
        let properties = known.map(|(number, (name, verdict))| PropertyReport {
            witness: Some(model.witness(number, verdict)),
            ..PropertyReport::of(&model.system, number, name.clone(), verdict)
        });
        let (line, circuit, title) = (None, None, None);
        Self { file: file.to_owned(), line, circuit, title, properties: properties.collect(), work }
    }

    /// Notes whether robots do what the test of a property shows.
    pub fn note_physics(&mut self, property: usize, is_same: bool) {
        self.properties[property].physics = Some(is_same);
    }

    /// The number of properties with this verdict.
    pub fn count(&self, verdict: &str) -> usize {
        self.properties.iter().filter(|property| property.verdict == verdict).count()
    }

    /// The witnesses of a model's properties, one after the other.
    pub fn witnesses(&self) -> String {
        self.properties.iter().filter_map(|property| property.witness.as_deref()).collect()
    }

    /// The report for people.
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

/// A test of rows as text of the language.
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

/// The words of the inputs of a row: `^` where a bit is 0 in its first half.
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
