//! Tests of circuits: sequences of input rows with the outputs expected after each.

use serde::Serialize;

use super::{Base, Circuit, Instance, Value};
use crate::source::Span;

/// A declared test, as bits. The source is needed for messages only.
#[derive(Clone, Debug, PartialEq)]
pub struct CircuitTest {
    /// The tested circuit.
    pub circuit: Instance,
    /// The title; empty if there is none.
    pub title: String,
    /// The place of the declaration.
    pub span: Span,
    /// The file in which it is declared.
    pub file: String,
    /// The line at which it is declared.
    pub line: usize,
    /// The input ports in order of declaration, with their widths in bits.
    pub inputs: Vec<Column>,
    /// The output ports in order of declaration, with their widths in bits.
    pub outputs: Vec<Column>,
    /// The method of the test.
    pub stimulation: Stimulation,
}

/// A port with its width: a column of a test, a waveform or a table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Column {
    /// The port's name.
    pub name: String,
    /// Its width in bits.
    pub width: usize,
}

/// The methods of a test.
#[derive(Clone, Debug, PartialEq)]
pub enum Stimulation {
    /// These rows one after another, without a reset between them.
    Rows(Vec<TestRow>),
    /// Every input pattern in counting order, against a circuit with the same ports.
    All {
        /// The reference circuit.
        reference: Reference,
    },
}

/// The circuit that a test compares with. A circuit written inside the test is not part of the program, because nothing
/// else can name it.
#[derive(Clone, Debug, PartialEq)]
pub enum Reference {
    /// `against other`
    Circuit(Instance),
    /// `for all inputs { … }`, with the ports of the tested circuit.
    Body(Box<Circuit>),
}

/// One row of a test.
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
    /// The place of the row.
    pub span: Span,
    /// Its line.
    pub line: usize,
    /// Its number among the rows of the source, from 1; both halves of a pulse have the same.
    pub row: usize,
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

impl TestRow {
    /// The values of the input ports.
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

impl Column {
    /// The ports that have these bits, named as [`Column::bits`] names them: a run of `a[3]`, `a[2]`, … down to `a[0]`
    /// is one port.
    pub fn group(bits: &[String]) -> Vec<Self> {
        let mut ports = Vec::new();
        let mut rest = bits;
        while let Some(first) = rest.first() {
            let width = whole_port(rest).unwrap_or(1);
            let name = if width == 1 { first } else { parts(first).expect("a bit of a bus").0 };
            ports.push(Self { name: name.to_owned(), width });
            rest = &rest[width..];
        }
        ports
    }

    /// The names of the port's bits, most significant first.
    pub fn bits(&self) -> Vec<String> {
        match self.width {
            1 => vec![self.name.clone()],
            width => (0..width).rev().map(|bit| format!("{}[{bit}]", self.name)).collect(),
        }
    }
}

/// The width of the bus that these bits begin with, if all its bits are there.
fn whole_port(bits: &[String]) -> Option<usize> {
    let (name, highest) = parts(&bits[0])?;
    let run = bits.get(..=highest)?;
    let whole = run.iter().zip((0..=highest).rev()).all(|(bit, at)| parts(bit) == Some((name, at)));
    (whole && highest > 0).then_some(highest + 1)
}

/// The name of a bus and the number of its bit, in the name of the bit.
fn parts(bit: &str) -> Option<(&str, usize)> {
    let (name, at) = bit.strip_suffix(']')?.rsplit_once('[')?;
    Some((name, at.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_grouped_into_ports() {
        let column = |name: &str, width| Column { name: name.to_owned(), width };
        let ports = [column("a", 3), column("b", 1), column("c", 2), column("c2", 2)];
        let bits: Vec<String> = ports.iter().flat_map(Column::bits).collect();
        assert_eq!(Column::group(&bits), ports);
        let apart = ["a[0]", "b[2]", "b[1]", "c[1]", "d[0]"].map(str::to_owned);
        assert_eq!(Column::group(&apart), apart.map(|bit| column(&bit, 1)), "bits that are no whole ports");
    }
}
