//! Trials: simulations from a fresh start, many at once.

use std::sync::Arc;

use rayon::prelude::*;

use crate::model::{Setting, Trajectory, Trial};
use crate::sim::constants::Constants;
use crate::sim::lattice::Lattice;
use crate::sim::run::{Run, World, carry_scalar};
use crate::sim::signal::Signals;

/// Simulates each trial from a fresh start; result `i` belongs to trial `i`. The results do not depend on threads or on what is
/// simulated together.
pub fn run_trials(setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
    run_trials_with(&Constants::default(), setting, trials)
}

/// The same under other constants than the physics'.
pub fn run_trials_with(constants: &Constants, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
    let world = World::new(constants, setting);
    trials.par_iter().map(|trial| simulate(&world, setting, trial)).collect()
}

impl World {
    /// The world of a setting.
    pub fn new(constants: &Constants, setting: &Setting) -> Self {
        let signals = Signals::new(&setting.palette, constants);
        Self { constants: *constants, signals, width: setting.world_width }
    }
}

fn simulate(world: &World, setting: &Setting, trial: &Trial) -> Trajectory {
    let lattice = Arc::new(Lattice::with_constants(&trial.body, &setting.palette, &world.constants));
    let mut run = Run::new(lattice, setting.start_column(trial.body.width()), &world.constants);
    run.assign(&trial.schedule);
    let start = run.state.center(&world.constants);
    run.centers.push(start);
    while !run.is_done() {
        carry_scalar(&mut [&mut run], world);
    }
    Trajectory {
        com_x: run.centers.iter().map(|center| center[0]).collect(),
        com_y: run.centers.iter().map(|center| center[1]).collect(),
        fault: run.fault,
    }
}
