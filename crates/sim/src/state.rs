//! Positions and velocities of a body's points: the state of a simulation between env steps.

use crate::constants::Constants;
use crate::lattice::Lattice;

/// The moving part of one simulation, in order of the lattice's points.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The position of each point, in meters.
    pub position: Vec<[f64; 2]>,
    /// The position of each point one substep ago, in meters; the difference is the true velocity of docs/physics.md 5.
    pub previous: Vec<[f64; 2]>,
    /// The integrator's velocity, in meters per substep.
    pub velocity: Vec<[f64; 2]>,
}

impl State {
    /// At rest, with the lower left corner at `origin`, in voxels (docs/physics.md 1 and 2).
    pub fn start(lattice: &Lattice, origin: [f64; 2], constants: &Constants) -> Self {
        let position: Vec<_> = (0..lattice.points().len()).map(|p| lattice.start(p, origin, constants)).collect();
        Self { previous: position.clone(), velocity: vec![[0.0; 2]; position.len()], position }
    }

    /// The plain mean over all points, in voxels (docs/physics.md 2).
    pub fn center(&self, constants: &Constants) -> [f64; 2] {
        let count = self.position.len() as f64;
        let mean = |axis: usize| self.position.iter().map(|at| at[axis]).sum::<f64>() / count / constants.cell;
        [mean(0), mean(1)]
    }
}
