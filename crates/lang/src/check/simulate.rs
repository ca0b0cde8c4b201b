//! Simulations: the inputs of a swarm over time.

use crate::check::cell::{RowCell, input_cell};
use crate::check::names::{Home, NameTable};
use crate::check::quantity;
use crate::check::wording;
use crate::syntax::tree::{NameSyntax, SpellSyntax, With};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{Base, CYCLE_STEPS, Column, InputSpell, NamedSchedule};
use nbc_base::source::{Sources, Span};

#[derive(Clone, Copy)]
pub(crate) struct Schedules<'a> {
    pub(crate) names: &'a NameTable<Option<usize>>,
    pub(crate) declared: &'a [NamedSchedule],
}

pub(crate) fn spells(
    with: &With,
    swarm: Span,
    inputs: &[Column],
    home: Home,
    schedules: Schedules<'_>,
    sources: &Sources,
    faults: &mut Vec<Diagnostic>,
) -> Vec<InputSpell> {
    match with {
        With::Named(name) => match schedules.names.resolve(name, home) {
            Ok(schedule) => {
                let schedule = schedule.map(|at| &schedules.declared[at]);
                schedule.map_or(Vec::new(), |schedule| named(schedule, name.span, inputs, sources, faults))
            }
            Err(fault) => {
                faults.push(fault);
                Vec::new()
            }
        },
        With::Spells { columns, spells } => {
            let places = places(columns, swarm, inputs, faults);
            spells.iter().filter_map(|spell| rows(spell, &places, inputs, sources, faults)).collect()
        }
    }
}

/// There must be a stimulus for each bit of the inputs, in order.
fn named(
    schedule: &NamedSchedule,
    span: Span,
    inputs: &[Column],
    sources: &Sources,
    faults: &mut Vec<Diagnostic>,
) -> Vec<InputSpell> {
    if !schedule.sets.is_empty() {
        faults.push(wording::images_as_inputs(&schedule.name, span));
        return Vec::new();
    }
    let bits: usize = inputs.iter().map(|column| column.width).sum();
    if bits != schedule.stimuli.len() {
        faults.push(wording::row_width(schedule.stimuli.len(), bits, span));
        return Vec::new();
    }
    let spell = |spell: &nbc_base::model::Spell| {
        let inputs = schedule.stimuli.iter().map(|&stimulus| spell.pattern.has(stimulus)).collect();
        let (cycles, line) = (spell.steps / CYCLE_STEPS, line(sources, span));
        (spell.steps.is_multiple_of(CYCLE_STEPS)).then_some(InputSpell { inputs, bases: Vec::new(), cycles, line })
    };
    let spells: Option<Vec<_>> = schedule.schedule.spells.iter().map(spell).collect();
    spells.unwrap_or_else(|| {
        faults.push(wording::part_of_cycle(&schedule.name, span));
        Vec::new()
    })
}

fn places(columns: &[NameSyntax], swarm: Span, inputs: &[Column], faults: &mut Vec<Diagnostic>) -> Vec<usize> {
    let mut places = Vec::new();
    for name in columns {
        match inputs.iter().position(|input| input.name == name.text) {
            Some(place) => places.push(place),
            None => {
                let meant = Suggestion::of(&name.text, inputs.iter().map(|input| input.name.as_str()));
                faults.push(wording::unknown("input", name, &meant));
            }
        }
    }
    if let Some(missing) = (0..inputs.len()).find(|place| !places.contains(place))
        && places.len() == columns.len()
    {
        let place = columns.last().map_or(swarm, |last| last.span);
        faults.push(wording::missing_input(&inputs[missing].name, place));
    }
    places
}

fn line(sources: &Sources, span: Span) -> usize {
    sources.file(span.file).line_column(span.start as usize).line
}

fn rows(
    spell: &SpellSyntax,
    places: &[usize],
    inputs: &[Column],
    sources: &Sources,
    faults: &mut Vec<Diagnostic>,
) -> Option<InputSpell> {
    let cycles = quantity::cycles(&spell.length).map_err(|fault| faults.push(fault)).ok();
    if spell.cells.len() != places.len() {
        faults.push(wording::row_width(spell.cells.len(), places.len(), spell.span));
        return None;
    }
    let mut bits: Vec<Vec<bool>> = inputs.iter().map(|input| vec![false; input.width]).collect();
    let mut bases: Vec<Base> = inputs.iter().map(Base::of_port).collect();
    for (word, &place) in spell.cells.iter().zip(places) {
        match input_cell(word, &inputs[place]) {
            Ok(RowCell::Bits(values, base)) if values.iter().all(Option::is_some) => {
                bits[place] = values.into_iter().flatten().collect();
                bases[place] = base;
            }
            Ok(_) => faults.push(wording::not_an_input(word)),
            Err(fault) => faults.push(fault),
        }
    }
    Some(InputSpell { inputs: bits.concat(), bases, cycles: cycles?, line: line(sources, spell.span) })
}
