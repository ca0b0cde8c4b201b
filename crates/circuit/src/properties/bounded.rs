//! Bounded search and induction: is there a violation after so many steps, and does a property hold in a step because
//! it held in so many before?
//!
//! M. Sheeran, S. Singh and G. Stålmarck, Checking safety properties using induction and a SAT-solver, FMCAD 2000. The
//! states of the steps before are different from each other, because a shortest violation has no state twice.

use std::collections::BTreeSet;

use crate::properties::solver::Solved;
use crate::properties::system::{SystemRun, TransitionSystem};
use crate::properties::unrolled::Unrolled;
use nbc_base::source::CancelFlag;

pub(super) struct Bounded {
    unrolled: Unrolled,
    pub(super) step: usize,
    done: BTreeSet<usize>,
}

impl Bounded {
    pub(super) fn new(system: &TransitionSystem, cancel: CancelFlag) -> Self {
        let mut bounded = Self { unrolled: Unrolled::new(true, cancel), step: 0, done: BTreeSet::new() };
        bounded.begin(system);
        bounded
    }

    fn begin(&mut self, system: &TransitionSystem) {
        system.constraints.iter().for_each(|&literal| self.unrolled.require(system, self.step, literal));
    }

    /// Looks at one property in this step, or begins the next step; returns a run that violates it, if there is one.
    pub(super) fn advance(
        &mut self,
        system: &TransitionSystem,
        open: &BTreeSet<usize>,
        portion: u64,
    ) -> Option<(usize, SystemRun)> {
        let Some(&property) = open.difference(&self.done).next() else {
            self.step += 1;
            self.done.clear();
            self.begin(system);
            return None;
        };
        let bad = self.unrolled.literal(system, self.step, system.bad[property]);
        match self.unrolled.solver.solve(&[bad], portion) {
            Solved::Open => None,
            Solved::No => {
                self.unrolled.solver.clause(&[!bad]);
                self.done.insert(property);
                None
            }
            Solved::Yes => Some((property, self.unrolled.run(system, self.step + 1))),
        }
    }

    pub(super) fn work(&self) -> u64 {
        self.unrolled.solver.work()
    }
}

pub(super) struct Induction {
    unrolled: Unrolled,
    /// The number of steps in which the properties hold before the one that is looked at.
    pub(super) steps: usize,
    required: Vec<batsat::Lit>,
    relevant: Vec<usize>,
}

impl Induction {
    pub(super) fn new(system: &TransitionSystem, cancel: CancelFlag) -> Self {
        let mut unrolled = Unrolled::new(false, cancel);
        let required = system.bad.iter().map(|_| unrolled.solver.fresh()).collect();
        let mut induction = Self { unrolled, steps: 0, required, relevant: system.relevant() };
        induction.constrain(system);
        induction
    }

    fn constrain(&mut self, system: &TransitionSystem) {
        system.constraints.iter().for_each(|&literal| self.unrolled.require(system, self.steps, literal));
    }

    pub(super) fn extend(&mut self, system: &TransitionSystem) {
        for (property, &bad) in system.bad.iter().enumerate() {
            let bad = self.unrolled.literal(system, self.steps, bad);
            self.unrolled.solver.clause(&[!self.required[property], !bad]);
        }
        self.steps += 1;
        self.constrain(system);
    }

    /// The largest set that holds in a step because it holds in those before; `None` if the portion of work ended.
    pub(super) fn proved(
        &mut self,
        system: &TransitionSystem,
        open: &BTreeSet<usize>,
        portion: u64,
    ) -> Option<BTreeSet<usize>> {
        let mut held = open.clone();
        loop {
            let mut lost = BTreeSet::new();
            for &property in &held {
                if !self.follows(system, property, &held, portion)? {
                    lost.insert(property);
                }
            }
            if lost.is_empty() {
                return Some(held);
            }
            held.retain(|property| !lost.contains(property));
        }
    }

    fn follows(
        &mut self,
        system: &TransitionSystem,
        property: usize,
        held: &BTreeSet<usize>,
        portion: u64,
    ) -> Option<bool> {
        let bad = self.unrolled.literal(system, self.steps, system.bad[property]);
        let mut assumed: Vec<_> = held.iter().map(|&property| self.required[property]).collect();
        assumed.push(bad);
        loop {
            match self.unrolled.solver.solve(&assumed, portion) {
                Solved::Open => return None,
                Solved::No => return Some(true),
                Solved::Yes if !self.require_different(system) => return Some(false),
                Solved::Yes => {}
            }
        }
    }

    /// Requires different states of steps that had the same one in the last solution. Returns whether there were any.
    fn require_different(&mut self, system: &TransitionSystem) -> bool {
        let states: Vec<Vec<bool>> = (0..=self.steps).map(|step| self.unrolled.state(system, step)).collect();
        let same =
            |&(first, second): &(usize, usize)| self.relevant.iter().all(|&at| states[first][at] == states[second][at]);
        let pairs = (1..states.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
        let pairs: Vec<(usize, usize)> = pairs.filter(same).collect();
        for &(first, second) in &pairs {
            let mut clause = Vec::new();
            for &at in &self.relevant {
                let [a, b] = [first, second].map(|step| self.unrolled.literal(system, step, system.register(at)));
                let solver = &mut self.unrolled.solver;
                clause.extend([solver.and(a, !b), solver.and(!a, b)]);
            }
            self.unrolled.solver.clause(&clause);
        }
        !pairs.is_empty()
    }

    pub(super) fn work(&self) -> u64 {
        self.unrolled.solver.work()
    }
}
