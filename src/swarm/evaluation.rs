//! One evaluation as plain data: what it depends on and what comes out, wherever it is made.

use crate::evolve::{CandidateOutcome, Rivals, Search};
use crate::model::{Body, Evolution, PhysicsWorld, Schedule, SearchObjective, Setting};
use crate::swarm::Work;
use crate::swarm::noise::RobotNoise;

/// The simulations of an evaluation.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluationProtocol {
    /// The objective.
    pub objective: SearchObjective,
    /// The stimuli of the long simulation.
    pub variable: Schedule,
    /// The length of each simulation under one constant pattern, in env steps.
    pub fixed_steps: u32,
    /// The world of all simulations.
    pub world: PhysicsWorld,
}

/// A body to be evaluated.
#[derive(Clone, Debug, PartialEq)]
pub struct EvaluationTask {
    /// Its voxels.
    pub body: Body,
    /// What it must beat. An evaluation ends early when it cannot.
    pub rivals: Rivals,
}

/// The result of an evaluation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluated {
    /// The result for the archive.
    pub outcome: CandidateOutcome,
    /// The simulation it took.
    pub work: Work,
}

impl EvaluationProtocol {
    /// The protocol of a declared run.
    pub fn of(evolution: &Evolution) -> Self {
        let Evolution { objective, variable, fixed_steps, world, .. } = evolution;
        Self { objective: *objective, variable: variable.clone(), fixed_steps: *fixed_steps, world: *world }
    }

    /// The setting of each simulation. Every candidate starts at the same place.
    pub(super) fn setting(&self) -> Setting {
        let shift = RobotNoise::new(&self.world.noise, 0).shift();
        Setting { shift, factors: self.world.factors, ..Setting::default() }
    }

    /// Env steps of a full evaluation of the distance objective.
    pub(super) fn distance_steps(&self) -> u64 {
        4 * u64::from(self.fixed_steps) + self.variable.spells.iter().map(|spell| u64::from(spell.steps)).sum::<u64>()
    }
}

impl EvaluationTask {
    /// The evaluation of a body for the current archive of a search.
    pub fn of(search: &Search, body: &Body) -> Self {
        Self { body: body.clone(), rivals: search.rivals(body) }
    }
}
