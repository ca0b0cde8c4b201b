//! A batch of a kernel, independent of its number type.

use std::fmt::Debug;

use crate::backend::lanes::batch::Batch;
use crate::backend::lanes::real::Real;
use crate::backend::lanes::stiffness::Stiffness;
use crate::meter::Part;
use crate::state::State;

pub trait LaneBatch: Debug + Send {
    fn env_step(&mut self);

    fn set_targets(&mut self, lane: usize, targets: &[f64]);

    /// The center of mass of a lane's robot, in voxels.
    fn center(&self, lane: usize) -> [f64; 2];

    /// Lanes that became unstable, as bits.
    fn unstable(&self) -> u32;

    /// Saves all states, in case the next env step has to be undone.
    fn save(&mut self);

    fn unload(&self, lane: usize, state: &mut State);

    /// Reads a lane's points as they were at the last [`LaneBatch::save`].
    fn unload_saved(&self, lane: usize, state: &mut State);

    fn load(&mut self, lane: usize, state: &State);

    /// Ignores the time since the last call, if time is measured.
    fn resume(&mut self);

    fn lap(&mut self, part: Part);
}

#[derive(Debug)]
pub struct Stepped<R: Real, K: Stiffness<R>> {
    pub batch: Batch<R, K>,
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
