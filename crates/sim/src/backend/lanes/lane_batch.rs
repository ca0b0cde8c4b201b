//! A batch of a kernel, independent of its number type.

use std::fmt::Debug;

use crate::backend::lanes::batch::Batch;
use crate::backend::lanes::real::Real;
use crate::backend::lanes::stiffness::Stiffness;
use crate::meter::Part;
use crate::state::State;

pub trait LaneBatch: Debug + Send {
    fn env_step(&mut self);
    /// Sets the targets of a lane's channels: fractions of the rest width or height (docs/physics.md 4).
    fn set_targets(&mut self, lane: usize, targets: &[f64]);
    /// The center of mass of a lane's robot, in voxels: the plain mean over its points in order of creation.
    fn center(&self, lane: usize) -> [f64; 2];
    /// Lanes that became unstable, as bits.
    fn unstable(&self) -> u32;
    fn save(&mut self);
    fn unload(&self, lane: usize, state: &mut State);
    /// Reads a lane's points as they were at the last [`LaneBatch::save`].
    fn unload_saved(&self, lane: usize, state: &mut State);
    fn load(&mut self, lane: usize, state: &State);
    /// Ignores the time since the last call, if time is measured.
    fn resume(&mut self);
    fn lap(&mut self, part: Part);
}

impl<R: Real, K: Stiffness<R>> LaneBatch for Batch<R, K> {
    fn env_step(&mut self) {
        (self.step)(self);
    }

    fn set_targets(&mut self, lane: usize, targets: &[f64]) {
        self.springs.set_targets(lane, &self.occupants[lane].driven, targets, &self.constants);
    }

    fn center(&self, lane: usize) -> [f64; 2] {
        let masses = &self.occupants[lane].masses;
        let mean = |axis: usize| {
            let sum: f64 = masses.iter().map(|&mass| self.masses.now[mass].at[axis].lane(lane)).sum();
            sum / masses.len() as f64 / self.constants.cell
        };
        [mean(0), mean(1)]
    }

    fn unstable(&self) -> u32 {
        self.unstable
    }

    fn save(&mut self) {
        self.masses.save();
    }

    fn unload(&self, lane: usize, state: &mut State) {
        self.masses.unload(lane, &self.occupants[lane].masses, state);
    }

    fn unload_saved(&self, lane: usize, state: &mut State) {
        self.masses.unload_saved(lane, &self.occupants[lane].masses, state);
    }

    fn load(&mut self, lane: usize, state: &State) {
        self.masses.load(lane, &self.occupants[lane].masses, state);
        self.unstable &= !(1 << lane);
    }

    fn resume(&mut self) {
        if let Some(stopwatch) = &mut self.stopwatch {
            stopwatch.resume();
        }
    }

    #[inline(always)]
    fn lap(&mut self, part: Part) {
        if let Some(stopwatch) = &mut self.stopwatch {
            stopwatch.lap(part, self.occupants.len());
        }
    }
}
