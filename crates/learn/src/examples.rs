//! Examples: rows of input bits and the output bits that are wanted of them, column by column.

use std::collections::BTreeMap;

use crate::bits::Bits;
use nbc_circuit::rows::PortRow;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// The rows that say what it is.
    pub known: Bits,
    /// Its value there; 0 elsewhere.
    pub value: Bits,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Examples {
    pub inputs: Vec<Bits>,
    pub outputs: Vec<Wanted>,
    pub rows: usize,
}

impl Examples {
    pub fn of(rows: &[PortRow]) -> Self {
        let (inputs, outputs) = rows.first().map_or((0, 0), |row| (row.inputs.len(), row.outputs.len()));
        let input = |at: usize| Bits::of(rows.iter().map(|row| row.inputs[at]));
        let output = |at: usize| Wanted {
            known: Bits::of(rows.iter().map(|row| row.outputs[at].is_some())),
            value: Bits::of(rows.iter().map(|row| row.outputs[at] == Some(true))),
        };
        let (inputs, outputs) = ((0..inputs).map(input).collect(), (0..outputs).map(output).collect());
        Self { inputs, outputs, rows: rows.len() }
    }

    pub fn pick(&self, rows: &[usize]) -> Self {
        let pick = |bits: &Bits| bits.pick(rows);
        let wanted = |wanted: &Wanted| Wanted { known: pick(&wanted.known), value: pick(&wanted.value) };
        let (inputs, outputs) = (self.inputs.iter().map(pick).collect(), self.outputs.iter().map(wanted).collect());
        Self { inputs, outputs, rows: rows.len() }
    }

    pub fn of_output(&self, output: usize, rows: &[usize]) -> OutputRows {
        let inputs = self.inputs.iter().map(|input| input.pick(rows)).collect();
        OutputRows { inputs, target: self.outputs[output].value.pick(rows) }
    }

    /// The rows in which every output bit is as wanted, or not said, if the outputs are `found`.
    pub fn right(&self, found: &[Bits]) -> Bits {
        let all = Bits::all(self.rows, true);
        let wrong = |(wanted, found): (&Wanted, &Bits)| found.xor(&wanted.value).and(&wanted.known);
        self.outputs.iter().zip(found).map(wrong).fold(all, |right, wrong| right.and_not(&wrong))
    }

    pub fn most_frequent(&self) -> (Vec<bool>, usize) {
        let mut counts: BTreeMap<Vec<bool>, usize> = BTreeMap::new();
        for row in 0..self.rows {
            *counts.entry(self.outputs.iter().map(|output| output.value.get(row)).collect()).or_default() += 1;
        }
        counts.into_iter().max_by_key(|(_, count)| *count).unwrap_or_default()
    }
}

#[derive(Clone, Debug)]
pub struct OutputRows {
    pub inputs: Vec<Bits>,
    pub target: Bits,
}

impl OutputRows {
    pub fn pick(&self, rows: &[usize]) -> Self {
        Self { inputs: self.inputs.iter().map(|input| input.pick(rows)).collect(), target: self.target.pick(rows) }
    }

    /// What the rows mostly are for each number that the inputs are, the first input its lowest bit; `None` if a number
    /// is missing.
    pub fn table(&self) -> Option<Vec<bool>> {
        let width = self.inputs.len().min(usize::BITS as usize - 1);
        if 1 << width > self.target.rows() {
            return None;
        }
        let mut tally = vec![[0usize; 2]; 1 << width];
        for row in 0..self.target.rows() {
            let number = self.inputs.iter().rev().fold(0, |number, input| number << 1 | usize::from(input.get(row)));
            tally[number][usize::from(self.target.get(row))] += 1;
        }
        tally.into_iter().map(|[zeros, ones]| (zeros + ones > 0).then_some(ones > zeros)).collect()
    }

    /// Gives equal rows the value that most of them have, or 0.
    pub fn settle(&mut self) {
        let mut equal: BTreeMap<Bits, Vec<usize>> = BTreeMap::new();
        for row in 0..self.target.rows() {
            equal.entry(Bits::of(self.inputs.iter().map(|input| input.get(row)))).or_default().push(row);
        }
        let mut target = vec![false; self.target.rows()];
        for rows in equal.values() {
            let ones = rows.iter().filter(|&&row| self.target.get(row)).count();
            rows.iter().for_each(|&row| target[row] = 2 * ones > rows.len());
        }
        self.target = Bits::of(target);
    }
}
