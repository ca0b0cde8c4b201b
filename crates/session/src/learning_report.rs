//! What was learned, as text and as data.

use std::fmt::Write;

use serde::Serialize;

use crate::learning::Learned;
use crate::report::{Confusion, Svg};
use crate::wording;
use nbc_base::diag::{Diagnostic, counted};
use nbc_base::model::Column;
use nbc_circuit::levels;
use nbc_learn::{Accuracy, Bits, Examples, LearnedOutput};

/// What was learned.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LearningReport {
    circuit: String,
    inputs: Vec<Column>,
    outputs: Vec<Column>,
    /// Inverters not counted.
    ands: usize,
    cells: usize,
    depth: u32,
    training: Accuracy,
    /// `None` if no row was held out.
    #[serde(skip_serializing_if = "Option::is_none")]
    held_out: Option<Accuracy>,
    bits: Vec<LearnedOutput>,
    /// Of a circuit with one output of few values.
    #[serde(skip_serializing_if = "Option::is_none")]
    confusion: Option<Confusion>,
    seconds: f64,
}

impl LearningReport {
    pub fn of(learned: &Learned, seconds: f64) -> Self {
        let Learned { design, inputs, outputs, circuit } = learned;
        let held_out = circuit.accuracy(&circuit.held_out);
        Self {
            circuit: design.netlist.name.clone(),
            inputs: inputs.clone(),
            outputs: outputs.clone(),
            ands: circuit.ands(),
            cells: design.netlist.cells().count(),
            depth: levels::depth(&design.netlist),
            training: circuit.accuracy(&circuit.training),
            held_out: Some(held_out).filter(|held_out| held_out.rows > 0),
            bits: circuit.outputs.clone(),
            confusion: confusion(learned),
            seconds,
        }
    }

    pub fn text(&self) -> String {
        let ports = |ports: &[Column], word: &str| counted(ports.iter().map(|port| port.width).sum(), word);
        let (inputs, outputs) = (ports(&self.inputs, "input bit"), ports(&self.outputs, "output bit"));
        let mut text = format!("{}: {inputs}, {outputs}\n", self.circuit);
        let gates = counted(self.ands, "AND gate");
        let _ = writeln!(text, "{gates} ({}), {}", counted(self.cells, "cell"), counted(self.depth as usize, "level"));
        let mut share = |what: &str, rows: &Accuracy| {
            let Accuracy { right, rows, accuracy } = rows;
            let _ = writeln!(text, "{what}: {:.2} % ({right} of {})", accuracy * 100.0, counted(*rows, "row"));
        };
        share("training", &self.training);
        match &self.held_out {
            Some(held_out) => share("held out", held_out),
            None => text.push_str("held out: no rows\n"),
        }
        for bit in &self.bits {
            let _ = writeln!(text, "{}: {}", bit.name, bit.learned);
        }
        text.extend(self.confusion.as_ref().map(Confusion::text));
        text
    }

    pub fn draw_confusion(&self) -> Result<Svg, Diagnostic> {
        let confusion = self.confusion.as_ref().ok_or_else(|| wording::no_confusion(&self.circuit))?;
        Ok(confusion.draw(&format!("{}: {}", self.circuit, confusion.output)))
    }

    /// The comment in the file of the circuit, which `command` made.
    pub fn provenance(&self, command: &str) -> Vec<String> {
        let rows = |what: &str, rows: &Accuracy| format!("{} of {} {what} right", rows.right, rows.rows);
        let held_out =
            self.held_out.as_ref().map(|held_out| format!("; {}", rows("rows that were held out", held_out)));
        vec![
            format!("Learned by nbc {}: {command}", nbc_base::VERSION),
            format!("{}{}", rows("training rows", &self.training), held_out.unwrap_or_default()),
        ]
    }
}

/// The confusions of a single output with few values, over the held-out rows, or else over all others.
fn confusion(learned: &Learned) -> Option<Confusion> {
    let [output] = &learned.outputs[..] else { return None };
    let held_out = learned.circuit.held_out.rows > 0;
    let rows = if held_out { &learned.circuit.held_out } else { &learned.circuit.training };
    let wanted: Vec<Bits> = rows.outputs.iter().map(|wanted| wanted.value.clone()).collect();
    let is_known = |row: usize| rows.outputs.iter().all(|wanted| wanted.known.get(row));
    let [wanted, found] = [numbers(&wanted, rows)?, numbers(&learned.circuit.outputs_in(rows), rows)?];
    let pairs = wanted.into_iter().zip(found).enumerate().filter(|(row, _)| is_known(*row));
    Confusion::of(&output.name, held_out, &pairs.map(|(_, pair)| pair).collect::<Vec<_>>())
}

/// The number in each row, the highest bit first; `None` if it is wider than 64 bits.
fn numbers(bits: &[Bits], rows: &Examples) -> Option<Vec<u64>> {
    let number = |row: usize| bits.iter().fold(0, |number, bit| number << 1 | u64::from(bit.get(row)));
    (bits.len() <= 64).then(|| (0..rows.rows).map(number).collect())
}
