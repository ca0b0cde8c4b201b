//! A decided property, and its text.

use std::fmt::Write;

use serde::Serialize;

use nbc_base::diag::counted;
use nbc_base::model::CircuitTest;
use nbc_circuit::properties::{InductiveProof, PropertyVerdict, TransitionSystem};
use nbc_circuit::{Clause, ValuedBit};

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DecidedProperty {
    /// As written, or the name of a bad state of a model.
    pub property: String,
    /// `None` for a model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// `proved`, `refuted` or `undecided`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["proved", "refuted", "undecided"])))]
    pub verdict: &'static str,
    /// What the verdict is based on, in words.
    pub how: String,
    /// `induction` or `invariant`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<&'static str>,
    /// Steps of the induction or of the run, or the first steps in which it is known to hold.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
    /// Clauses that hold in every step.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub invariant: Option<Vec<String>>,
    /// Numbers of the other properties that this proof needs, from 0.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub with: Vec<usize>,
    /// Why the proof is vacuous.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub empty: Option<String>,
    /// A test that refutes it, in the language.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub test: Option<String>,
    /// That test. The circuit passes it, and its last row shows the fault.
    #[serde(skip)]
    pub shown: Option<CircuitTest>,
    /// In AIGER's format.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub witness: Option<String>,
    /// Whether robots do the same as the test.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub physics: Option<bool>,
}

impl DecidedProperty {
    pub(super) fn of(
        (system, number): (&TransitionSystem, usize),
        property: String,
        verdict: &PropertyVerdict,
        empty: Option<String>,
    ) -> Self {
        let mut decided = Self {
            property,
            line: None,
            verdict: "proved",
            how: String::new(),
            method: None,
            steps: None,
            invariant: None,
            with: Vec::new(),
            empty,
            test: None,
            shown: None,
            witness: None,
            physics: None,
        };
        match verdict {
            PropertyVerdict::Proved(InductiveProof::Steps { steps, together }) => {
                (decided.method, decided.steps) = (Some("induction"), Some(*steps));
                decided.with = together.iter().copied().filter(|&other| other != number).collect();
            }
            PropertyVerdict::Proved(InductiveProof::Invariant { clauses, given }) => {
                let clause = |clause: &Clause| {
                    let literal = |&(at, value): &ValuedBit| {
                        let name = &system.registers[at].name;
                        if value { name.clone() } else { format!("not {name}") }
                    };
                    clause.iter().map(literal).collect::<Vec<_>>().join(" or ")
                };
                (decided.method, decided.invariant) = (Some("invariant"), Some(clauses.iter().map(clause).collect()));
                decided.with = given.iter().copied().collect();
            }
            PropertyVerdict::Refuted(run) => {
                (decided.verdict, decided.steps) = ("refuted", Some(run.inputs.len()));
            }
            PropertyVerdict::Undecided { steps } => (decided.verdict, decided.steps) = ("undecided", Some(*steps)),
        }
        decided.how = decided.words();
        decided
    }

    fn words(&self) -> String {
        let steps = counted(self.steps.unwrap_or(0), "step");
        if let Some(why) = &self.empty {
            return format!("but empty: {why}");
        }
        match (self.verdict, &self.invariant) {
            ("refuted", _) => format!("after {steps}"),
            ("undecided", _) => format!("it holds in the first {steps}"),
            (_, Some(clauses)) => format!("by an invariant of {}", counted(clauses.len(), "clause")),
            _ => format!("by induction over {steps}"),
        }
    }

    pub fn text(&self) -> String {
        let mut text = format!("    {:<9}  {}  ({})\n", self.verdict, self.property, self.how);
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
