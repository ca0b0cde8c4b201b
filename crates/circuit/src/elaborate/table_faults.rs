//! What is wrong with a truth table: it needs exactly one row for every pattern.

use crate::elaborate::wording;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{OutputValue, Table, TableOutput, TablePattern, TableRow};
use nbc_base::source::Span;

pub fn table_in_bits(table: &Table, width: usize) -> Result<Table, Diagnostic> {
    let mut table = table.clone();
    for row in &mut table.rows {
        // A single digit is a number of any width.
        let number = match row.pattern {
            TablePattern::Number(value) => Some(value),
            TablePattern::Bits(_) => row.pattern.digit().filter(|_| width != 1),
        };
        if let Some(value) = number {
            if width < 128 && value >> width != 0 {
                return Err(wording::wide_number(value, width, row.span));
            }
            let bit = |bit: usize| Some(bit < 128 && value >> bit & 1 == 1);
            row.pattern = TablePattern::Bits((0..width).rev().map(bit).collect());
        }
    }
    Ok(table)
}

/// Every pattern has all its bits. All pairs of rows are compared, so there must be few.
pub fn table_fault(table: &Table) -> Option<Diagnostic> {
    if Limit::TableRows.permit(table.rows.len() as u64).is_err() {
        return Some(wording::too_many_rows(table.rows.len(), table.span));
    }
    let is_wide = |row: &&TableRow| Limit::TableBits.permit(row.bits().len() as u64).is_err();
    if let Some(row) = table.rows.iter().find(is_wide) {
        return Some(wording::too_many_bits(row.bits().len(), row.span));
    }
    uneven(table.rows.iter().map(|row| (row.bits().len(), row.span)), "patterns")
        .or_else(|| uneven(table.outputs().filter_map(written), "outputs"))
        .or_else(|| overlap(table))
        .or_else(|| missing(table))
}

fn written(output: &TableOutput) -> Option<(usize, Span)> {
    match &output.value {
        OutputValue::Bits(bits) => Some((bits.len(), output.span)),
        OutputValue::Number(_) | OutputValue::Expression(_) => None,
    }
}

fn uneven(widths: impl Iterator<Item = (usize, Span)>, what: &str) -> Option<Diagnostic> {
    let widths: Vec<_> = widths.collect();
    let pair = widths.windows(2).find(|pair| pair[0].0 != pair[1].0)?;
    Some(wording::uneven(what, pair[0], pair[1]))
}

fn overlap(table: &Table) -> Option<Diagnostic> {
    let both =
        |a: &TableRow, b: &TableRow| a.bits().iter().zip(b.bits()).all(|(a, b)| a.is_none() || b.is_none() || a == b);
    table.rows.iter().enumerate().find_map(|(at, row)| {
        let first = table.rows[..at].iter().find(|first| both(first, row))?;
        Some(wording::overlap(first.span, row.span))
    })
}

/// The rows do not overlap, so counting tells whether there is a pattern without a row.
fn missing(table: &Table) -> Option<Diagnostic> {
    if table.otherwise.is_some() {
        return None;
    }
    let width = table.rows.first().map_or(0, |row| row.bits().len());
    let mut left: Vec<&TableRow> = table.rows.iter().collect();
    let mut example = String::new();
    for bit in 0..width {
        let side = [false, true].into_iter().find(|side| !covers(&left, bit, *side, width))?;
        left.retain(|row| row.bits()[bit].is_none_or(|value| value == side));
        example.push(if side { '1' } else { '0' });
    }
    if !left.is_empty() {
        return None;
    }
    Some(match example.is_empty() {
        true => wording::no_rows(table.span),
        false => wording::missing_row(&example, rest(table), table.span),
    })
}

/// A row of zeros, and the end of the last row; `None` if no row shows the width of the outputs.
fn rest(table: &Table) -> Option<(u32, String)> {
    let last = table.rows.last()?.output.span.end;
    let bits = table.outputs().find_map(|output| match &output.value {
        OutputValue::Bits(bits) => Some(bits.len()),
        // A single digit is as wide as its context.
        OutputValue::Number(_) => Some(1),
        OutputValue::Expression(_) => None,
    })?;
    Some((last, format!("else: {}", "0".repeat(bits))))
}

/// Whether non-overlapping rows match every pattern with this value at `bit`, where the bits before it are fixed.
fn covers(rows: &[&TableRow], bit: usize, side: bool, width: usize) -> bool {
    let here = rows.iter().filter(|row| row.bits()[bit].is_none_or(|value| value == side));
    let free = |row: &&&TableRow| row.bits()[bit + 1..width].iter().filter(|value| value.is_none()).count();
    here.map(|row| 1u128 << free(&row)).sum::<u128>() >= 1 << (width - bit - 1)
}
