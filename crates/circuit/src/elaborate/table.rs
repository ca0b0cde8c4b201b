//! Truth tables to gates.

use crate::elaborate::build::ModuleBuilder;
use crate::elaborate::dense::{self, Shape};
use crate::elaborate::module::Bit;
use crate::elaborate::table_faults::{table_fault, table_in_bits};
use crate::elaborate::wording::{self, OperandText};
use nbc_base::budget::Limit;
use nbc_base::model::{ExpressionId, Function, OutputValue, Table, TableOutput, TableRow};
use nbc_base::source::Span;

/// Tables with more input bits are built row by row, not decomposed.
const MAX_DENSE_BITS: usize = 12;

#[derive(Clone, Copy)]
enum OutputBit {
    /// A value, or a bit that the compiler chooses.
    Fixed(Option<bool>),
    Net(Bit),
}

impl OutputBit {
    fn fixed(self) -> Option<Option<bool>> {
        match self {
            Self::Fixed(value) => Some(value),
            Self::Net(_) => None,
        }
    }
}

#[derive(Clone, Copy)]
pub(super) struct TableValues<'a> {
    pub(super) expressions: &'a [ExpressionId],
    pub(super) bits: &'a [Vec<Bit>],
    pub(super) width: Option<u32>,
}

impl ModuleBuilder<'_, '_> {
    pub(super) fn table(&mut self, table: &Table, inputs: &[Bit], values: TableValues) -> Option<Vec<Bit>> {
        let resolved;
        self.take(Limit::Steps, (table.rows.len() as u64 + 1).saturating_mul(inputs.len() as u64))?;
        let digits = inputs.len() != 1 && table.rows.iter().all(|row| row.pattern.digit().is_some());
        let table = if table.is_in_bits() && !digits {
            table
        } else {
            let found = table_in_bits(table, inputs.len());
            match found.and_then(|table| table_fault(&table).map_or(Ok(table), Err)) {
                Ok(table) => {
                    resolved = table;
                    &resolved
                }
                Err(fault) => {
                    self.fault(fault);
                    return None;
                }
            }
        };
        if let Some(row) = table.rows.iter().find(|row| row.bits().len() != inputs.len()) {
            self.fault(wording::pattern_width(row.bits().len(), inputs.len(), row.span));
            return None;
        }
        let mut outputs: Vec<Vec<OutputBit>> = Vec::new();
        for output in table.outputs() {
            outputs.push(self.output_bits(output, values)?);
        }
        let width = outputs.first()?.len();
        if let Some(at) = outputs.iter().position(|output| output.len() != width) {
            let mut texts = table.outputs().zip(&outputs).map(|(output, bits)| self.output_text(output, bits, values));
            let (first, second) = (texts.next()?, texts.nth(at - 1)?);
            self.fault(wording::unequal("the outputs of the table", &first, &second));
            return None;
        }
        let patterns = if inputs.len() <= MAX_DENSE_BITS { 1 << inputs.len() } else { table.rows.len() };
        self.take(Limit::Steps, (patterns as u64).saturating_mul(width as u64))?;
        let column = |bit: usize| outputs.iter().map(|output| output[bit]).collect::<Vec<_>>();
        Some((0..width).map(|bit| self.table_bit(table, inputs, &column(bit))).collect())
    }

    fn output_bits(&mut self, output: &TableOutput, values: TableValues) -> Option<Vec<OutputBit>> {
        if let OutputValue::Number(value) = output.value {
            let width = match values.width {
                Some(width) => width,
                None if value <= 1 => 1,
                None => {
                    self.fault(wording::number_without_width(value, output.span));
                    return None;
                }
            };
            let bits = self.fitting_bits(value, width, output.span)?;
            return Some(bits.into_iter().map(|bit| OutputBit::Fixed(Some(bit))).collect());
        }
        let value = |bit| self.constant_of(bit).map_or(OutputBit::Net(bit), |value| OutputBit::Fixed(Some(value)));
        Some(match &output.value {
            OutputValue::Number(_) => unreachable!("numbers were handled"),
            OutputValue::Bits(bits) => bits.iter().rev().map(|&bit| OutputBit::Fixed(bit)).collect(),
            OutputValue::Expression(index) => values.bits[*index].iter().map(|&bit| value(bit)).collect(),
        })
    }

    fn output_text(&self, output: &TableOutput, bits: &[OutputBit], values: TableValues) -> OperandText {
        match output.value {
            OutputValue::Bits(_) | OutputValue::Number(_) => {
                OperandText { width: bits.len() as u32, span: output.span, net: None, constant: None }
            }
            OutputValue::Expression(index) => self.operand(values.expressions[index], &values.bits[index]),
        }
    }

    fn table_bit(&mut self, table: &Table, inputs: &[Bit], column: &[OutputBit]) -> Bit {
        let (rows, otherwise) = column.split_at(table.rows.len());
        let otherwise = otherwise.first().copied().unwrap_or(OutputBit::Fixed(None));
        let fixed: Option<Vec<_>> = rows.iter().map(|bit| bit.fixed()).collect();
        if let (Some(rows), Some(otherwise), true) = (fixed, otherwise.fixed(), inputs.len() <= MAX_DENSE_BITS) {
            let outputs = dense::outputs(table, inputs.len(), &rows, otherwise);
            return self.shape(&dense::shape(&outputs), inputs, table.span);
        }
        let mut terms = Vec::new();
        for (row, &bit) in table.rows.iter().zip(rows) {
            terms.extend(self.row_bit(bit, |builder| builder.term(row, inputs, table.span), table.span));
        }
        terms.extend(self.row_bit(otherwise, |builder| builder.no_row(table, inputs), table.span));
        self.join(Function::OR, terms, false, table.span)
    }

    /// An output bit if the inputs match, else 0; `None` if it is always 0.
    fn row_bit(&mut self, bit: OutputBit, matches: impl FnOnce(&mut Self) -> Bit, span: Span) -> Option<Bit> {
        match bit {
            OutputBit::Fixed(Some(true)) => Some(matches(self)),
            OutputBit::Fixed(_) => None,
            OutputBit::Net(bit) => {
                let matched = matches(self);
                Some(self.gate(Function::AND, [matched, bit], span))
            }
        }
    }

    fn no_row(&mut self, table: &Table, inputs: &[Bit]) -> Bit {
        let terms = table.rows.iter().map(|row| self.term(row, inputs, table.span)).collect();
        let any = self.join(Function::OR, terms, false, table.span);
        self.gate(Function::NOT, [any; 2], table.span)
    }

    fn term(&mut self, row: &TableRow, inputs: &[Bit], span: Span) -> Bit {
        let mut literals = Vec::new();
        for (value, &input) in row.bits().iter().rev().zip(inputs) {
            match value {
                Some(true) => literals.push(input),
                Some(false) => literals.push(self.gate(Function::NOT, [input; 2], span)),
                None => {}
            }
        }
        self.join(Function::AND, literals, true, span)
    }

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

    fn shape(&mut self, shape: &[Shape], inputs: &[Bit], span: Span) -> Bit {
        let mut built: Vec<Bit> = Vec::new();
        for part in shape {
            let bit = match *part {
                Shape::Constant(value) => self.constant(value),
                Shape::Input(input) => inputs[input],
                Shape::Not(part) => self.gate(Function::NOT, [built[part]; 2], span),
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
