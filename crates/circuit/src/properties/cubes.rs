//! Sets of states: a cube has all states in which some registers have given values, and a clause is what all other
//! states fulfill.

use crate::clause::Literal;
use crate::properties::system::TransitionSystem;

/// Registers with their values, in order of the registers.
pub(super) type Cube = Vec<Literal>;

/// Whether no state of a cube may be the first of a run.
pub(super) fn excludes_start(system: &TransitionSystem, cube: &[Literal]) -> bool {
    cube.iter().any(|&(at, value)| system.registers[at].start == Some(!value))
}

/// Whether each state of `small` is in `large`.
pub(super) fn contains(large: &[Literal], small: &[Literal]) -> bool {
    large.iter().all(|literal| small.binary_search(literal).is_ok())
}
