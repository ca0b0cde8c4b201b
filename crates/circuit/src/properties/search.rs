//! The search that decides properties: bounded search and induction for the first steps, then the search for invariants
//! with most of the work, and bounded search and induction in turn with the rest.

use std::collections::{BTreeMap, BTreeSet};

use crate::properties::bounded::{Bounded, Induction};
use crate::properties::certificate::InductiveProof;
use crate::properties::frames::{Found, Frames};
use crate::properties::needed::needed;
use crate::properties::pairs::never_together;
use crate::properties::system::{Cube, SystemRun, TransitionSystem};
use nbc_base::source::CancelFlag;

/// The steps in which only bounded search and induction are tried.
const FIRST_STEPS: usize = 8;

const INDUCTION_STEPS: usize = 40;

/// The work of one call of the solver in bounded search and induction.
const PORTION: u64 = 2_000;

const FIRST_WORK: u64 = 20_000;

/// How much more work the search for invariants does than bounded search, whose clauses are about many steps.
const INVARIANT_SHARE: u64 = 3;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PropertyVerdict {
    Proved(InductiveProof),
    /// The last step of this run violates it. No shorter run does, unless the budget or the work for shorter ones ended
    /// before this was known.
    Refuted(SystemRun),
    /// The budget ended. It holds in so many first steps.
    Undecided {
        steps: usize,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EmptyProof {
    /// The constraints do not hold in any first step.
    NoStep,
    /// No step of any run is one in which the property could be violated.
    NeverChecked,
}

/// How much a search may do. Work is counted in calls of the solver, clauses that it learned, and hundreds of values
/// that it derived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SearchBudget {
    /// The most steps of a run that are looked at one after the other.
    pub steps: usize,
    pub work: u64,
}

impl SearchBudget {
    /// The budget of those who cannot end a search after some time: tests, pages and editors.
    pub const SHORT: Self = Self { steps: 10_000, work: 300_000 };
}

impl Default for SearchBudget {
    fn default() -> Self {
        Self { steps: 10_000, work: 50_000_000 }
    }
}

pub struct PropertySearch {
    system: TransitionSystem,
    budget: SearchBudget,
    cancel: CancelFlag,
    verdicts: BTreeMap<usize, PropertyVerdict>,
    open: BTreeSet<usize>,
    bounded: Bounded,
    induction: Induction,
    induces: bool,
    /// The search for an invariant of the first open property, with the steps that each has done.
    frames: Option<(usize, Frames)>,
    frames_work: u64,
    known: Option<Vec<Cube>>,
    /// A run that violates a property, while shorter ones are looked for, and the work at which that ends.
    longer: Option<(usize, SystemRun, u64)>,
    /// For empty proofs: the first property is violated in every step, the others where those of the system could be.
    checks: Option<TransitionSystem>,
    checked: Option<Box<Self>>,
}

impl PropertySearch {
    pub fn new(system: TransitionSystem, budget: SearchBudget, cancel: CancelFlag) -> Self {
        let open = (0..system.bad.len()).collect();
        let bounded = Bounded::new(&system, cancel.clone());
        let induction = Induction::new(&system, cancel.clone());
        Self {
            system,
            budget,
            cancel,
            verdicts: BTreeMap::new(),
            open,
            bounded,
            induction,
            induces: true,
            frames: None,
            frames_work: 0,
            known: None,
            longer: None,
            checks: None,
            checked: None,
        }
    }

    /// Also finds empty proofs; `checks` has for each property what is 1 in a step in which it could be violated.
    #[must_use]
    pub fn with_checks(mut self, mut checks: TransitionSystem) -> Self {
        let is_needed = !checks.constraints.is_empty() || checks.bad.iter().any(|&check| check != 1);
        checks.bad.insert(0, 1);
        self.checks = is_needed.then_some(checks);
        self
    }

    pub fn system(&self) -> &TransitionSystem {
        &self.system
    }

    pub fn decided(&self) -> usize {
        self.verdicts.len()
    }

    /// The number of first steps in which no open property is violated.
    pub fn steps(&self) -> usize {
        self.bounded.step
    }

    pub fn work(&self) -> u64 {
        self.bounded.work() + self.induction.work() + self.invariant_work()
    }

    fn invariant_work(&self) -> u64 {
        self.frames_work + self.frames.as_ref().map_or(0, |(_, frames)| frames.work())
    }

    pub fn is_done(&self) -> bool {
        let is_checked = self.checks.is_none() && self.checked.as_ref().is_none_or(|checked| checked.is_done());
        self.cancel.is_raised() || self.has_decided() && is_checked
    }

    fn has_decided(&self) -> bool {
        self.open.is_empty() || self.work() >= self.budget.work
    }

    pub fn advance(&mut self) {
        if self.is_done() {
            return;
        }
        if self.has_decided() {
            self.look_for_empty_proofs();
            return;
        }
        if self.longer.is_some() {
            self.look_for_shorter();
            return;
        }
        let is_first = self.bounded.step <= FIRST_STEPS && self.bounded.work() < FIRST_WORK;
        let [bounded, invariant] = [self.bounded.work(), self.invariant_work()];
        let is_behind = self.induces && self.induction.steps < self.bounded.step;
        if is_behind && (is_first || self.induction.work() < bounded) {
            self.induce();
        } else if self.bounded.step < self.budget.steps && (is_first || INVARIANT_SHARE * bounded < invariant) {
            self.look_further();
        } else {
            self.look_for_invariant();
        }
    }

    fn look_for_empty_proofs(&mut self) {
        if let Some(checks) = self.checks.take() {
            let budget = SearchBudget { steps: self.budget.steps, ..SearchBudget::SHORT };
            let mut checked = Self::new(checks, budget, self.cancel.clone());
            checked.open.retain(|&at| at == 0 || self.is_proved(at - 1));
            self.checked = Some(Box::new(checked));
        }
        if let Some(checked) = &mut self.checked {
            checked.advance();
        }
    }

    fn is_proved(&self, property: usize) -> bool {
        matches!(self.verdicts.get(&property), Some(PropertyVerdict::Proved(_)))
    }

    /// `None` if the proof is not empty, or that is not known.
    pub fn empty_proof(&self, property: usize) -> Option<EmptyProof> {
        let checked = self.checked.as_ref().filter(|_| self.is_proved(property))?;
        match (checked.is_proved(0), checked.is_proved(property + 1)) {
            (true, _) => Some(EmptyProof::NoStep),
            (_, true) => Some(EmptyProof::NeverChecked),
            _ => None,
        }
    }

    fn induce(&mut self) {
        self.induction.extend(&self.system);
        let steps = self.induction.steps;
        let found = self.induction.proved(&self.system, &self.open, PORTION);
        self.induces = steps < INDUCTION_STEPS && found.is_some();
        let together = found.unwrap_or_default();
        for &property in &together {
            let proof = InductiveProof::Steps { steps, together: together.clone() };
            self.decide(property, PropertyVerdict::Proved(proof));
        }
    }

    fn look_further(&mut self) {
        if let Some((property, run)) = self.bounded.advance(&self.system, &self.open, PORTION) {
            self.decide(property, PropertyVerdict::Refuted(run));
        }
    }

    fn look_for_shorter(&mut self) {
        self.look_further();
        // All shorter runs were looked at, or that took as much work as all before.
        let (steps, work) = (self.bounded.step, self.work());
        let is_last = |(_, run, most): &mut (usize, SystemRun, u64)| run.inputs.len() <= steps + 1 || work >= *most;
        if let Some((property, run, _)) = self.longer.take_if(is_last) {
            self.decide(property, PropertyVerdict::Refuted(run));
        }
    }

    fn look_for_invariant(&mut self) {
        let first = *self.open.first().expect("a property is open");
        let is_other = self.frames.as_ref().is_some_and(|(property, _)| *property != first);
        if is_other {
            self.frames_work = self.invariant_work();
            self.frames = None;
        }
        let (system, cancel) = (&self.system, &self.cancel);
        let known = self.known.get_or_insert_with(|| {
            let (cubes, work) = never_together(system, cancel);
            self.frames_work += work;
            cubes
        });
        let proved = self.verdicts.iter().filter(|(_, verdict)| matches!(verdict, PropertyVerdict::Proved(_)));
        let given: Vec<usize> = proved.map(|(&property, _)| property).collect();
        let begin = || (first, Frames::new(system, first, (given, known.clone()), cancel.clone()));
        let (_, frames) = self.frames.get_or_insert_with(begin);
        match frames.advance(system) {
            Found::Nothing => {}
            Found::Violation(mut run) => {
                let last = system.violation(first, &run).expect("the run violates the property");
                run.inputs.truncate(last + 1);
                self.longer = Some((first, run, 2 * self.work()));
            }
            Found::Invariant(cubes) => {
                let given = frames.given();
                known.clone_from(&cubes);
                let cubes = needed(system, first, given, cubes, cancel);
                let given = given.iter().copied().collect();
                let opposite = |cube: Cube| cube.into_iter().map(|(at, value)| (at, !value)).collect();
                let clauses = cubes.into_iter().map(opposite).collect();
                self.decide(first, PropertyVerdict::Proved(InductiveProof::Invariant { clauses, given }));
            }
        }
    }

    fn decide(&mut self, property: usize, verdict: PropertyVerdict) {
        let verdict = match verdict {
            PropertyVerdict::Refuted(run) => {
                let last = run.inputs.len() - 1;
                assert_eq!(self.system.violation(property, &run), Some(last), "the run violates the property");
                PropertyVerdict::Refuted(self.system.plainer(property, run))
            }
            PropertyVerdict::Proved(proof) => {
                assert!(proof.proves(&self.system, property), "the proof of property {property} holds");
                PropertyVerdict::Proved(proof)
            }
            PropertyVerdict::Undecided { .. } => verdict,
        };
        self.longer.take_if(|(other, ..)| *other == property);
        self.open.remove(&property);
        self.verdicts.insert(property, verdict);
    }

    pub fn verdicts(&self) -> Vec<PropertyVerdict> {
        let open = |property: usize| {
            if let Some((_, run, _)) = self.longer.as_ref().filter(|(other, ..)| *other == property) {
                return PropertyVerdict::Refuted(run.clone());
            }
            let own = self.frames.as_ref().filter(|(first, _)| *first == property);
            PropertyVerdict::Undecided { steps: own.map_or(0, |(_, frames)| frames.steps()).max(self.bounded.step) }
        };
        (0..self.system.bad.len()).map(|at| self.verdicts.get(&at).cloned().unwrap_or_else(|| open(at))).collect()
    }

    pub fn finish(mut self) -> Vec<PropertyVerdict> {
        while !self.is_done() {
            self.advance();
        }
        self.verdicts()
    }
}
