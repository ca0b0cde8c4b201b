//! A robot library as a cell library for the compiler: the available functions, and the delay of each robot.

use nbc_base::model::{Character, Function, Library, Pattern, Robot};
use nbc_circuit::{CellKind, CellLibrary, MappingObjective};

/// Puts first the robots that suit the objective: the shortest clocks for the delay, the widest margins for the margin,
/// the largest bearable changes of the world for sturdiness. For the area, the order stays.
pub fn prefer(library: Library, objective: MappingObjective) -> Library {
    let mut robots = library.robots;
    let faster = |a: &Character, b: &Character| a.clock.cmp(&b.clock);
    let wider = |a: &Character, b: &Character| b.margin.total_cmp(&a.margin);
    let sturdier = |a: &Character, b: &Character| radius(b).total_cmp(&radius(a));
    match objective {
        MappingObjective::Area => {}
        MappingObjective::Delay => {
            robots.sort_by(|a, b| faster(&a.character, &b.character).then(wider(&a.character, &b.character)));
        }
        MappingObjective::Margin => {
            robots.sort_by(|a, b| wider(&a.character, &b.character).then(faster(&a.character, &b.character)));
        }
        MappingObjective::Sturdy => robots.sort_by(|a, b| {
            let (a, b) = (&a.character, &b.character);
            sturdier(a, b).then(faster(a, b)).then(wider(a, b))
        }),
    }
    Library { robots }
}

/// How far a world may differ before a robot makes errors; 0 if that was not measured.
fn radius(character: &Character) -> f64 {
    character.radius.as_ref().map_or(0.0, |found| found.radius)
}

/// Robots that react within so many cycles, and never glitch if that is one. All cost a wave machine one beat, and an
/// error would stay in it, so the sturdiest come first, or the widest margins by that objective.
pub fn within_beat(library: &Library, beat: u32, objective: MappingObjective) -> Library {
    let is_quick = |robot: &&Robot| {
        let character = &robot.character;
        character.clock <= beat && (beat > 1 || character.glitch_rate == 0.0)
    };
    let quick = Library { robots: library.robots.iter().filter(is_quick).cloned().collect() };
    prefer(quick, if objective == MappingObjective::Margin { objective } else { MappingObjective::Sturdy })
}

/// Functions of two inputs and those that depend on three, with the robots that [`super::assemble`] takes.
pub fn cells(library: &Library) -> CellLibrary {
    let wide = Function::all_of(3).filter(|function| function.arity() == 3);
    Function::all().chain(wide).filter_map(|function| Some((function, kind(library, function)?))).collect()
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fit<'a> {
    pub robot: &'a Robot,
    pub uses: Vec<StimulusUse>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StimulusUse {
    /// A pin of the cell; absent if the cell does not have that pin.
    Pin(usize),
    Constant(bool),
}

impl Fit<'_> {
    pub(super) fn stimuli<T: Clone>(&self, pins: &[T], constant: impl Fn(bool) -> T) -> Vec<T> {
        let stimulus = |one: &StimulusUse| match *one {
            StimulusUse::Pin(pin) => pins.get(pin).cloned().unwrap_or_else(|| constant(false)),
            StimulusUse::Constant(value) => constant(value),
        };
        self.uses.iter().map(stimulus).collect()
    }

    fn pattern(&self, function: Function, row: usize) -> Pattern {
        let pins: Vec<bool> = (0..function.inputs()).map(|input| function.input_at(input, row)).collect();
        Pattern::new(&self.stimuli(&pins, |value| value))
    }
}

/// The first that computes it; else with its inputs in another order; else with constants among three stimuli.
pub(super) fn choose(library: &Library, function: Function) -> Option<Fit<'_>> {
    let straight: Vec<StimulusUse> = (0..function.inputs()).map(StimulusUse::Pin).collect();
    let exact = library.robots_for(function).next().map(|robot| Fit { robot, uses: straight });
    let other = || {
        let uses = uses(function);
        let fit = |robot| uses.iter().map(move |uses| Fit { robot, uses: uses.clone() });
        let alike = |fit: &Fit<'_>| {
            let own = fit.robot.function();
            own.inputs() == fit.uses.len()
                && (0..1 << function.inputs()).all(|row| own.under(fit.pattern(function, row)) == function.row(row))
        };
        library.robots.iter().flat_map(fit).find(alike)
    };
    exact.or_else(other)
}

fn uses(function: Function) -> Vec<Vec<StimulusUse>> {
    use StimulusUse::{Constant, Pin};
    if function.inputs() == 3 {
        return [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]].map(|order| order.map(Pin).into()).into();
    }
    let each = || [Pin(0), Pin(1), Constant(false), Constant(true)];
    let threes = each()
        .into_iter()
        .flat_map(|one| each().into_iter().flat_map(move |two| each().map(|three| vec![one, two, three])));
    let is_once =
        |uses: &Vec<StimulusUse>| [Pin(0), Pin(1)].iter().all(|pin| uses.iter().filter(|one| *one == pin).count() < 2);
    std::iter::once(vec![Pin(1), Pin(0)]).chain(threes.filter(is_once)).collect()
}

fn kind(library: &Library, function: Function) -> Option<CellKind> {
    let fit = choose(library, function)?;
    let character = &fit.robot.character;
    let mut kind = CellKind::uniform(character.clock, character.margin);
    kind.glitches = character.glitch_rate != 0.0;
    kind.radius = radius(character);
    Some(kind)
}
