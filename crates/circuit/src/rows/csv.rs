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
pub(super) fn read(text: &str, file: FileId) -> Result<RowFile, Vec<Diagnostic>> {
    let mut lines = lines(text, file);
    let header = lines.next().ok_or_else(|| vec![RowFileError::Empty.at(Span::new(file, 0, 0))])?;
    let mut columns = columns(&header)?;
    // Nothing is made of a row before the bits of all are counted.
    let rows = lines.clone();
    let (mut count, mut errors) = (0, Vec::new());
    for line in lines {
        let span = span(&line);
        if Limit::Rows.permit(count + 1).is_err() {
            errors.push(RowFileError::TooManyRows.at(span));
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
        errors.push(RowFileError::NoRows.at(header[0].1));
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let width: usize = columns.iter().map(|column| column.width).sum();
    if Limit::RowBits.permit((width as u64).saturating_mul(count)).is_err() {
        return Err(vec![RowFileError::TooManyBits.at(header[0].1)]);
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

/// The part of a long word that a message shows.
fn beginning(span: Span) -> Span {
    Span { end: span.end.min(span.start + 20), ..span }
}

fn span(line: &[Cell<'_>]) -> Span {
    line[0].1.to(line[line.len() - 1].1)
}

/// The lines that have something, as their cells.
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
        return Err(vec![RowFileError::NoHeader.at(header[0].1)]);
    }
    let mut errors = Vec::new();
    let mut known = BTreeMap::new();
    for &(name, span) in header {
        if name.is_empty() {
            errors.push(RowFileError::Unnamed.at(span));
        } else if Limit::FileNameBytes.permit(name.len() as u64).is_err() {
            errors.push(RowFileError::LongName { bytes: name.len() }.at(beginning(span)));
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

/// Makes columns as wide as the numbers of a row need.
fn widen(columns: &mut [RowColumn], line: &[Cell<'_>], span: Span) -> Result<(), Diagnostic> {
    if line.len() != columns.len() {
        return Err(RowFileError::Width { values: line.len(), columns: columns.len() }.at(span));
    }
    for (column, &(word, span)) in columns.iter_mut().zip(line) {
        if matches!(word, "" | "-") {
            continue;
        }
        let no_number =
            || RowFileError::NotANumber { word: word.to_owned(), column: column.name.clone() }.at(beginning(span));
        let width = number_width(word).ok_or_else(no_number)?;
        let wide = |_| RowFileError::Wide { column: column.name.clone(), bits: width }.at(beginning(span));
        Limit::Width.permit(width as u64).map_err(wide)?;
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

/// The bits of a number, at least one: those of a decimal number without zeros before the first 1, and four for each
/// hexadecimal digit.
fn number_width(word: &str) -> Option<usize> {
    match hexadecimal(word) {
        Some(digits) => {
            let is_number = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
            is_number.then_some(4 * digits.len())
        }
        None => decimal(word).map(|value| (u128::BITS - value.leading_zeros()).max(1) as usize),
    }
}

/// Adds the bits of a value in a column of so many.
fn push_bits(bits: &mut Vec<Option<bool>>, word: &str, width: usize) {
    let Some(own) = number_width(word) else { return bits.extend(std::iter::repeat_n(None, width)) };
    bits.extend(std::iter::repeat_n(Some(false), width - own));
    let mut push = |value: u128, width: usize| bits.extend((0..width).rev().map(|bit| Some(value >> bit & 1 == 1)));
    match hexadecimal(word) {
        Some(digits) => digits.chars().filter_map(|digit| digit.to_digit(16)).for_each(|digit| push(digit.into(), 4)),
        None => push(decimal(word).unwrap_or(0), own),
    }
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
        let long = |digits: usize| format!("a,q\n0x{},1\n0,0\n", "f".repeat(digits));
        let most = Limit::Width.most() as usize / 4;
        assert_eq!(read(&long(most), FileId(0)).map(|file| file.columns[0].width), Ok(4 * most));
        check(&long(most + 1), Err("value of `a` has 1048580 bits"));
        let widest = format!("0x{}", "f".repeat(most));
        let many = format!("a,b,c,q\n{widest},{widest},{widest},1\n{}", "0,0,0,1\n".repeat(30));
        check(&many, Err("the rows of the file have more than 67108864 bits"));
    }
}
