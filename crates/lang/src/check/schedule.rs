//! Schedules of stimuli, and rows of bits in general.

use crate::check::images::Stimuli;
use crate::check::names::{Home, NameTable};
use crate::check::quantity;
use crate::check::wording;
use crate::syntax::tree;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{NamedImages, NamedSchedule, Pattern, Schedule, Spell};
use nbc_base::source::Span;

#[derive(Clone, Copy)]
pub(crate) struct DeclaredImages<'a> {
    pub(crate) names: &'a NameTable<Option<usize>>,
    pub(crate) declared: &'a [NamedImages],
}

pub(crate) fn schedule(
    source: &tree::ScheduleSyntax,
    home: Home,
    stimuli: Stimuli<'_>,
    images: DeclaredImages<'_>,
    faults: &mut Vec<Diagnostic>,
) -> Option<NamedSchedule> {
    let before = faults.len();
    let mut columns = Vec::new();
    let mut shown = None;
    for name in &source.columns {
        let found = stimuli.resolve(name, home).map(|(stimulus, size)| {
            shown = shown.or(size.map(|_| (name, stimulus)));
            stimulus
        });
        match found {
            Ok(stimulus) if columns.contains(&stimulus) => {
                let first = source.columns.iter().find(|first| first.text == name.text).expect("it was there before");
                faults.push(wording::duplicate("stimulus", name, first.span));
            }
            Ok(stimulus) => columns.push(stimulus),
            Err(fault) => faults.push(fault),
        }
    }
    if let Some((name, stimulus)) = shown {
        if source.columns.len() > 1 {
            faults.push(wording::image_beside_stimuli(name));
            return None;
        }
        return of_images(source, (name, stimulus), home, images, faults).filter(|_| faults.len() == before);
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
        faults.push(wording::empty_schedule(&source.name));
    }
    let name = source.name.text.clone();
    (faults.len() == before).then_some(NamedSchedule { name, stimuli: columns, schedule, sets: Vec::new() })
}

/// Each row shows the images of a set one after another, each for its time.
fn of_images(
    source: &tree::ScheduleSyntax,
    (column, stimulus): (&tree::NameSyntax, usize),
    home: Home,
    images: DeclaredImages<'_>,
    faults: &mut Vec<Diagnostic>,
) -> Option<NamedSchedule> {
    if source.spells.is_empty() {
        faults.push(wording::empty_schedule(&source.name));
    }
    let (name, stimuli) = (source.name.text.clone(), vec![stimulus]);
    let mut shown = NamedSchedule { name, stimuli, schedule: Schedule::default(), sets: Vec::new() };
    for spell in &source.spells {
        let steps = quantity::steps(&spell.length).map_err(|fault| faults.push(fault)).ok();
        let [cell] = &spell.cells[..] else {
            faults.push(wording::row_width(spell.cells.len(), 1, spell.span));
            continue;
        };
        let found = images.names.resolve(cell, home).map_err(|fault| faults.push(fault)).ok().flatten();
        // The error of a set that has one is already reported.
        let Some(set) = found.map(|at| &images.declared[at]) else { continue };
        if !shown.stimuli.contains(&set.stimulus) {
            faults.push(wording::other_stimulus(cell, &column.text));
            continue;
        }
        let before = shown.sets.len();
        // The error of a row without a time is already reported.
        shown.show(set, steps.unwrap_or(1));
        if before == NamedSchedule::MOST_SETS && shown.sets.len() > before {
            faults.push(wording::many_sets(before, cell.span));
        }
    }
    Some(shown)
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
        faults.push(wording::row_width(cells.len(), columns, span));
        return None;
    }
    let mut bits = Vec::new();
    for cell in cells {
        match cell.text.as_str() {
            "0" => bits.push(false),
            "1" => bits.push(true),
            _ => faults.push(wording::not_a_stimulus(cell)),
        }
    }
    (bits.len() == columns).then_some(bits)
}
