//! Parts of simulations for workers. The result of a part depends on that part alone.

use std::sync::Mutex;

use serde::{Deserialize, Serialize};

use crate::lock::lock;
use nbc_session::BodyTrials;
use nbc_sim::Simulator;
use nbc_swarm::evolve::Scores;
use nbc_swarm::{CyclePart, PartStates, part_states};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CrewPart {
    Cycle(Box<CyclePart>),
    Bodies(Box<BodyTrials>),
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum CrewResult {
    Cycle(#[serde(with = "part_states")] PartStates),
    Bodies(Vec<Option<Scores>>),
}

impl CrewPart {
    pub fn perform(&self, simulator: &Simulator) -> CrewResult {
        match self {
            Self::Cycle(part) => CrewResult::Cycle(part.simulate(simulator)),
            Self::Bodies(trials) => CrewResult::Bodies(trials.measure(simulator)),
        }
    }
}

impl CrewResult {
    pub fn states(self) -> PartStates {
        match self {
            Self::Cycle(states) => states,
            other => panic!("{other:?} is not of a cycle"),
        }
    }

    pub fn scores(self) -> Vec<Option<Scores>> {
        match self {
            Self::Bodies(scores) => scores,
            other => panic!("{other:?} is not of bodies"),
        }
    }
}

#[derive(Debug)]
pub struct GivenParts {
    results: Mutex<Vec<Option<CrewResult>>>,
}

impl GivenParts {
    pub fn new(parts: usize) -> Self {
        Self { results: Mutex::new(vec![None; parts]) }
    }

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
