//! Search for an invariant: sets of states, one for each number of steps, that contain at least the states that can be
//! reached in so many steps. States from which a violation follows are taken out of them, until two neighbors are
//! equal.
//!
//! A. R. Bradley, SAT-based model checking without unrolling, VMCAI 2011; N. Eén, A. Mishchenko and R. Brayton,
//! Efficient implementation of property directed reachability, FMCAD 2011.

use std::collections::BTreeMap;

use batsat::Lit;

use crate::clause::ValuedBit;
use crate::properties::solver::Solved;
use crate::properties::system::{Cube, SystemRun, TransitionSystem, contains, excludes_start};
use crate::properties::unrolled::Unrolled;
use nbc_base::source::CancelFlag;

/// Clauses that were needed for one call, after which the solver is made again.
const MOST_SPENT: usize = 3_000;

const ROUNDS: usize = 2;

pub(super) enum Found {
    Nothing,
    /// No state in these cubes is ever reached, and all states that violate the property are in them.
    Invariant(Vec<Cube>),
    /// A run that violates the property. There may be shorter ones.
    Violation(SystemRun),
}

/// States from which a violation follows.
struct Obligation {
    frame: usize,
    cube: Cube,
    state: Vec<bool>,
    inputs: Vec<bool>,
    next: Option<usize>,
}

pub(super) struct Frames {
    cancel: CancelFlag,
    property: usize,
    given: Vec<usize>,
    known: Vec<Cube>,
    step: Unrolled,
    /// The literal that requires the start, and those that require the cubes to be left out, for each number of steps.
    active: Vec<Lit>,
    constrained: Lit,
    /// The cubes that are left out of the set of each number of steps, but not of the next one.
    cubes: Vec<Vec<Cube>>,
    /// The obligations so far; those that are open are the last of their frame.
    obligations: Vec<Obligation>,
    open: BTreeMap<usize, Vec<usize>>,
    pushing: Option<(usize, usize)>,
    counts: Vec<usize>,
    spent: usize,
    work_before: u64,
}

impl Frames {
    pub(super) fn new(
        system: &TransitionSystem,
        property: usize,
        (given, known): (Vec<usize>, Vec<Cube>),
        cancel: CancelFlag,
    ) -> Self {
        let step = Unrolled::any_step(cancel.clone());
        let constrained = step.solver.one();
        let mut frames = Self {
            cancel,
            property,
            given,
            known,
            step,
            active: Vec::new(),
            constrained,
            cubes: vec![Vec::new()],
            obligations: Vec::new(),
            open: BTreeMap::new(),
            pushing: None,
            counts: vec![0; system.registers.len()],
            spent: 0,
            work_before: 0,
        };
        frames.begin(system);
        frames
    }

    fn begin(&mut self, system: &TransitionSystem) {
        self.work_before += self.step.solver.work();
        self.step = Unrolled::any_step(self.cancel.clone());
        self.spent = 0;
        self.active.clear();
        self.constrained = self.step.solver.follower();
        for &literal in &system.constraints {
            let literal = self.step.literal(system, 0, literal);
            self.step.solver.clause(&[!self.constrained, literal]);
        }
        for &property in &self.given {
            self.step.require(system, 0, system.bad[property] ^ 1);
        }
        for cube in self.known.clone() {
            let clause = self.outside(system, &cube);
            self.step.solver.clause(&clause);
        }
        let start = self.step.solver.follower();
        self.active.push(start);
        for at in system.relevant() {
            if let Some(value) = system.registers[at].start {
                let literal = self.step.literal(system, 0, system.has((at, value)));
                self.step.solver.clause(&[!start, literal]);
            }
        }
        for frame in 1..self.cubes.len() {
            let active = self.step.solver.follower();
            self.active.push(active);
            for cube in self.cubes[frame].clone() {
                self.leave_out(system, frame, &cube);
            }
        }
    }

    pub(super) fn steps(&self) -> usize {
        self.cubes.len() - 1
    }

    pub(super) fn given(&self) -> &[usize] {
        &self.given
    }

    pub(super) fn work(&self) -> u64 {
        self.work_before + self.step.solver.work()
    }

    pub(super) fn advance(&mut self, system: &TransitionSystem) -> Found {
        if self.spent >= MOST_SPENT {
            self.begin(system);
        }
        if let Some((frame, place)) = self.pushing {
            return self.push(system, frame, place);
        }
        let Some(obligation) = self.take() else { return self.violating(system) };
        let Obligation { frame, cube, .. } = &self.obligations[obligation];
        let (frame, cube) = (*frame, cube.clone());
        if frame == 0 {
            return Found::Violation(self.run(system, obligation));
        }
        if self.cubes[frame..].iter().flatten().any(|other| contains(other, &cube)) {
            return Found::Nothing;
        }
        match self.reaches(system, frame - 1, &cube, true) {
            Reached::Open => self.put_back(obligation),
            Reached::Never(smaller) => {
                // The states are also to be left out later: that finds long runs and deep invariants early.
                let next = self.learn(system, frame, smaller) + 1;
                if next <= self.steps() {
                    self.obligations[obligation].frame = next;
                    self.put_back(obligation);
                }
            }
            Reached::From { state, inputs } => {
                let cube = self.widened(system, &state, &inputs, Some(&cube));
                self.put_back(obligation);
                self.obligations.push(Obligation { frame: frame - 1, cube, state, inputs, next: Some(obligation) });
                self.put_back(self.obligations.len() - 1);
            }
        }
        Found::Nothing
    }

    fn take(&mut self) -> Option<usize> {
        let mut entry = self.open.first_entry()?;
        let obligation = entry.get_mut().pop();
        if entry.get().is_empty() {
            entry.remove();
        }
        obligation
    }

    fn put_back(&mut self, obligation: usize) {
        self.open.entry(self.obligations[obligation].frame).or_default().push(obligation);
    }

    fn violating(&mut self, system: &TransitionSystem) -> Found {
        let last = self.steps();
        let bad = self.step.literal(system, 0, system.bad[self.property]);
        let mut assumed = self.active[last..].to_vec();
        assumed.extend([self.constrained, bad]);
        match self.step.solver.solve(&assumed, u64::MAX) {
            Solved::Open => {}
            Solved::Yes => {
                let (state, inputs) = (self.step.state(system, 0), self.step.inputs(system, 0));
                let cube = self.widened(system, &state, &inputs, None);
                self.obligations.push(Obligation { frame: last, cube, state, inputs, next: None });
                self.put_back(self.obligations.len() - 1);
            }
            Solved::No => {
                self.obligations.clear();
                self.cubes.push(Vec::new());
                let active = self.step.solver.follower();
                self.active.push(active);
                self.pushing = Some((1, 0));
            }
        }
        Found::Nothing
    }

    fn push(&mut self, system: &TransitionSystem, frame: usize, place: usize) -> Found {
        let Some(cube) = self.cubes[frame].get(place).cloned() else {
            let last = self.steps();
            if frame < last && self.cubes[frame].is_empty() {
                self.pushing = None;
                return Found::Invariant([self.cubes[frame + 1..].concat(), self.known.clone()].concat());
            }
            self.pushing = (frame + 1 < last).then_some((frame + 1, 0));
            return Found::Nothing;
        };
        match self.reaches(system, frame, &cube, false) {
            Reached::Open => {}
            Reached::Never(_) => self.add(system, frame + 1, cube),
            Reached::From { .. } => self.pushing = Some((frame, place + 1)),
        }
        Found::Nothing
    }

    fn widened(&mut self, system: &TransitionSystem, state: &[bool], inputs: &[bool], to: Option<&Cube>) -> Cube {
        self.spent += 1;
        let other = self.step.solver.follower();
        let mut clause = vec![!other];
        let mut wanted = system.constraints.clone();
        match to {
            None => wanted.push(system.bad[self.property]),
            Some(cube) => wanted.extend(cube.iter().map(|&bit| system.gets(bit))),
        }
        clause.extend(wanted.into_iter().map(|literal| !self.step.literal(system, 0, literal)));
        self.step.solver.clause(&clause);
        let mut assumed = vec![other];
        for (at, &value) in inputs.iter().enumerate() {
            assumed.push(self.step.literal(system, 0, 2 * (at + 1) + usize::from(!value)));
        }
        let registers: Vec<Lit> = (state.iter().enumerate())
            .map(|(at, &value)| self.step.literal(system, 0, system.has((at, value))))
            .collect();
        assumed.extend(&registers);
        let solved = self.step.solver.solve(&assumed, u64::MAX);
        let is_needed = |&(at, _): &(usize, &bool)| solved != Solved::No || self.step.solver.is_needed(registers[at]);
        let cube = state.iter().enumerate().filter(is_needed).map(|(at, &value)| (at, value)).collect();
        self.step.solver.clause(&[!other]);
        cube
    }

    /// `is_new` says that the set contains states of the cube.
    fn reaches(&mut self, system: &TransitionSystem, frame: usize, cube: &[ValuedBit], is_new: bool) -> Reached {
        let mut assumed = self.active[frame..].to_vec();
        assumed.push(self.constrained);
        let mut outside = None;
        if is_new {
            self.spent += 1;
            let active = self.step.solver.follower();
            let mut clause = vec![!active];
            clause.extend(self.outside(system, cube));
            self.step.solver.clause(&clause);
            assumed.push(active);
            outside = Some(active);
        }
        let nexts: Vec<Lit> = cube.iter().map(|&bit| self.step.literal(system, 0, system.gets(bit))).collect();
        assumed.extend(&nexts);
        let reached = match self.step.solver.solve(&assumed, u64::MAX) {
            Solved::Open => Reached::Open,
            Solved::Yes => Reached::From { state: self.step.state(system, 0), inputs: self.step.inputs(system, 0) },
            Solved::No => {
                let needed = cube.iter().zip(&nexts).filter(|(_, next)| self.step.solver.is_needed(**next));
                let mut smaller: Cube = needed.map(|(&literal, _)| literal).collect();
                if !excludes_start(system, &smaller) {
                    let differs = |&&(at, value): &&ValuedBit| system.registers[at].start == Some(!value);
                    smaller.extend(cube.iter().find(differs));
                    smaller.sort_unstable();
                }
                Reached::Never(smaller)
            }
        };
        if let Some(active) = outside {
            self.step.solver.clause(&[!active]);
        }
        reached
    }

    /// Excludes the cube, and more states where that holds, and returns the last frame that excludes it.
    fn learn(&mut self, system: &TransitionSystem, frame: usize, cube: Cube) -> usize {
        let cube = self.wider(system, frame, cube);
        let mut last = frame;
        while last < self.steps() {
            match self.reaches(system, last, &cube, true) {
                Reached::Never(_) => last += 1,
                _ => break,
            }
        }
        cube.iter().for_each(|&(at, _)| self.counts[at] += 1);
        self.add(system, last, cube);
        last
    }

    fn wider(&mut self, system: &TransitionSystem, frame: usize, mut cube: Cube) -> Cube {
        for _ in 0..ROUNDS {
            let before = cube.len();
            let mut order = cube.clone();
            order.sort_by_key(|&(at, _)| (self.counts[at], at));
            for literal in order {
                let smaller: Cube = cube.iter().copied().filter(|&one| one != literal).collect();
                if smaller.len() == cube.len() || !excludes_start(system, &smaller) {
                    continue;
                }
                if let Reached::Never(needed) = self.reaches(system, frame - 1, &smaller, true) {
                    cube = needed;
                }
            }
            if cube.len() == before {
                break;
            }
        }
        cube
    }

    fn add(&mut self, system: &TransitionSystem, frame: usize, cube: Cube) {
        for cubes in &mut self.cubes[..=frame] {
            cubes.retain(|other| !contains(&cube, other));
        }
        self.leave_out(system, frame, &cube);
        self.cubes[frame].push(cube);
    }

    fn leave_out(&mut self, system: &TransitionSystem, frame: usize, cube: &[ValuedBit]) {
        let mut clause = vec![!self.active[frame]];
        clause.extend(self.outside(system, cube));
        self.step.solver.clause(&clause);
    }

    fn outside(&mut self, system: &TransitionSystem, cube: &[ValuedBit]) -> Vec<Lit> {
        cube.iter().map(|&bit| !self.step.literal(system, 0, system.has(bit))).collect()
    }

    fn run(&self, system: &TransitionSystem, obligation: usize) -> SystemRun {
        let mut next = Some(obligation);
        let mut inputs = Vec::new();
        while let Some(at) = next {
            inputs.push(self.obligations[at].inputs.clone());
            next = self.obligations[at].next;
        }
        let start = system.registers.iter().zip(&self.obligations[obligation].state);
        SystemRun { start: start.map(|(register, &found)| register.start.unwrap_or(found)).collect(), inputs }
    }
}

enum Reached {
    Open,
    /// No state reaches the cube; the wider cube is unreachable, too.
    Never(Cube),
    From {
        state: Vec<bool>,
        inputs: Vec<bool>,
    },
}
