//! A robot library as a cell library for the compiler: the available functions, and the delay of each robot.

use nbc_base::model::{Character, Function, Library, Pattern, Robot};
use nbc_circuit::{CellKind, CellLibrary, MappingObjective};

/// The library with the robots first that suit the objective: those with the shortest clocks for the delay, those with
/// the widest margins for the margin, those that bear the largest changes of the world for sturdiness. For the area,
/// the order stays.
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

/// The robots of a library that react within so many cycles, and show nothing else before if that is one. All cost a
/// wave machine one beat, and an error would stay in it, so the sturdiest are first, or the widest where the objective
/// is the margin.
pub fn within_beat(library: &Library, beat: u32, objective: MappingObjective) -> Library {
    let is_quick = |robot: &&Robot| {
        let character = &robot.character;
        character.clock <= beat && (beat > 1 || character.glitch_rate == 0.0)
    };
    let quick = Library { robots: library.robots.iter().filter(is_quick).cloned().collect() };
    prefer(quick, if objective == MappingObjective::Margin { objective } else { MappingObjective::Sturdy })
}

/// The cells of a library: for each function its first robot, or else the first that computes it with exchanged inputs.
/// [`super::assemble`] makes the same choice.
pub fn cells(library: &Library) -> CellLibrary {
    Function::all().filter_map(|function| Some((function, kind(library, function)?))).collect()
}

/// The robot for a function, and whether its stimuli must be exchanged.
pub(super) fn choose(library: &Library, function: Function) -> Option<(&Robot, bool)> {
    let straight = library.robots_for(function).next().map(|robot| (robot, false));
    straight.or_else(|| library.robots_for(function.swapped()).next().map(|robot| (robot, true)))
}

fn kind(library: &Library, function: Function) -> Option<CellKind> {
    let (robot, exchanged) = choose(library, function)?;
    let character = &robot.character;
    let mut kind = CellKind::uniform(character.clock, character.margin);
    kind.glitches = character.glitch_rate != 0.0;
    kind.radius = radius(character);
    for transition in &character.settle {
        let index = |pattern: Pattern| {
            let index = pattern.pair_index();
            if exchanged { (index & 1) << 1 | index >> 1 } else { index }
        };
        kind.settle[index(transition.from)][index(transition.to)] = transition.cycles;
    }
    Some(kind)
}
