//! Trials: simulations from a fresh start, many at once.

use crate::model::{Setting, Trajectory, Trial};
use crate::sim::roster::carry_all;
use crate::sim::run::{Run, World, runs};
use crate::sim::simulator::Simulator;

/// Simulates each trial from a fresh start; result `i` belongs to trial `i`. The results do not depend on threads or on what is
/// simulated together.
pub fn run_trials(setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
    Simulator::default().run_trials(setting, trials)
}

impl Simulator {
    /// Simulates each trial from a fresh start; see [`run_trials`].
    pub fn run_trials(&self, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
        let world = World::new(self, setting);
        let mut runs = runs(&world, setting, trials.iter().map(|trial| &trial.body));
        for (run, trial) in runs.iter_mut().zip(trials) {
            run.centers.push(run.state.center(&world.constants));
            run.assign(&trial.schedule);
        }
        carry_all(&mut runs, &world, self.kernel);
        runs.into_iter().map(trajectory).collect()
    }
}

fn trajectory(run: Run) -> Trajectory {
    let axis = |axis: usize| run.centers.iter().map(|center| center[axis]).collect();
    Trajectory { com_x: axis(0), com_y: axis(1), fault: run.fault }
}
