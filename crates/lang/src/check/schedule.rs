//! Schedules of stimuli, and rows of bits in general.

use crate::check::names::{Home, NameTable, duplicate};
use crate::check::quantity;
use crate::check::wording::{CellError, RowError};
use crate::syntax::tree;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{NamedSchedule, Pattern, Schedule, Spell};
use nbc_base::source::Span;

/// Checks a schedule.
pub(crate) fn schedule(
    source: &tree::ScheduleSyntax,
    home: Home,
    stimuli: &NameTable,
    faults: &mut Vec<Diagnostic>,
) -> Option<NamedSchedule> {
    let before = faults.len();
    let mut columns = Vec::new();
    for name in &source.columns {
        match stimuli.resolve(name, home) {
            Ok(stimulus) if columns.contains(&stimulus) => {
                let first = source.columns.iter().find(|first| first.text == name.text).expect("it was there before");
                faults.push(duplicate("stimulus", name, first.span));
            }
            Ok(stimulus) => columns.push(stimulus),
            Err(fault) => faults.push(fault),
        }
    }
    let mut schedule = Schedule::default();
    for spell in &source.spells {
        let steps = quantity::steps(&spell.length).map_err(|fault| faults.push(fault)).ok();
        let bits = row_of_bits(&spell.cells, source.columns.len(), spell.span, faults);
        if let (Some(steps), Some(bits), true) = (steps, bits, columns.len() == source.columns.len()) {
            schedule.spells.push(Spell::of(pattern(&columns, &bits), steps));
        }
    }
    if source.spells.is_empty() {
        faults.push(RowError::EmptySchedule { schedule: source.name.text.clone() }.at(source.name.span));
    }
    let name = source.name.text.clone();
    (faults.len() == before).then_some(NamedSchedule { name, stimuli: columns, schedule })
}

fn pattern(stimuli: &[usize], bits: &[bool]) -> Pattern {
    let mut present = vec![false; stimuli.iter().max().map_or(0, |most| most + 1)];
    for (&stimulus, &bit) in stimuli.iter().zip(bits) {
        present[stimulus] = bit;
    }
    Pattern::new(&present)
}

fn row_of_bits(
    cells: &[tree::NameSyntax],
    columns: usize,
    span: Span,
    faults: &mut Vec<Diagnostic>,
) -> Option<Vec<bool>> {
    if cells.len() != columns {
        faults.push(RowError::Width { values: cells.len(), columns }.at(span));
        return None;
    }
    let mut bits = Vec::new();
    for cell in cells {
        match cell.text.as_str() {
            "0" => bits.push(false),
            "1" => bits.push(true),
            word => faults.push(CellError::NotAStimulus { word: word.to_owned() }.at(cell.span)),
        }
    }
    (bits.len() == columns).then_some(bits)
}
