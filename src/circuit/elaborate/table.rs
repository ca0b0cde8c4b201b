//! Truth tables to gates.

use crate::circuit::elaborate::build::ModuleBuilder;
use crate::circuit::elaborate::dense::{Dense, Shape};
use crate::circuit::elaborate::module::{Bit, NONE};
use crate::circuit::elaborate::wording::ElaborateError;
use crate::model::{Function, Table, TableRow};
use crate::source::Span;

/// Tables with more input bits are built row by row, not decomposed.
const MAX_DENSE_BITS: usize = 12;

impl ModuleBuilder<'_, '_> {
    /// The outputs of a table for these input bits, the lowest first.
    pub(super) fn table(&mut self, table: &Table, inputs: &[Bit]) -> Option<Vec<Bit>> {
        if let Some(row) = table.rows.iter().find(|row| row.pattern.len() != inputs.len()) {
            let error = ElaborateError::PatternWidth { found: row.pattern.len(), expected: inputs.len() };
            self.fault(error.at(row.span));
            return None;
        }
        let output = table.rows.first().map(|row| &row.output).or(table.otherwise.as_ref())?;
        Some((0..output.bits.len()).rev().map(|bit| self.table_bit(table, inputs, bit)).collect())
    }

    fn table_bit(&mut self, table: &Table, inputs: &[Bit], bit: usize) -> Bit {
        if inputs.len() <= MAX_DENSE_BITS {
            let dense = Dense::of(table, inputs.len(), bit);
            return self.shape(&dense.shape(), inputs, table.span);
        }
        let otherwise = table.otherwise.as_ref().and_then(|output| output.bits[bit]).unwrap_or(false);
        let rows = table.rows.iter().filter(|row| row.output.bits[bit].is_some_and(|value| value != otherwise));
        let terms: Vec<Bit> = rows.map(|row| self.term(row, inputs, table.span)).collect();
        let any = self.join(Function::OR, terms, false, table.span);
        if otherwise { self.gate(Function::NOT, [any, NONE], table.span) } else { any }
    }

    /// Whether the inputs match a row.
    fn term(&mut self, row: &TableRow, inputs: &[Bit], span: Span) -> Bit {
        let mut literals = Vec::new();
        for (value, &input) in row.pattern.iter().rev().zip(inputs) {
            match value {
                Some(true) => literals.push(input),
                Some(false) => literals.push(self.gate(Function::NOT, [input, NONE], span)),
                None => {}
            }
        }
        self.join(Function::AND, literals, true, span)
    }

    /// Combines all of them by one function, in a balanced tree; `empty` if there are none.
    fn join(&mut self, function: Function, mut bits: Vec<Bit>, empty: bool, span: Span) -> Bit {
        while bits.len() > 1 {
            let pair = |pair: &[Bit]| match *pair {
                [a, b] => self.gate(function, [a, b], span),
                _ => pair[0],
            };
            bits = bits.chunks(2).map(pair).collect();
        }
        bits.first().copied().unwrap_or_else(|| self.constant(empty))
    }

    /// The gates of a decomposed function; a part that occurs twice is built once.
    fn shape(&mut self, shape: &[Shape], inputs: &[Bit], span: Span) -> Bit {
        let mut built: Vec<Bit> = Vec::new();
        for part in shape {
            let bit = match *part {
                Shape::Constant(value) => self.constant(value),
                Shape::Input(input) => inputs[input],
                Shape::Not(part) => self.gate(Function::NOT, [built[part], NONE], span),
                Shape::Gate(function, a, b) => self.gate(function, [built[a], built[b]], span),
                Shape::Select(condition, then, otherwise) => {
                    self.select(built[condition], built[then], built[otherwise], span)
                }
            };
            built.push(bit);
        }
        *built.last().expect("a function has a part")
    }
}
