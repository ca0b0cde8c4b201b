//! Back ends: implementations of the physics. All give the same bits; `lanes` runs on this processor, `opencl` on a
//! graphics card.

pub mod lanes;
#[cfg(feature = "gpu")]
pub mod opencl;
mod run;

use std::fmt::Debug;

use crate::constants::Constants;
use crate::lattice::Lattice;
use crate::state::State;
use nbc_base::model::{Body, Fault, Pattern, Setting, Spell, Trajectory, Trial};

pub trait Backend: Debug + Send + Sync {
    /// The number of robots that it simulates in about the time of one.
    fn at_once(&self) -> usize;

    /// Opens a world with a robot for each body, at rest at the setting's start, its clock at zero.
    fn flock(&self, setting: &Setting, bodies: &[Body]) -> Box<dyn Flock>;

    /// Result `i` is that of trial `i`, from a fresh start. It does not depend on threads or on the grouping of trials.
    fn run_trials(&self, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory>;
}

/// Several robots, each alone in its own simulation with its own stimuli.
pub trait Flock: Debug + Send {
    fn len(&self) -> usize;

    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The actuation clock continues from call to call. A robot with a fault stays as after its last complete env step.
    /// Panics when there is not one spell for each robot.
    fn advance_under(&mut self, spells: &[Spell]);

    /// As [`Flock::advance_under`]. Panics when there is not one pattern for each robot.
    fn advance(&mut self, patterns: &[Pattern], env_steps: u32) {
        let spell = |&pattern: &Pattern| Spell::of(pattern, env_steps);
        self.advance_under(&patterns.iter().map(spell).collect::<Vec<_>>());
    }

    /// Keeps robot `i` if `keep[i]`, in the same order. Panics when there is not one entry for each robot.
    fn retain(&mut self, keep: &[bool]);

    /// The center of mass of robot `i`, in voxels: x and y.
    fn center(&self, i: usize) -> [f64; 2];

    fn fault(&self, i: usize) -> Option<Fault>;

    fn clock(&self, i: usize) -> u32;

    /// Sets the actuation clock of robot `i`, in env steps.
    fn set_clock(&mut self, i: usize, clock: u32);

    fn lattice(&self, i: usize) -> &Lattice;

    /// The positions of the points of robot `i`, in voxels, in the order of [`Lattice::points`].
    fn points(&self, i: usize) -> Vec<[f64; 2]>;

    /// All that the simulation of robot `i` depends on from now on; [`Flock::restore`] takes it back.
    fn snapshot(&self, i: usize) -> Snapshot;

    /// Sets robot `i` to an earlier snapshot of a robot with the same body.
    fn restore(&mut self, i: usize, snapshot: &Snapshot);

    /// Moves robot `i` to the right and up by that many voxels.
    fn shift(&mut self, i: usize, voxels: [f64; 2]) {
        let (constants, mut snapshot) = (Constants::default(), self.snapshot(i));
        let State { position, previous, .. } = &mut snapshot.state;
        position.iter_mut().chain(previous).for_each(|point| {
            (0..2).for_each(|axis| point[axis] += voxels[axis] * constants.cell);
        });
        snapshot.center = snapshot.state.center(&constants);
        self.restore(i, &snapshot);
    }
}

/// A robot's simulation at the end of an env step.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    pub state: State,
    /// Its center of mass, in voxels.
    pub center: [f64; 2],
    pub clock: u32,
    pub fault: Option<Fault>,
}
