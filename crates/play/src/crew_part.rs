//! Parts of simulations that others can do: what becomes of one depends on it alone.

use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use crate::lock::lock;
use nbc_session::BodyTrials;
use nbc_sim::Simulator;
use nbc_swarm::evolve::Scores;
use nbc_swarm::{CyclePart, PartStates, part_states};

/// A part of a simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CrewPart {
    /// A cycle of some robots of a swarm.
    Cycle(Box<CyclePart>),
    /// Bodies of a search.
    Bodies(Box<BodyTrials>),
}

/// What became of a part of the same kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CrewResult {
    /// The states of the robots.
    Cycle(#[serde(with = "part_states")] PartStates),
    /// The scores of the bodies.
    Bodies(Vec<Option<Scores>>),
}

impl CrewPart {
    /// Does the part.
    pub fn perform(&self, simulator: &Simulator) -> CrewResult {
        match self {
            Self::Cycle(part) => CrewResult::Cycle(part.simulate(simulator)),
            Self::Bodies(trials) => CrewResult::Bodies(trials.measure(simulator)),
        }
    }
}

impl CrewResult {
    /// The states of robots.
    ///
    /// # Panics
    /// When it is of another kind, as in all methods here.
    pub fn states(self) -> PartStates {
        match self {
            Self::Cycle(states) => states,
            other => panic!("{other:?} is not of a cycle"),
        }
    }

    /// The scores of bodies.
    pub fn scores(self) -> Vec<Option<Scores>> {
        match self {
            Self::Bodies(scores) => scores,
            other => panic!("{other:?} is not of bodies"),
        }
    }
}

/// Parts that were given to others, as who waits for them has them.
#[derive(Debug)]
pub struct GivenParts {
    results: Mutex<Vec<Option<CrewResult>>>,
}

impl GivenParts {
    /// Parts of which none is done.
    pub fn new(parts: usize) -> Self {
        Self { results: Mutex::new(vec![None; parts]) }
    }

    /// Notes what became of one of them.
    pub fn put(&self, part: usize, result: CrewResult) {
        lock(&self.results)[part] = Some(result);
    }

    /// The results of all parts in order, once, when all are there.
    pub fn take(&self) -> Option<Vec<CrewResult>> {
        let results = &mut *lock(&self.results);
        let are_all_there = !results.is_empty() && results.iter().all(Option::is_some);
        are_all_there.then(|| std::mem::take(results).into_iter().flatten().collect())
    }
}
