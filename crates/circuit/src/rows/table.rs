//! The rows of a PLA: those that it lists, or all rows of a table whose ones it lists.

use std::collections::BTreeMap;

use super::wording;
use super::{FileRow, RowColumn, RowFile};
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
            return Err(vec![wording::twice(name, first, *span)]);
        }
    }
    let rows = if pla.kind.is_listed() { listed(&pla) } else { all(&pla) };
    let rows = rows.map_err(|error| vec![error])?;
    if rows.is_empty() {
        return Err(vec![wording::no_rows(start)]);
    }
    Ok(RowFile { columns, rows })
}

fn permit(pla: &Pla, rows: u64, span: Span) -> Result<(), Diagnostic> {
    let width = (pla.inputs.len() + pla.outputs.len()) as u64;
    Limit::Rows.permit(rows).map_err(|_| wording::too_many_rows(span))?;
    Limit::RowBits.permit(rows.saturating_mul(width)).map_err(|_| wording::too_many_bits(span))
}

fn listed(pla: &Pla) -> Result<Vec<FileRow>, Diagnostic> {
    let mut count = 0u64;
    for cube in &pla.cubes {
        let open = cube.inputs.iter().filter(|&&digit| digit == b'-').count();
        Limit::TriedBits.permit(open as u64).map_err(|_| wording::open_inputs(open, cube.span))?;
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
    Limit::TriedBits.permit(inputs as u64).map_err(|_| wording::ones_only(inputs, pla.kind_span))?;
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

fn patterns(digits: &[u8]) -> impl Iterator<Item = Vec<bool>> {
    let open: Vec<usize> = (0..digits.len()).filter(|&at| digits[at] == b'-').collect();
    (0..1usize << open.len()).map(move |number| {
        let mut bits: Vec<bool> = digits.iter().map(|&digit| digit == b'1').collect();
        open.iter().rev().enumerate().for_each(|(bit, &at)| bits[at] = number >> bit & 1 == 1);
        bits
    })
}
