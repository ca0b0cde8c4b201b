//! What is true of the registers in every reachable state: clauses, each of which says that one of its registers has a
//! certain value.
//!
//! The states of few registers are enumerated. For more, pairs of values that never occur together in a simulation are
//! candidates, and that one register of a set is always 1. Candidates that induction refutes are removed until it
//! proves all that are left (Flanagan and Leino, Houdini, 2001).

use std::collections::BTreeSet;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::clause::{Clause, ValuedBit};
use crate::proof::SatSweep;
use crate::reachable::cycle::{Cycle, filled};

const CYCLES: usize = 256;
/// The most registers for which pairs are compared, and the most candidates.
const MOST_REGISTERS: usize = 200;
const MOST_CANDIDATES: usize = 4_000;

pub(super) struct Invariant {
    pub(super) clauses: Vec<Clause>,
    pub(super) states: Option<u64>,
}

impl Invariant {
    pub(super) fn of(cycle: &Cycle, histories: &[Vec<u64>]) -> Self {
        let (clauses, states) = match cycle.reachable() {
            Some(reached) => (forbidding(&reached, cycle.start.len()), Some(reached.len() as u64)),
            None => (inductive(cycle, candidates(histories)), None),
        };
        let proved = refuted(cycle, &clauses).is_empty() && clauses.iter().all(|clause| holds_in(clause, &cycle.start));
        assert!(proved, "the clauses hold at the start and in the next state of each state in which they hold");
        Self { clauses, states }
    }
}

/// The values of the registers and of all other inputs in a random simulation from the start, `words[input][cycle]`.
pub(super) fn simulate(cycle: &Cycle) -> Vec<Vec<u64>> {
    let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6372_6561_6368);
    let mut now: Vec<u64> = cycle.start.iter().map(|&value| filled(value)).collect();
    let mut words = vec![Vec::new(); cycle.network.inputs];
    for _ in 0..CYCLES {
        for (input, words) in words.iter_mut().enumerate() {
            words.push(if cycle.is_register(input) { now[input - cycle.ports] } else { random.next_u64() });
        }
        let inputs: Vec<u64> = words.iter().map(|words| *words.last().expect("a cycle was added")).collect();
        now = cycle.next(&inputs);
    }
    words
}

fn holds_in(clause: &Clause, state: &[bool]) -> bool {
    clause.iter().any(|&(at, value)| state[at] == value)
}

/// Clauses that exactly the other states of these registers violate: each forbids as many of them as it can.
fn forbidding(reached: &BTreeSet<u64>, registers: usize) -> Vec<Clause> {
    // The states that agree with `state` in the bits of `mask`.
    let mut cubes: Vec<(u64, u64)> = Vec::new();
    for state in (0..1 << registers).filter(|state| !reached.contains(state)) {
        if cubes.iter().any(|&(mask, bits)| state & mask == bits) {
            continue;
        }
        let whole = (1u64 << registers) - 1;
        let mask = (0..registers).fold(whole, |mask, at| {
            let wider = mask & !(1 << at);
            let free = reached.iter().all(|other| other & wider != state & wider);
            if free { wider } else { mask }
        });
        cubes.push((mask, state & mask));
    }
    let literals = |(mask, bits): (u64, u64)| {
        (0..registers).filter(|at| mask >> at & 1 == 1).map(|at| (at, bits >> at & 1 == 0)).collect()
    };
    cubes.into_iter().map(literals).collect()
}

/// The clauses that no state of a simulation violates: of pairs, and of sets of which at most one is 1.
fn candidates(histories: &[Vec<u64>]) -> Vec<Clause> {
    let registers = histories.len();
    if registers > MOST_REGISTERS {
        return Vec::new();
    }
    let literal = |(at, value): ValuedBit, cycle: usize| histories[at][cycle] ^ filled(!value);
    let holds =
        |clause: &Clause| (0..CYCLES).all(|cycle| clause.iter().fold(0, |any, &one| any | literal(one, cycle)) == !0);
    let exclusive = |a: usize, b: usize| holds(&vec![(a, false), (b, false)]);
    let mut found: Vec<Clause> = Vec::new();
    let mut sets: Vec<Vec<usize>> = Vec::new();
    for at in 0..registers {
        match sets.iter_mut().find(|set| set.iter().all(|&other| exclusive(other, at))) {
            Some(set) => set.push(at),
            None => sets.push(vec![at]),
        }
    }
    found.extend(sets.iter().filter(|set| set.len() > 2).map(|set| set.iter().map(|&at| (at, true)).collect()));
    for values in [[false, false], [false, true], [true, false], [true, true]] {
        for b in 1..registers {
            found.extend((0..b).map(|a| vec![(a, values[0]), (b, values[1])]));
        }
    }
    found.retain(holds);
    found.truncate(MOST_CANDIDATES);
    found
}

/// The largest part of the clauses that follows from itself in the cycle before.
fn inductive(cycle: &Cycle, mut clauses: Vec<Clause>) -> Vec<Clause> {
    loop {
        let refuted = refuted(cycle, &clauses);
        if refuted.is_empty() {
            return clauses;
        }
        let mut at = 0..;
        clauses.retain(|_| !refuted.contains(&at.next().expect("numbers do not end")));
    }
}

/// The clauses that do not hold in the next state of some state in which all hold.
fn refuted(cycle: &Cycle, clauses: &[Clause]) -> BTreeSet<usize> {
    let mut sweep = SatSweep::new(cycle.network.inputs);
    for clause in clauses {
        sweep.assume(&clause.iter().map(|&(at, value)| (cycle.register(at), value)).collect::<Vec<_>>());
    }
    let signals = sweep.add(&cycle.network);
    let next = |at: usize| signals[cycle.network.outputs[at] as usize];
    let mut refuted = BTreeSet::new();
    for (number, clause) in clauses.iter().enumerate() {
        if refuted.contains(&number) {
            continue;
        }
        let violated: Vec<_> = clause.iter().map(|&(at, value)| (next(at), !value)).collect();
        if let Some(inputs) = sweep.pattern(&violated) {
            let words: Vec<u64> = inputs.into_iter().map(filled).collect();
            let state: Vec<bool> = cycle.next(&words).into_iter().map(|word| word & 1 == 1).collect();
            refuted.extend((0..clauses.len()).filter(|&other| !holds_in(&clauses[other], &state)));
        }
    }
    refuted
}
