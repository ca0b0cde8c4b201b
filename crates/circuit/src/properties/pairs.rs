//! States that are never reached, found at once: registers that keep their value, and pairs of registers that never
//! have some values together. A simulation proposes them, and induction keeps those that follow from each other.
//!
//! C. Flanagan and K. R. M. Leino, Houdini, an annotation assistant for ESC/Java, FME 2001.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::and_graph::AndLiteral;
use crate::clause::ValuedBit;
use crate::properties::solver::Solved;
use crate::properties::system::{Cube, TransitionSystem, excludes_start};
use crate::properties::unrolled::Unrolled;
use nbc_base::source::CancelFlag;

/// Simulations from the start, of 64 runs each.
const SIMULATIONS: usize = 4;

const STEPS: usize = 256;

/// The most registers whose pairs are tried, and the most cubes.
const MOST_REGISTERS: usize = 2_000;
const MOST: usize = 50_000;

const MOST_WORK: u64 = 50_000;

/// Cubes without the start state that no step enters from outside of them; empty if the proof takes too long.
pub(super) fn never_together(system: &TransitionSystem, cancel: &CancelFlag) -> (Vec<Cube>, u64) {
    let relevant = system.relevant();
    if relevant.len() > MOST_REGISTERS {
        return (Vec::new(), 0);
    }
    let mut cubes = History::of(system, relevant).candidates(system);
    let mut work = 0;
    let mut before = usize::MAX;
    while !cubes.is_empty() && cubes.len() < before {
        before = cubes.len();
        if !retain_kept(system, &mut cubes, &mut work, cancel) {
            cubes.clear();
        }
    }
    (cubes, work)
}

/// Keeps the cubes that no step enters from outside of all kept ones. Returns false if the work ended early.
fn retain_kept(system: &TransitionSystem, cubes: &mut Vec<Cube>, work: &mut u64, cancel: &CancelFlag) -> bool {
    let mut step = Unrolled::new(false, cancel.clone());
    system.constraints.iter().for_each(|&constraint| step.require(system, 0, constraint));
    let mut entered = Vec::new();
    for cube in &*cubes {
        let outside: Vec<_> = cube.iter().map(|&bit| !step.literal(system, 0, system.has(bit))).collect();
        step.solver.clause(&outside);
        let this = step.solver.fresh();
        for &bit in cube {
            let next = step.literal(system, 0, system.gets(bit));
            step.solver.clause(&[!this, next]);
        }
        entered.push(this);
    }
    step.solver.clause(&entered);
    let mut is_kept = vec![true; cubes.len()];
    let solved = loop {
        let left = MOST_WORK.saturating_sub(*work + step.solver.work());
        match step.solver.solve(&[], left) {
            Solved::Yes => {}
            solved => break solved,
        }
        let next: Vec<bool> = system.registers.iter().map(|register| step.shows(0, register.next)).collect();
        for (at, cube) in cubes.iter().enumerate() {
            if is_kept[at] && cube.iter().all(|&(register, value)| next[register] == value) {
                is_kept[at] = false;
                step.solver.clause(&[!entered[at]]);
            }
        }
    };
    *work += step.solver.work();
    let mut is_kept = is_kept.into_iter();
    cubes.retain(|_| is_kept.next().expect("a value for each cube"));
    solved == Solved::No
}

struct History {
    relevant: Vec<usize>,
    /// For each of them, its value in each run at each step.
    values: Vec<Vec<u64>>,
    /// The runs at each step in which all constraints hold.
    counts: Vec<u64>,
}

impl History {
    fn of(system: &TransitionSystem, relevant: Vec<usize>) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(0x6e62_6370_6169_7273);
        let mut history = Self { values: vec![Vec::new(); relevant.len()], counts: Vec::new(), relevant };
        for _ in 0..SIMULATIONS {
            let start = |start: Option<bool>| start.map_or_else(|| random.next_u64(), everywhere);
            let mut state: Vec<u64> = system.registers.iter().map(|register| register.start).map(start).collect();
            let mut counts = u64::MAX;
            for _ in 0..STEPS {
                let mut values = vec![0];
                values.extend((0..system.inputs.len()).map(|_| random.next_u64()));
                values.extend(&state);
                for &[a, b] in &system.ands {
                    values.push(word(&values, a) & word(&values, b));
                }
                counts = system.constraints.iter().fold(counts, |all, &constraint| all & word(&values, constraint));
                if counts == 0 {
                    break;
                }
                history.counts.push(counts);
                history.values.iter_mut().zip(&history.relevant).for_each(|(seen, &at)| seen.push(state[at]));
                state = system.registers.iter().map(|register| word(&values, register.next)).collect();
            }
        }
        history
    }

    /// Cubes of one register, and of two that no smaller cube covers; empty if there are too many.
    fn candidates(&self, system: &TransitionSystem) -> Vec<Cube> {
        let registers =
            |cube: &[ValuedBit]| -> Cube { cube.iter().map(|&(place, value)| (self.relevant[place], value)).collect() };
        let mut cubes: Vec<Cube> = Vec::new();
        let mut varying = Vec::new();
        for place in 0..self.relevant.len() {
            match [false, true].into_iter().find(|&value| self.is_never(&[(place, value)])) {
                Some(value) => cubes.push(registers(&[(place, value)])),
                None => varying.push(place),
            }
        }
        cubes.retain(|cube| excludes_start(system, cube));
        for (at, &first) in varying.iter().enumerate() {
            for &second in &varying[at + 1..] {
                let pairs = [false, true].into_iter().flat_map(|one| [false, true].map(|other| (one, other)));
                let cubes_of_both = pairs.map(|(one, other)| [(first, one), (second, other)]);
                let never = cubes_of_both.filter(|cube| self.is_never(cube)).map(|cube| registers(&cube));
                cubes.extend(never.filter(|cube| excludes_start(system, cube)));
            }
            if cubes.len() > MOST {
                return Vec::new();
            }
        }
        cubes
    }

    /// Whether no run was in a cube, whose registers are places in the list.
    fn is_never(&self, cube: &[ValuedBit]) -> bool {
        self.counts.iter().enumerate().all(|(at, &counts)| {
            cube.iter().fold(counts, |all, &(place, value)| all & (self.values[place][at] ^ everywhere(!value))) == 0
        })
    }
}

fn everywhere(value: bool) -> u64 {
    if value { u64::MAX } else { 0 }
}

fn word(values: &[u64], literal: AndLiteral) -> u64 {
    values[literal / 2] ^ everywhere(literal & 1 == 1)
}
