//! The rows of a PLA: those that it lists, or all rows of a table whose ones it lists.

use std::collections::BTreeMap;

use super::file::{FileRow, RowColumn, RowFile};
use super::wording::RowFileError;
use crate::formats::pla::{Pla, PlaCube};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::Span;

/// The rows of a PLA. In those of type `fr` and `fdr`, a row for each line, or several if it leaves inputs open. Those
/// of type `f` and `fd` say what the outputs are for all inputs, so there is a row for each.
pub(super) fn rows(pla: Pla) -> Result<RowFile, Vec<Diagnostic>> {
    let start = pla.kind_span;
    let side = |ports: &[(String, Span)], is_output| {
        let column = move |(name, span): &(String, Span)| RowColumn {
            name: name.clone(),
            width: 1,
            is_output: Some(is_output),
            span: *span,
        };
        ports.iter().map(column).collect::<Vec<_>>()
    };
    let columns = [side(&pla.inputs, false), side(&pla.outputs, true)].concat();
    let mut known = BTreeMap::new();
    for RowColumn { name, span, .. } in &columns {
        if let Some(first) = known.insert(name, *span) {
            return Err(vec![RowFileError::Twice { name: name.clone(), first }.at(*span)]);
        }
    }
    let rows = if pla.kind.is_listed() { listed(&pla) } else { all(&pla) };
    let rows = rows.map_err(|error| vec![error])?;
    if rows.is_empty() {
        return Err(vec![RowFileError::NoRows.at(start)]);
    }
    Ok(RowFile { columns, rows })
}

/// Whether there is room for so many rows of a PLA.
fn permit(pla: &Pla, rows: u64, span: Span) -> Result<(), Diagnostic> {
    let width = (pla.inputs.len() + pla.outputs.len()) as u64;
    Limit::Rows.permit(rows).map_err(|_| RowFileError::TooManyRows.at(span))?;
    Limit::RowBits.permit(rows.saturating_mul(width)).map_err(|_| RowFileError::TooManyBits.at(span))
}

fn listed(pla: &Pla) -> Result<Vec<FileRow>, Diagnostic> {
    let mut count = 0u64;
    for cube in &pla.cubes {
        let open = cube.inputs.iter().filter(|&&digit| digit == b'-').count();
        Limit::TriedBits.permit(open as u64).map_err(|_| RowFileError::OpenInputs { open }.at(cube.span))?;
        count += 1 << open;
        permit(pla, count, cube.span)?;
    }
    let rows = pla.cubes.iter().flat_map(|cube| {
        patterns(&cube.inputs).map(|inputs| {
            let outputs = cube.outputs.iter().map(|said| said.flatten());
            FileRow { bits: inputs.into_iter().map(Some).chain(outputs).collect(), span: cube.span }
        })
    });
    Ok(rows.collect())
}

fn all(pla: &Pla) -> Result<Vec<FileRow>, Diagnostic> {
    let inputs = pla.inputs.len();
    let too_many = |_| RowFileError::OnesOnly { inputs }.at(pla.kind_span);
    Limit::TriedBits.permit(inputs as u64).map_err(too_many)?;
    permit(pla, 1 << inputs, pla.kind_span)?;
    let mut outputs = vec![Some(false); pla.outputs.len() << inputs];
    let mut spans = vec![pla.kind_span; 1 << inputs];
    let mut say = |cube: &PlaCube, wanted: Option<bool>| {
        for pattern in patterns(&cube.inputs) {
            let row = pattern.iter().fold(0, |row, &bit| row << 1 | usize::from(bit));
            spans[row] = cube.span;
            for (at, &said) in cube.outputs.iter().enumerate() {
                if said == Some(wanted) {
                    outputs[row * pla.outputs.len() + at] = wanted;
                }
            }
        }
    };
    // A 1 is stronger than an open output, as in espresso.
    pla.cubes.iter().for_each(|cube| say(cube, None));
    pla.cubes.iter().for_each(|cube| say(cube, Some(true)));
    let row = |row: usize| {
        let inputs = (0..inputs).rev().map(|bit| Some(row >> bit & 1 == 1));
        let outputs = &outputs[row * pla.outputs.len()..][..pla.outputs.len()];
        FileRow { bits: inputs.chain(outputs.iter().copied()).collect(), span: spans[row] }
    };
    Ok((0..1 << inputs).map(row).collect())
}

/// The inputs that digits stand for, in counting order.
fn patterns(digits: &[u8]) -> impl Iterator<Item = Vec<bool>> {
    let open: Vec<usize> = (0..digits.len()).filter(|&at| digits[at] == b'-').collect();
    (0..1usize << open.len()).map(move |number| {
        let mut bits: Vec<bool> = digits.iter().map(|&digit| digit == b'1').collect();
        open.iter().rev().enumerate().for_each(|(bit, &at)| bits[at] = number >> bit & 1 == 1);
        bits
    })
}

#[cfg(test)]
mod tests {
    use crate::rows::RowFormat;
    use nbc_base::source::FileId;

    fn check(text: &str, expected: Result<&[&str], &str>) {
        let shown = RowFormat::Pla.parse(text, FileId(0)).map(|file| {
            let digit = |bit: &Option<bool>| bit.map_or('-', |bit| if bit { '1' } else { '0' });
            file.rows.iter().map(|row| row.bits.iter().map(digit).collect()).collect::<Vec<String>>()
        });
        let shown = shown.map_err(|faults| faults[0].message.clone());
        assert_eq!(shown, expected.map(|rows| rows.iter().map(|&row| row.to_owned()).collect()).map_err(str::to_owned));
    }

    #[test]
    fn rows_are_listed_or_those_of_the_whole_table() {
        check(".i 2\n.o 1\n.type fr\n1- 1\n00 0\n", Ok(&["101", "111", "000"]));
        check(".i 2\n.o 2\n.type fdr\n11 -0\n01 ~1\n", Ok(&["11-0", "01-1"]));
        check(".i 2\n.o 1\n-1 -\n11 1\n", Ok(&["000", "01-", "100", "111"]));
        check(".i 1\n.o 2\n.type f\n1 10\n", Ok(&["000", "110"]));
    }

    #[test]
    fn other_tables_are_refused() {
        check(".i 17\n.o 1\n", Err("a PLA of this type describes all rows of 17 inputs"));
        let open = format!(".i 17\n.o 1\n.type fr\n{} 1\n", "-".repeat(17));
        check(&open, Err("row leaves 17 inputs open"));
        let many = format!(".i 16\n.o 1\n.type fr\n{}", format!("{} 1\n", "-".repeat(16)).repeat(20));
        check(&many, Err("file has more than 200000 rows"));
        check(".i 1\n.o 1\n.type fr\n", Err("file has no rows"));
        check(".i 2\n.o 1\n.ilb a a\n.ob q\n11 1\n", Err("column `a` is there twice"));
    }
}
