//! Sets of states: a cube has all states in which some registers have given values, and a clause is what all other
//! states fulfill.

use crate::clause::ValuedBit;
use crate::properties::system::TransitionSystem;

/// Registers with their values, in order of the registers.
pub(super) type Cube = Vec<ValuedBit>;

/// Whether no state of a cube may be the first of a run.
pub(super) fn excludes_start(system: &TransitionSystem, cube: &[ValuedBit]) -> bool {
    cube.iter().any(|&(at, value)| system.registers[at].start == Some(!value))
}

/// Whether each state of `small` is in `large`.
pub(super) fn contains(large: &[ValuedBit], small: &[ValuedBit]) -> bool {
    large.iter().all(|literal| small.binary_search(literal).is_ok())
}
