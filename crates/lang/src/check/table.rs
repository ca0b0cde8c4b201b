//! Truth tables: exactly one row for every pattern.

use crate::check::circuit::CircuitChecker;
use crate::check::constant;
use crate::check::wording::TableError;
use crate::syntax::tree;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{ExpressionId, OutputValue, Table, TableOutput, TableRow};
use nbc_base::source::Span;

/// The most rows of a table. All pairs of rows are compared.
const MAX_ROWS: usize = 4096;

/// The most input bits of a table.
const MAX_BITS: usize = 64;

impl CircuitChecker<'_> {
    /// The table of these rows; `values` are the outputs that are expressions.
    pub(crate) fn table(&mut self, rows: &[tree::TableRowSyntax], values: &[ExpressionId], span: Span) -> Table {
        let mut table = Table { rows: Vec::new(), otherwise: None, span };
        let mut values = values.iter().enumerate();
        for row in rows {
            let output = match &row.output {
                tree::TableOutputSyntax::Bits(word) => {
                    let Some(bits) = self.bits(word) else { continue };
                    TableOutput { value: OutputValue::Bits(bits), span: word.span }
                }
                tree::TableOutputSyntax::Value(_) => {
                    let (index, value) = values.next().expect("every expression has its value");
                    let span = self.circuit.expressions[value.0 as usize].span;
                    TableOutput { value: OutputValue::Expression(index), span }
                }
            };
            match &row.pattern {
                Some(pattern) => {
                    let span = pattern.span;
                    table.rows.extend(self.bits(pattern).map(|pattern| TableRow { pattern, span, output }));
                }
                None => self.otherwise(&mut table, output, row.span),
            }
        }
        self.table_faults(&table);
        table
    }

    fn otherwise(&mut self, table: &mut Table, output: TableOutput, span: Span) {
        match &table.otherwise {
            Some(first) => {
                self.diagnostics.push(TableError::TwoElse { first: first.span }.at(span));
            }
            None => table.otherwise = Some(output),
        }
    }

    /// All of `1`, `0` and `-`; underscores separate.
    fn bits(&mut self, word: &tree::NameSyntax) -> Option<Vec<Option<bool>>> {
        let bits = constant::pattern(&word.text);
        if bits.is_none() {
            self.diagnostics.push(TableError::NotAPattern { word: word.text.clone() }.at(word.span));
        }
        bits
    }

    fn table_faults(&mut self, table: &Table) {
        let found = if table.rows.len() > MAX_ROWS {
            Some(TableError::TooManyRows { rows: table.rows.len(), most: MAX_ROWS }.at(table.span))
        } else if let Some(row) = table.rows.iter().find(|row| row.pattern.len() > MAX_BITS) {
            Some(TableError::TooManyBits { bits: row.pattern.len(), most: MAX_BITS }.at(row.span))
        } else {
            let patterns = uneven(table.rows.iter().map(|row| (row.pattern.len(), row.span)), "patterns");
            patterns
                .or_else(|| uneven(table.outputs().filter_map(written), "outputs"))
                .or_else(|| overlap(table))
                .or_else(|| missing(table))
        };
        self.diagnostics.extend(found);
    }
}

/// The width of an output that is not an expression, with its place.
fn written(output: &TableOutput) -> Option<(usize, Span)> {
    match &output.value {
        OutputValue::Bits(bits) => Some((bits.len(), output.span)),
        OutputValue::Expression(_) => None,
    }
}

/// The first width that differs from the previous one.
fn uneven(widths: impl Iterator<Item = (usize, Span)>, what: &'static str) -> Option<Diagnostic> {
    let widths: Vec<_> = widths.collect();
    let pair = widths.windows(2).find(|pair| pair[0].0 != pair[1].0)?;
    let [(before, first), (here, span)] = [pair[0], pair[1]];
    Some(TableError::Uneven { what, bits: [before, here], first }.at(span))
}

fn overlap(table: &Table) -> Option<Diagnostic> {
    let both = |a: &TableRow, b: &TableRow| {
        a.pattern.iter().zip(&b.pattern).all(|(a, b)| a.is_none() || b.is_none() || a == b)
    };
    table.rows.iter().enumerate().find_map(|(at, row)| {
        let first = table.rows[..at].iter().find(|first| both(first, row))?;
        Some(TableError::Overlap { first: first.span }.at(row.span))
    })
}

/// A pattern that no row matches, if there is no `else`. The rows do not overlap, so counting tells whether such a
/// pattern exists.
fn missing(table: &Table) -> Option<Diagnostic> {
    if table.otherwise.is_some() {
        return None;
    }
    let width = table.rows.first().map_or(0, |row| row.pattern.len());
    let mut left: Vec<&TableRow> = table.rows.iter().collect();
    let mut example = String::new();
    for bit in 0..width {
        let side = [false, true].into_iter().find(|side| !covers(&left, bit, *side, width))?;
        left.retain(|row| row.pattern[bit].is_none_or(|value| value == side));
        example.push(if side { '1' } else { '0' });
    }
    if !left.is_empty() {
        return None;
    }
    let error = match example.is_empty() {
        true => TableError::Empty,
        false => TableError::MissingRow { pattern: example, rest: rest(table) },
    };
    Some(error.at(table.span))
}

/// A row of zeros for the remaining patterns, and the end of the last row; `None` if the width of the outputs is not
/// written in a row.
fn rest(table: &Table) -> Option<(u32, String)> {
    let last = table.rows.last()?.output.span.end;
    let bits = table.outputs().find_map(|output| match &output.value {
        OutputValue::Bits(bits) => Some(bits.len()),
        OutputValue::Expression(_) => None,
    })?;
    Some((last, format!("else: {}", "0".repeat(bits))))
}

/// Whether non-overlapping rows match every pattern with this value at `bit`, where the bits before it are fixed.
fn covers(rows: &[&TableRow], bit: usize, side: bool, width: usize) -> bool {
    let here = rows.iter().filter(|row| row.pattern[bit].is_none_or(|value| value == side));
    let free = |row: &&&TableRow| row.pattern[bit + 1..width].iter().filter(|value| value.is_none()).count();
    here.map(|row| 1u128 << free(&row)).sum::<u128>() >= 1 << (width - bit - 1)
}
