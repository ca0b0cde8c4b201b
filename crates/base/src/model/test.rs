//! Tests of circuits: sequences of input rows with the outputs expected after each.

use serde::Serialize;

use super::{Base, Circuit, CircuitId, Column, Instance, NamedWorld, Value};
use crate::source::Span;

/// A declared test, as bits. The source is needed for messages only.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CircuitTest {
    pub circuit: Instance,
    /// The title; empty if there is none.
    pub title: String,
    #[serde(skip)]
    pub span: Span,
    pub file: String,
    pub line: usize,
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    #[serde(skip)]
    pub stimulation: Stimulation,
    /// The file of its rows, if the source does not have them.
    #[serde(skip)]
    pub rows_from: Option<RowSource>,
    /// The worlds that the test names: its swarms run in each of them. If there are none, each runs in its own.
    #[serde(skip)]
    pub worlds: Vec<NamedWorld>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RowSource {
    pub file: String,
    /// The share of the rows in percent that must pass, if not all must.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Stimulation {
    /// These rows one after another, without a reset between them.
    Rows(Vec<TestRow>),
    Script(Script),
    /// Every input pattern in counting order, against a circuit with the same ports.
    All {
        /// The reference: a circuit with the ports of the tested one. It is not part of the program, because nothing
        /// else can name it.
        reference: Box<Circuit>,
    },
    /// Against a circuit with the same ports: no output ever differs, whatever the inputs. A search decides it.
    Ever {
        other: Instance,
        /// A circuit with the ports of the tested one that calls the other. It is not part of the program.
        reference: Box<Circuit>,
    },
}

/// Rows that depend on what the circuit does: an environment gives it inputs, or a row is repeated until an output has
/// a value. What the rows are is found at the level of logic.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    pub environment: Option<CircuitId>,
    /// The steps one after another, without a reset between them.
    pub steps: Vec<ScriptStep>,
}

/// A row as written, which may be repeated.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptStep {
    /// The row, or the two halves of a pulse. Inputs that the environment gives are 0.
    pub rows: Vec<TestRow>,
    pub until: Option<Until>,
}

/// When the repetition of a row ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Until {
    /// The first of the output bits that must have values, as [`TestRow::expected`] counts them.
    pub first: usize,
    /// The values, the most significant first; `None` is any.
    pub bits: Vec<Option<bool>>,
    pub most: usize,
    pub output: String,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub struct TestRow {
    /// The input bits in order of the ports, the most significant bit of a port first.
    pub inputs: Vec<bool>,
    /// The output bits likewise; `None` is not checked.
    pub expected: Vec<Option<bool>>,
    /// How the values of the input ports are written, then those of the output ports.
    pub bases: Vec<Base>,
    /// The hold of the row in cycles, if the row sets it.
    pub hold: Option<u32>,
    pub span: Span,
    /// The line of the row in its file, from 1.
    pub line: usize,
    /// Its number among the rows of the source, from 1; both halves of a pulse have the same.
    pub row: usize,
    /// Whether it is the first half of a pulse, which is applied, but not checked.
    pub is_half: bool,
    /// How often it was repeated, if that is as often as its `until` permits and it still waits for its value.
    pub given_up: Option<usize>,
}

impl CircuitTest {
    /// The names of the input bits in order: `e` for a port of one bit, `a[3]`, `a[2]`, … for a wider one.
    pub fn input_bits(&self) -> Vec<String> {
        self.inputs.iter().flat_map(Column::bits).collect()
    }

    pub fn output_bits(&self) -> Vec<String> {
        self.outputs.iter().flat_map(Column::bits).collect()
    }
}

impl TestRow {
    pub fn input_values(&self, inputs: &[Column]) -> Vec<Value> {
        Value::of_ports(inputs, self.inputs.iter().copied().map(Some), &self.bases)
    }

    /// The values of the output ports, in the notation of the row.
    pub fn output_values(
        &self,
        inputs: &[Column],
        outputs: &[Column],
        bits: impl IntoIterator<Item = Option<bool>>,
    ) -> Vec<Value> {
        Value::of_ports(outputs, bits, self.bases.get(inputs.len()..).unwrap_or_default())
    }
}
