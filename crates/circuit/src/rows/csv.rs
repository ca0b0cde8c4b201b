//! Rows as CSV: names of columns in the first line, then a line of numbers for each row.

use std::collections::BTreeMap;

use super::ports::{FileRow, RowColumn, RowFile};
use super::wording::{self, MOST_ERRORS};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, Span};

type Cell<'t> = (&'t str, Span);

/// Reads a file. A number is decimal, or hexadecimal after `0x`, where each digit stands for four bits; a cell that is
/// empty or `-` is any value. Text after `#` is a comment.
pub(super) fn read(text: &str, file: FileId) -> Result<RowFile, Vec<Diagnostic>> {
    let mut lines = lines(text, file);
    let header = lines.next().ok_or_else(|| vec![wording::empty(Span::new(file, 0, 0))])?;
    let mut columns = columns(&header)?;
    // Nothing is made of a row before the bits of all are counted.
    let rows = lines.clone();
    let (mut count, mut errors) = (0, Vec::new());
    for line in lines {
        let span = span(&line);
        if Limit::Rows.permit(count + 1).is_err() {
            errors.push(wording::too_many_rows(span));
            break;
        }
        match widen(&mut columns, &line, span) {
            Ok(()) => count += 1,
            Err(error) => errors.push(error),
        }
        if errors.len() == MOST_ERRORS {
            break;
        }
    }
    if errors.is_empty() && count == 0 {
        errors.push(wording::no_rows(header[0].1));
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let width: usize = columns.iter().map(|column| column.width).sum();
    if Limit::RowBits.permit((width as u64).saturating_mul(count)).is_err() {
        return Err(vec![wording::too_many_bits(header[0].1)]);
    }
    let row = |line: Vec<Cell<'_>>| {
        let mut bits = Vec::with_capacity(width);
        for (column, (word, _)) in columns.iter().zip(&line) {
            push_bits(&mut bits, word, column.width);
        }
        FileRow { bits, span: span(&line) }
    };
    let rows = rows.map(row).collect();
    Ok(RowFile { columns, rows })
}

fn span(line: &[Cell<'_>]) -> Span {
    line[0].1.to(line[line.len() - 1].1)
}

fn lines(text: &str, file: FileId) -> impl Iterator<Item = Vec<Cell<'_>>> + Clone {
    let mut start = 0;
    text.split_inclusive('\n').filter_map(move |line| {
        let own = start;
        start += line.len();
        let code = line.split('#').next().unwrap_or("");
        if code.trim().is_empty() {
            return None;
        }
        let cells = code.split(',').map(|cell| {
            let word = cell.trim();
            let word = word.strip_prefix('"').and_then(|word| word.strip_suffix('"')).unwrap_or(word).trim();
            let at = own + (word.as_ptr() as usize - line.as_ptr() as usize);
            (word, Span::new(file, at, at + word.len()))
        });
        Some(cells.collect())
    })
}

fn columns(header: &[Cell<'_>]) -> Result<Vec<RowColumn>, Vec<Diagnostic>> {
    if header.iter().all(|(name, _)| number_width(name).is_some()) {
        return Err(vec![wording::no_header(header[0].1)]);
    }
    let mut errors = Vec::new();
    let mut known = BTreeMap::new();
    for &(name, span) in header {
        if name.is_empty() {
            errors.push(wording::unnamed(span));
        } else if Limit::FileNameBytes.permit(name.len() as u64).is_err() {
            errors.push(wording::long_name(name.len(), span));
        } else if let Some(first) = known.insert(name, span) {
            errors.push(wording::twice(name, first, span));
        }
        if errors.len() == MOST_ERRORS {
            break;
        }
    }
    let column = |&(name, span): &Cell<'_>| RowColumn { name: name.to_owned(), width: 1, is_output: None, span };
    if errors.is_empty() { Ok(header.iter().map(column).collect()) } else { Err(errors) }
}

fn widen(columns: &mut [RowColumn], line: &[Cell<'_>], span: Span) -> Result<(), Diagnostic> {
    if line.len() != columns.len() {
        return Err(wording::row_width(line.len(), columns.len(), span));
    }
    for (column, &(word, span)) in columns.iter_mut().zip(line) {
        if matches!(word, "" | "-") {
            continue;
        }
        let width = number_width(word).ok_or_else(|| wording::not_a_number(word, &column.name, span))?;
        Limit::Width.permit(width as u64).map_err(|_| wording::wide_value(&column.name, width, span))?;
        column.width = column.width.max(width);
    }
    Ok(())
}

fn hexadecimal(word: &str) -> Option<&str> {
    word.strip_prefix("0x").or_else(|| word.strip_prefix("0X"))
}

fn decimal(word: &str) -> Option<u128> {
    word.parse().ok().filter(|_| word.bytes().all(|digit| digit.is_ascii_digit()))
}

/// Without zeros before the first 1 of a decimal number; four bits for each hexadecimal digit.
fn number_width(word: &str) -> Option<usize> {
    match hexadecimal(word) {
        Some(digits) => {
            let is_number = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
            is_number.then_some(4 * digits.len())
        }
        None => decimal(word).map(|value| (u128::BITS - value.leading_zeros()).max(1) as usize),
    }
}

fn push_bits(bits: &mut Vec<Option<bool>>, word: &str, width: usize) {
    let Some(own) = number_width(word) else { return bits.extend(std::iter::repeat_n(None, width)) };
    bits.extend(std::iter::repeat_n(Some(false), width - own));
    let mut push = |value: u128, width: usize| bits.extend((0..width).rev().map(|bit| Some(value >> bit & 1 == 1)));
    match hexadecimal(word) {
        Some(digits) => digits.chars().filter_map(|digit| digit.to_digit(16)).for_each(|digit| push(digit.into(), 4)),
        None => push(decimal(word).unwrap_or(0), own),
    }
}
