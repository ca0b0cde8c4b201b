//! Rows as CSV: names of columns in the first line, then a line of numbers for each row.

use std::collections::BTreeMap;

use super::file::{FileRow, RowColumn, RowFile};
use super::wording::{MOST_ERRORS, RowFileError};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, Span};

/// A word of a line with its place, without blanks and quotes around it.
type Cell<'t> = (&'t str, Span);

/// Reads a file. A number is decimal, or hexadecimal after `0x`, where each digit stands for four bits; a cell that is
/// empty or `-` is any value. Text after `#` is a comment.
///
/// # Errors
/// The errors of the text, with their places.
pub(super) fn read(text: &str, file: FileId) -> Result<RowFile, Vec<Diagnostic>> {
    let mut lines = lines(text, file);
    let header = lines.next().ok_or_else(|| vec![RowFileError::Empty.at(Span::new(file, 0, 0))])?;
    let mut columns = columns(&header)?;
    let (mut values, mut errors) = (Vec::new(), Vec::new());
    for line in lines {
        let span = line[0].1.to(line[line.len() - 1].1);
        if Limit::Rows.permit(values.len() as u64 + 1).is_err() {
            errors.push(RowFileError::TooManyRows.at(span));
            break;
        }
        match row(&line, &columns, span) {
            Ok(row) => values.push((row, span)),
            Err(error) => errors.push(error),
        }
        if errors.len() == MOST_ERRORS {
            break;
        }
    }
    if errors.is_empty() && values.is_empty() {
        errors.push(RowFileError::NoRows.at(header[0].1));
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    for (row, _) in &values {
        for (column, digits) in columns.iter_mut().zip(row) {
            column.width = column.width.max(digits.as_ref().map_or(1, Vec::len));
        }
    }
    let width: usize = columns.iter().map(|column| column.width).sum();
    if Limit::RowBits.permit((width as u64).saturating_mul(values.len() as u64)).is_err() {
        return Err(vec![RowFileError::TooManyBits.at(header[0].1)]);
    }
    let widened = |(row, span): (Vec<Option<Vec<bool>>>, Span)| {
        let mut bits = Vec::with_capacity(width);
        for (column, digits) in columns.iter().zip(row) {
            match digits {
                None => bits.extend(std::iter::repeat_n(None, column.width)),
                Some(digits) => {
                    bits.extend(std::iter::repeat_n(Some(false), column.width - digits.len()));
                    bits.extend(digits.into_iter().map(Some));
                }
            }
        }
        FileRow { bits, span }
    };
    let rows = values.into_iter().map(widened).collect();
    Ok(RowFile { columns, rows })
}

/// The lines that have something, as their cells.
fn lines(text: &str, file: FileId) -> impl Iterator<Item = Vec<Cell<'_>>> {
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
    if header.iter().all(|(name, _)| digits(name).is_some()) {
        return Err(vec![RowFileError::NoHeader.at(header[0].1)]);
    }
    let mut errors = Vec::new();
    let mut known = BTreeMap::new();
    for &(name, span) in header {
        if name.is_empty() {
            errors.push(RowFileError::Unnamed.at(span));
        } else if Limit::FileNameBytes.permit(name.len() as u64).is_err() {
            errors.push(RowFileError::LongName { bytes: name.len() }.at(Span { end: span.start + 20, ..span }));
        } else if let Some(first) = known.insert(name, span) {
            errors.push(RowFileError::Twice { name: name.to_owned(), first }.at(span));
        }
        if errors.len() == MOST_ERRORS {
            break;
        }
    }
    let column = |&(name, span): &Cell<'_>| RowColumn { name: name.to_owned(), width: 1, is_output: None, span };
    if errors.is_empty() { Ok(header.iter().map(column).collect()) } else { Err(errors) }
}

/// The bits of each cell of a row; `None` is any value.
fn row(line: &[Cell<'_>], columns: &[RowColumn], span: Span) -> Result<Vec<Option<Vec<bool>>>, Diagnostic> {
    if line.len() != columns.len() {
        return Err(RowFileError::Width { values: line.len(), columns: columns.len() }.at(span));
    }
    let value = |(&(word, span), column): (&Cell<'_>, &RowColumn)| match word {
        "" | "-" => Ok(None),
        _ => match digits(word) {
            Some(bits) => Ok(Some(bits)),
            None => Err(RowFileError::NotANumber { word: word.to_owned(), column: column.name.clone() }.at(span)),
        },
    };
    line.iter().zip(columns).map(value).collect()
}

/// The bits of a number, at least one: those of a decimal number without zeros before the first 1, and four for each
/// hexadecimal digit.
fn digits(word: &str) -> Option<Vec<bool>> {
    let bits = |value: u128, width: u32| (0..width).rev().map(move |bit| value >> bit & 1 == 1);
    if let Some(hexadecimal) = word.strip_prefix("0x").or_else(|| word.strip_prefix("0X")) {
        let values: Option<Vec<u32>> = hexadecimal.chars().map(|digit| digit.to_digit(16)).collect();
        let values = values.filter(|values| !values.is_empty())?;
        return Some(values.into_iter().flat_map(|value| bits(value.into(), 4)).collect());
    }
    let is_decimal = !word.is_empty() && word.bytes().all(|digit| digit.is_ascii_digit());
    let value: u128 = word.parse().ok().filter(|_| is_decimal)?;
    Some(bits(value, (128 - value.leading_zeros()).max(1)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: Result<&[&str], &str>) {
        let read = read(text, FileId(0));
        let shown = read.map(|file| {
            let digit = |bit: &Option<bool>| bit.map_or('-', |bit| if bit { '1' } else { '0' });
            file.rows.iter().map(|row| row.bits.iter().map(digit).collect()).collect::<Vec<String>>()
        });
        let shown = shown.map_err(|faults| faults[0].message.clone());
        assert_eq!(shown, expected.map(|rows| rows.iter().map(|&row| row.to_owned()).collect()).map_err(str::to_owned));
    }

    #[test]
    fn cells_are_numbers_and_columns_as_wide_as_these_need() {
        check("a,b,c\n1,5,0x0f\n0,-,\n", Ok(&["110100001111", "0-----------"]));
        check("# comment\n\"a\" , b\r\n 2,\"1\"\r\n\r\n1,0 # one\n", Ok(&["101", "010"]));
    }

    #[test]
    fn other_texts_are_refused() {
        check("", Err("file has no columns"));
        check("a,b\n", Err("file has no rows"));
        check("0,1\n1,1\n", Err("file has no names of columns"));
        check("a,,b\n0,0,0\n", Err("column has no name"));
        check("a,b,a\n0,0,0\n", Err("column `a` is there twice"));
        check("a,b\n0,1,1\n", Err("row has 3 values for 2 columns"));
        check("a,b\n0,-1\n", Err("`-1` is not a value of `b`"));
        check("a,b\n0,1.5\n", Err("`1.5` is not a value of `b`"));
        check("a,b\n0,0x\n", Err("`0x` is not a value of `b`"));
    }
}
