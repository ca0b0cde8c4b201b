//! Truth tables: exactly one row for every pattern.

use crate::check::circuit::CircuitChecker;
use crate::diag::{Code, Diagnostic};
use crate::model::{Table, TableOutput, TableRow};
use crate::source::Span;
use crate::syntax::tree;

/// The most rows of a table. All pairs of rows are compared.
const MAX_ROWS: usize = 4096;

/// The most input bits of a table.
const MAX_BITS: usize = 64;

impl CircuitChecker<'_> {
    pub(crate) fn table(&mut self, rows: &[tree::TableRow], span: Span) -> Table {
        let mut table = Table { rows: Vec::new(), otherwise: None, span };
        for row in rows {
            let Some(bits) = self.bits(&row.output) else { continue };
            let output = TableOutput { bits, span: row.output.span };
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
                let fault = Diagnostic::new(Code::TableOverlap, "a table with two rows `else`", span, "this one");
                self.diagnostics.push(fault.with_label(first.span, "and this one"));
            }
            None => table.otherwise = Some(output),
        }
    }

    /// All of `1`, `0` and `-`; underscores separate.
    fn bits(&mut self, word: &tree::Name) -> Option<Vec<Option<bool>>> {
        let bit = |c| match c {
            '0' => Some(Some(false)),
            '1' => Some(Some(true)),
            '-' => Some(None),
            _ => None,
        };
        let bits: Option<Vec<_>> = word.text.chars().filter(|&c| c != '_').map(bit).collect();
        if bits.is_none() {
            let message = format!("`{}` is no pattern", word.text);
            let fault = Diagnostic::new(Code::Syntax, message, word.span, "expected `0`, `1` and `-`");
            self.diagnostics.push(fault);
        }
        bits
    }

    fn table_faults(&mut self, table: &Table) {
        let outputs = table.rows.iter().map(|row| &row.output).chain(&table.otherwise);
        let found = if table.rows.len() > MAX_ROWS {
            let message = format!("a table of {} rows", table.rows.len());
            Some(Diagnostic::new(Code::TooLarge, message, table.span, format!("expected at most {MAX_ROWS}")))
        } else if let Some(row) = table.rows.iter().find(|row| row.pattern.len() > MAX_BITS) {
            let message = format!("a pattern of {} bits", row.pattern.len());
            Some(Diagnostic::new(Code::TooLarge, message, row.span, format!("expected at most {MAX_BITS}")))
        } else {
            let patterns = uneven(table.rows.iter().map(|row| (row.pattern.len(), row.span)), "patterns");
            patterns
                .or_else(|| uneven(outputs.map(|output| (output.bits.len(), output.span)), "outputs"))
                .or_else(|| overlap(table))
                .or_else(|| missing(table))
        };
        self.diagnostics.extend(found);
    }
}

/// The first width that differs from the previous one.
fn uneven(widths: impl Iterator<Item = (usize, Span)>, what: &str) -> Option<Diagnostic> {
    let widths: Vec<_> = widths.collect();
    let pair = widths.windows(2).find(|pair| pair[0].0 != pair[1].0)?;
    let message = format!("a table with {what} of {} and of {} bits", pair[0].0, pair[1].0);
    let label = |bits| format!("{bits} bits");
    Some(Diagnostic::new(Code::RowWidth, message, pair[1].1, label(pair[1].0)).with_label(pair[0].1, label(pair[0].0)))
}

fn overlap(table: &Table) -> Option<Diagnostic> {
    let both = |a: &TableRow, b: &TableRow| {
        a.pattern.iter().zip(&b.pattern).all(|(a, b)| a.is_none() || b.is_none() || a == b)
    };
    table.rows.iter().enumerate().find_map(|(at, row)| {
        let first = table.rows[..at].iter().find(|first| both(first, row))?;
        let message = "two rows of the table match the same pattern";
        let fault = Diagnostic::new(Code::TableOverlap, message, row.span, "this row");
        Some(fault.with_label(first.span, "and this one").with_help("say with `0` and `1` which of the two is meant"))
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
    let message = if example.is_empty() {
        "a table without rows".to_owned()
    } else {
        format!("the table has no row for `{example}`")
    };
    let fault = Diagnostic::new(Code::TableIncomplete, message, table.span, "this table");
    Some(fault.with_help("add the row, or `else: 0` for all that are left"))
}

/// Whether non-overlapping rows match every pattern with this value at `bit`, where the bits before it are fixed.
fn covers(rows: &[&TableRow], bit: usize, side: bool, width: usize) -> bool {
    let here = rows.iter().filter(|row| row.pattern[bit].is_none_or(|value| value == side));
    let free = |row: &&&TableRow| row.pattern[bit + 1..width].iter().filter(|value| value.is_none()).count();
    here.map(|row| 1u128 << free(&row)).sum::<u128>() >= 1 << (width - bit - 1)
}
