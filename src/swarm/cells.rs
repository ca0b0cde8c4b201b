//! A robot library as a cell library for the compiler: the available functions, and the delay of each robot.

use crate::circuit::{CellKind, CellLibrary};
use crate::model::{Function, Library, Pattern, Robot};

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
    let mut kind = CellKind::uniform(robot.character.clock, robot.character.margin);
    for transition in &robot.character.settle {
        let index = |pattern: Pattern| {
            let index = pattern.pair_index();
            if exchanged { (index & 1) << 1 | index >> 1 } else { index }
        };
        kind.settle[index(transition.from)][index(transition.to)] = transition.cycles;
    }
    Some(kind)
}
