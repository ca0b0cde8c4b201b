//! Tests of circuits: sequences of input rows with the outputs expected after each.

use super::Instance;
use crate::source::Span;

/// A declared test, as bits: nothing of it needs the source but for messages.
#[derive(Clone, Debug, PartialEq)]
pub struct CircuitTest {
    /// What is tested.
    pub circuit: Instance,
    /// The words that say what it shows; empty where there are none.
    pub title: String,
    /// Where it is declared.
    pub span: Span,
    /// The input ports in order of declaration, with their widths in bits.
    pub inputs: Vec<Column>,
    /// The output ports in order of declaration, with their widths in bits.
    pub outputs: Vec<Column>,
    /// What is tried.
    pub stimulation: Stimulation,
}

/// A port as a column of a test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The port's name.
    pub name: String,
    /// Its width in bits.
    pub width: usize,
}

/// What a test tries.
#[derive(Clone, Debug, PartialEq)]
pub enum Stimulation {
    /// These rows one after another, without a reset between them.
    Rows(Vec<TestRow>),
    /// Every input pattern in counting order, against a circuit with the same ports.
    All {
        /// The circuit that is right.
        reference: Instance,
    },
}

/// One row of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct TestRow {
    /// The input bits in order of the ports, the most significant bit of a port first.
    pub inputs: Vec<bool>,
    /// The output bits likewise; `None` is not checked.
    pub expected: Vec<Option<bool>>,
    /// How long the row is held, in cycles, where it says so itself.
    pub hold: Option<u32>,
    /// Where the row stands.
    pub span: Span,
}

impl CircuitTest {
    /// The names of the input bits in order: `e` for a port of one bit, `a[3]`, `a[2]`, … for a wider one.
    pub fn input_bits(&self) -> Vec<String> {
        self.inputs.iter().flat_map(Column::bits).collect()
    }

    /// The names of the output bits in order.
    pub fn output_bits(&self) -> Vec<String> {
        self.outputs.iter().flat_map(Column::bits).collect()
    }
}

impl Column {
    /// The names of the port's bits, the most significant first.
    pub fn bits(&self) -> Vec<String> {
        match self.width {
            1 => vec![self.name.clone()],
            width => (0..width).rev().map(|bit| format!("{}[{bit}]", self.name)).collect(),
        }
    }
}
