//! The part of an invariant that a proof needs.

use std::collections::BTreeSet;

use crate::clause::ValuedBit;
use crate::properties::solver::Solved;
use crate::properties::system::{Cube, TransitionSystem};
use crate::properties::unrolled::Unrolled;
use nbc_base::source::CancelFlag;

/// The most cubes of an invariant that is made smaller: each call of the solver assumes all of them.
const MOST: usize = 2_000;

/// Cubes among those of an invariant that are one by themselves. If they are too many, all of them.
pub(super) fn needed(
    system: &TransitionSystem,
    property: usize,
    given: &[usize],
    cubes: Vec<Cube>,
    cancel: &CancelFlag,
) -> Vec<Cube> {
    if cubes.len() > MOST {
        return cubes;
    }
    let mut step = Unrolled::new(false, cancel.clone());
    system.constraints.iter().for_each(|&constraint| step.require(system, 0, constraint));
    given.iter().for_each(|&other| step.require(system, 0, system.bad[other] ^ 1));
    let mut active = Vec::new();
    for cube in &cubes {
        let this = step.solver.fresh();
        let mut clause = vec![!this];
        clause
            .extend(cube.iter().map(|&(at, value)| step.literal(system, 0, system.register(at) ^ usize::from(value))));
        step.solver.clause(&clause);
        active.push(this);
    }
    let mut kept = BTreeSet::new();
    // What is to follow: that the property is not violated, and then that no step enters a cube.
    let mut open = vec![vec![step.literal(system, 0, system.bad[property])]];
    while let Some(reached) = open.pop() {
        let assumed = [&active[..], &reached].concat();
        if step.solver.solve(&assumed, u64::MAX) != Solved::No {
            return cubes;
        }
        let used: Vec<usize> = (0..cubes.len()).filter(|&at| step.solver.is_needed(active[at])).collect();
        for at in used {
            if kept.insert(at) {
                let next = |&(at, value): &ValuedBit| system.registers[at].next ^ usize::from(!value);
                open.push(cubes[at].iter().map(|one| step.literal(system, 0, next(one))).collect());
            }
        }
    }
    kept.into_iter().map(|at| cubes[at].clone()).collect()
}
