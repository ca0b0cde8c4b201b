//! A batch of a kernel, independent of its number type.

use std::fmt::Debug;

use crate::backend::lanes::batch::Batch;
use crate::backend::lanes::real::Real;
use crate::backend::lanes::stiffness::Stiffness;
use crate::meter::Part;
use crate::state::State;

/// A batch that can be stepped.
pub trait LaneBatch: Debug + Send {
    /// Simulates one env step with the targets as they are.
    fn env_step(&mut self);

    /// Sets the target widths of a lane's materials; see [`Batch::set_targets`].
    fn set_targets(&mut self, lane: usize, targets: &[f64]);

    /// The center of mass of a lane's robot, in voxels.
    fn center(&self, lane: usize) -> [f64; 2];

    /// Lanes that became unstable, as bits.
    fn unstable(&self) -> u32;

    /// Saves all states, in case the next env step has to be undone.
    fn save(&mut self);

    /// Reads a lane's points.
    fn unload(&self, lane: usize, state: &mut State);

    /// Reads a lane's points as they were at the last [`LaneBatch::save`].
    fn unload_saved(&self, lane: usize, state: &mut State);

    /// Puts a lane's robot into another state.
    fn load(&mut self, lane: usize, state: &State);

    /// Ignores the time since the last call, if time is measured.
    fn resume(&mut self);

    /// Adds the time since the last call, if time is measured.
    fn lap(&mut self, part: Part);
}

/// A batch with the step of its kernel.
#[derive(Debug)]
pub struct Stepped<R: Real, K: Stiffness<R>> {
    /// The robots in lanes.
    pub batch: Batch<R, K>,
    /// One env step, compiled for the numbers of the batch.
    pub step: fn(&mut Batch<R, K>),
}

impl<R: Real, K: Stiffness<R>> LaneBatch for Stepped<R, K> {
    fn env_step(&mut self) {
        (self.step)(&mut self.batch);
    }

    fn set_targets(&mut self, lane: usize, targets: &[f64]) {
        self.batch.set_targets(lane, targets);
    }

    fn center(&self, lane: usize) -> [f64; 2] {
        self.batch.center(lane)
    }

    fn unstable(&self) -> u32 {
        self.batch.unstable
    }

    fn save(&mut self) {
        self.batch.masses.save();
    }

    fn unload(&self, lane: usize, state: &mut State) {
        self.batch.masses.unload(lane, &self.batch.occupants[lane].masses, state);
    }

    fn unload_saved(&self, lane: usize, state: &mut State) {
        self.batch.masses.unload_saved(lane, &self.batch.occupants[lane].masses, state);
    }

    fn load(&mut self, lane: usize, state: &State) {
        self.batch.load(lane, state);
    }

    fn resume(&mut self) {
        if let Some(watch) = &mut self.batch.stopwatch {
            watch.resume();
        }
    }

    fn lap(&mut self, part: Part) {
        self.batch.lap(part);
    }
}
