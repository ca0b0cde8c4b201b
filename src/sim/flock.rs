//! Robots that live on: each in its own full simulation, with its own stimuli.

use std::sync::Arc;

use crate::model::{Body, Fault, Pattern, Schedule, Setting};
use crate::sim::kernel::Kernel;
use crate::sim::lattice::Lattice;
use crate::sim::roster::carry_all;
use crate::sim::run::{Run, World, runs};
use crate::sim::simulator::Simulator;

/// Robots side by side, each alone in its own simulation.
#[derive(Clone, Debug)]
pub struct Flock {
    world: Arc<World>,
    kernel: Kernel,
    runs: Vec<Run>,
}

impl Flock {
    /// A robot for each body, at the setting's start column, its clock at zero.
    pub fn new(setting: &Setting, bodies: &[Body]) -> Self {
        Simulator::default().flock(setting, bodies)
    }

    /// The same in the hands of a simulator.
    pub(crate) fn with(simulator: &Simulator, setting: &Setting, bodies: &[Body]) -> Self {
        let world = World::new(simulator, setting);
        let runs = runs(&world, setting, bodies);
        Self { world: Arc::new(world), kernel: simulator.kernel, runs }
    }

    /// How many robots.
    pub fn len(&self) -> usize {
        self.runs.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// Keeps robot `i` where `keep[i]` is true, in their order, and forgets the others.
    ///
    /// # Panics
    /// When there is not one word for each robot.
    pub fn retain(&mut self, keep: &[bool]) {
        assert_eq!(keep.len(), self.runs.len(), "each robot is kept or not");
        let mut keep = keep.iter();
        self.runs.retain(|_| keep.next().is_some_and(|&keep| keep));
    }

    /// Goes on for `env_steps` env steps, robot `i` under `patterns[i]`. The actuation clock goes on from call to call. A robot that
    /// cannot go on stays where it was at the end of its last whole env step.
    ///
    /// # Panics
    /// When there is not one pattern a robot.
    pub fn advance(&mut self, patterns: &[Pattern], env_steps: u32) {
        assert_eq!(patterns.len(), self.runs.len(), "each robot has a pattern");
        for (run, &pattern) in self.runs.iter_mut().zip(patterns) {
            run.assign(&Schedule::constant(pattern, env_steps));
        }
        carry_all(&mut self.runs, &self.world, self.kernel);
        for run in &mut self.runs {
            run.centers.clear();
        }
    }

    /// The center of mass of robot `i`, in voxels: x and y.
    pub fn com(&self, i: usize) -> [f64; 2] {
        self.runs[i].state.center(&self.world.constants)
    }

    /// What stopped robot `i`, if anything did.
    pub fn fault(&self, i: usize) -> Option<Fault> {
        self.runs[i].fault
    }

    /// Where the points of robot `i` are, in voxels, in the order of [`Lattice::points`].
    pub fn points(&self, i: usize) -> Vec<[f64; 2]> {
        let cell = self.world.constants.cell;
        self.runs[i].state.position.iter().map(|at| at.map(|axis| axis / cell)).collect()
    }

    /// The lattice of robot `i`.
    pub fn lattice(&self, i: usize) -> &Lattice {
        &self.runs[i].lattice
    }

    /// Env steps that robot `i` has behind it.
    pub fn clock(&self, i: usize) -> u32 {
        self.runs[i].clock
    }
}
