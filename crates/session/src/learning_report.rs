//! What was learned, as text and as data.

use std::collections::BTreeSet;
use std::fmt::Write;

use serde::Serialize;

use crate::learning::Learned;
use crate::report::{Align, TextTable};
use nbc_base::diag::counted;
use nbc_base::model::Column;
use nbc_circuit::levels;
use nbc_learn::{Accuracy, Bits, Examples};

/// What was learned.
#[derive(Debug, Serialize)]
pub struct LearningReport {
    circuit: String,
    inputs: Vec<Column>,
    outputs: Vec<Column>,
    /// AND gates, inverters not counted.
    ands: usize,
    cells: usize,
    depth: u32,
    training: AccuracyReport,
    /// Not there if no row was held out.
    #[serde(skip_serializing_if = "Option::is_none")]
    held_out: Option<AccuracyReport>,
    bits: Vec<BitReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    confusion: Option<Confusion>,
    seconds: f64,
}

/// How many rows are right.
#[derive(Clone, Copy, Debug, Serialize)]
struct AccuracyReport {
    right: usize,
    rows: usize,
    accuracy: f64,
}

/// How an output bit was learned.
#[derive(Debug, Serialize)]
struct BitReport {
    name: String,
    learned: String,
    tried: Vec<TriedReport>,
}

/// A method that was tried on an output bit.
#[derive(Debug, Serialize)]
struct TriedReport {
    method: String,
    accuracy: f64,
    ands: usize,
}

/// For each value of an output, how often each value came in its place.
#[derive(Debug, Serialize)]
struct Confusion {
    output: String,
    /// Whether the rows are those that were held out.
    held_out: bool,
    values: Vec<u64>,
    /// A row for each value that is wanted, with a number for each that came.
    counts: Vec<Vec<usize>>,
}

/// The most values of an output with a table of confusions.
const MOST_VALUES: usize = 16;

impl LearningReport {
    /// The report of a circuit that took so many seconds.
    pub fn of(learned: &Learned, seconds: f64) -> Self {
        let Learned { design, inputs, outputs, circuit } = learned;
        let names = outputs.iter().flat_map(Column::bits);
        let bit = |(name, output): (String, &nbc_learn::LearnedOutput)| BitReport {
            name,
            learned: output.what.clone(),
            tried: output.tried.iter().map(TriedReport::of).collect(),
        };
        let held_out = AccuracyReport::of(circuit.accuracy(&circuit.held_out));
        Self {
            circuit: design.logic.name.clone(),
            inputs: inputs.clone(),
            outputs: outputs.clone(),
            ands: circuit.ands(),
            cells: design.logic.cells().count(),
            depth: levels::depth(&design.logic),
            training: AccuracyReport::of(circuit.accuracy(&circuit.training)),
            held_out: Some(held_out).filter(|held_out| held_out.rows > 0),
            bits: names.zip(&circuit.outputs).map(bit).collect(),
            confusion: Confusion::of(learned),
            seconds,
        }
    }

    /// The report in lines.
    pub fn text(&self) -> String {
        let ports = |ports: &[Column], word: &str| counted(ports.iter().map(|port| port.width).sum(), word);
        let (inputs, outputs) = (ports(&self.inputs, "input bit"), ports(&self.outputs, "output bit"));
        let mut text = format!("{}: {inputs}, {outputs}\n", self.circuit);
        let gates = counted(self.ands, "AND gate");
        let _ = writeln!(text, "{gates} ({}), {}", counted(self.cells, "cell"), counted(self.depth as usize, "level"));
        let mut share = |what: &str, rows: &AccuracyReport| {
            let AccuracyReport { right, rows, accuracy } = rows;
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

    /// What a file of the circuit says of where it comes from: `command` made it.
    pub fn provenance(&self, command: &str) -> Vec<String> {
        let rows = |what: &str, rows: &AccuracyReport| format!("{} of {} {what} right", rows.right, rows.rows);
        let held_out =
            self.held_out.as_ref().map(|held_out| format!("; {}", rows("rows that were held out", held_out)));
        vec![
            format!("Learned by nbc {}: {command}", nbc_base::VERSION),
            format!("{}{}", rows("training rows", &self.training), held_out.unwrap_or_default()),
        ]
    }
}

impl AccuracyReport {
    fn of(Accuracy { right, rows }: Accuracy) -> Self {
        Self { right, rows, accuracy: right as f64 / rows.max(1) as f64 }
    }
}

impl TriedReport {
    fn of(tried: &nbc_learn::Tried) -> Self {
        Self { method: tried.method.clone(), accuracy: tried.accuracy, ands: tried.ands }
    }
}

impl Confusion {
    /// The confusions of the only output, if it has few values, in the rows that were held out or else in all others.
    fn of(learned: &Learned) -> Option<Self> {
        let [output] = &learned.outputs[..] else { return None };
        let held_out = learned.circuit.held_out.rows > 0;
        let rows = if held_out { &learned.circuit.held_out } else { &learned.circuit.training };
        let wanted: Vec<Bits> = rows.outputs.iter().map(|wanted| wanted.value.clone()).collect();
        let is_known = |row: usize| rows.outputs.iter().all(|wanted| wanted.known.get(row));
        let [wanted, found] = [numbers(&wanted, rows)?, numbers(&learned.circuit.outputs_in(rows), rows)?];
        let pairs: Vec<(u64, u64)> =
            wanted.into_iter().zip(found).enumerate().filter(|(row, _)| is_known(*row)).map(|(_, pair)| pair).collect();
        let values: BTreeSet<u64> = pairs.iter().flat_map(|&(wanted, found)| [wanted, found]).collect();
        if values.len() > MOST_VALUES {
            return None;
        }
        let values: Vec<u64> = values.into_iter().collect();
        let place = |value: u64| values.binary_search(&value).expect("all values are listed");
        let mut counts = vec![vec![0; values.len()]; values.len()];
        pairs.iter().for_each(|&(wanted, found)| counts[place(wanted)][place(found)] += 1);
        Some(Self { output: output.name.clone(), held_out, values, counts })
    }

    fn text(&self) -> String {
        let rows = if self.held_out { "rows that were held out" } else { "training rows" };
        let names: Vec<String> = self.values.iter().map(u64::to_string).collect();
        let columns: Vec<(&str, Align)> = [(self.output.as_str(), Align::Right)]
            .into_iter()
            .chain(names.iter().map(|name| (name.as_str(), Align::Right)))
            .collect();
        let mut table = TextTable::new(&columns);
        for (value, counts) in self.values.iter().zip(&self.counts) {
            let cell = |count: &usize| if *count == 0 { ".".to_owned() } else { count.to_string() };
            table.push([value.to_string()].into_iter().chain(counts.iter().map(cell)).collect());
        }
        format!("the {rows}, by the value wanted (left) and the value found (top):\n{table}")
    }
}

/// The number in each row of a word, the highest bit first; `None` of a word that is too wide.
fn numbers(bits: &[Bits], rows: &Examples) -> Option<Vec<u64>> {
    let number = |row: usize| bits.iter().fold(0, |number, bit| number << 1 | u64::from(bit.get(row)));
    (bits.len() <= 64).then(|| (0..rows.rows).map(number).collect())
}
