//! The input and the result of an evaluation as plain data, so that it can be done on any machine.

use serde::{Deserialize, Serialize};

use crate::evolve::{Candidate, CandidateOutcome, Rivals, Search};
use crate::noise::RobotNoise;
use crate::{Work, WorldSample};
use nbc_base::model::{
    Behavior, Body, Displacements, Evolution, ImageOrder, PhysicsWorld, Schedule, SearchObjective, Setting,
};

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationProtocol {
    pub stimuli: usize,
    pub objective: SearchObjective,
    /// The behaviors as which gates are scored, the nearest of them; if there are none, what the body does.
    pub behaviors: Vec<Behavior>,
    pub variable: Schedule,
    pub shown: ImageOrder,
    /// The length of each simulation under one constant pattern, in env steps.
    pub fixed_steps: u32,
    pub world: PhysicsWorld,
    pub others: Vec<PhysicsWorld>,
}

/// `nbc test` and `nbc library verify` use 1, so that they try robots in worlds that the search has not seen.
const SAMPLE_SEED: u64 = 0;

/// Every candidate starts at the same place.
pub(super) fn setting(world: &PhysicsWorld) -> Setting {
    let shift = RobotNoise::new(&world.noise, 0).shift();
    let plain = Setting::default();
    Setting { shift, factors: world.factors, ground: world.ground.on(plain.world_width), ..plain }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationTask {
    pub body: Body,
    /// The elites that it must beat. An evaluation ends early when the body cannot beat them.
    pub rivals: Rivals,
    /// Of its parent in the fixed simulations. Their order depends on them, and how many are left out.
    pub expected: Option<Displacements>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluated {
    pub outcome: CandidateOutcome,
    pub work: Work,
}

impl EvaluationProtocol {
    pub fn of(evolution: &Evolution) -> Self {
        let Evolution { objective, behaviors, variable, fixed_steps, world, sample, .. } = evolution;
        let others = sample.map_or(Vec::new(), |sample| {
            let worlds = WorldSample { variation: sample.vary, seed: SAMPLE_SEED };
            (0..sample.worlds).map(|number| worlds.world(world, number as usize)).collect()
        });
        let behaviors = behaviors.clone();
        Self {
            stimuli: evolution.palette.inputs(),
            objective: *objective,
            behaviors,
            variable: variable.clone(),
            shown: evolution.shown,
            fixed_steps: *fixed_steps,
            world: *world,
            others,
        }
    }

    pub(super) fn distance_steps(&self) -> u64 {
        (u64::from(self.fixed_steps) << self.stimuli)
            + self.variable.spells.iter().map(|spell| u64::from(spell.steps)).sum::<u64>()
    }
}

impl EvaluationTask {
    pub fn of(search: &Search, candidate: &Candidate) -> Self {
        let Candidate { body, .. } = candidate;
        Self { body: body.clone(), rivals: search.rivals(body), expected: search.expected(candidate) }
    }
}
