//! Robots that are advanced step by step on a device. Their states are read after each advance, so that nothing is lost
//! if the device is.

use crate::backend::opencl::fallback_device::FallbackDevice;
use crate::backend::run::{Run, runs};
use crate::backend::{Backend, Flock, Snapshot};
use crate::lattice::Lattice;
use nbc_base::model::{Body, Fault, Schedule, Setting, Spell};

#[derive(Debug)]
pub struct DeviceFlock {
    device: FallbackDevice,
    setting: Setting,
    bodies: Vec<Body>,
    runs: Vec<Run>,
}

impl DeviceFlock {
    pub fn new(device: &FallbackDevice, setting: &Setting, bodies: &[Body]) -> Self {
        let runs = runs(&device.processor.constants.in_world(&setting.factors), setting, bodies);
        Self { device: device.clone(), setting: *setting, bodies: bodies.to_vec(), runs }
    }

    fn advance_here(&mut self, robots: &[usize], spells: &[Spell]) {
        let bodies: Vec<Body> = robots.iter().map(|&robot| self.bodies[robot].clone()).collect();
        let mut flock = self.device.processor.flock(&self.setting, &bodies);
        for (place, &robot) in robots.iter().enumerate() {
            flock.restore(place, &self.snapshot(robot));
        }
        flock.advance_under(&robots.iter().map(|&robot| spells[robot].clone()).collect::<Vec<_>>());
        for (place, &robot) in robots.iter().enumerate() {
            self.runs[robot].restore(&flock.snapshot(place));
        }
    }
}

impl Flock for DeviceFlock {
    fn len(&self) -> usize {
        self.runs.len()
    }

    fn advance_under(&mut self, spells: &[Spell]) {
        assert_eq!(spells.len(), self.len(), "each robot has a spell");
        let mut ahead = self.runs.clone();
        for (run, spell) in ahead.iter_mut().zip(spells) {
            run.assign(&Schedule { spells: vec![spell.clone()] });
        }
        match self.device.finish(&self.setting, &mut ahead, &mut |_, _| {}) {
            Some(too_large) => {
                self.runs = ahead;
                self.advance_here(&too_large, spells);
            }
            None => self.advance_here(&(0..self.len()).collect::<Vec<_>>(), spells),
        }
    }

    fn retain(&mut self, keep: &[bool]) {
        assert_eq!(keep.len(), self.len(), "each robot is kept or not");
        let mut of_runs = keep.iter();
        self.runs.retain(|_| of_runs.next().is_some_and(|&keep| keep));
        let mut of_bodies = keep.iter();
        self.bodies.retain(|_| of_bodies.next().is_some_and(|&keep| keep));
    }

    fn center(&self, i: usize) -> [f64; 2] {
        self.runs[i].center
    }

    fn fault(&self, i: usize) -> Option<Fault> {
        self.runs[i].fault
    }

    fn clock(&self, i: usize) -> u32 {
        self.runs[i].clock
    }

    fn lattice(&self, i: usize) -> &Lattice {
        &self.runs[i].lattice
    }

    fn points(&self, i: usize) -> Vec<[f64; 2]> {
        let cell = self.device.processor.constants.cell;
        self.runs[i].state.position.iter().map(|at| at.map(|axis| axis / cell)).collect()
    }

    fn snapshot(&self, i: usize) -> Snapshot {
        let run = &self.runs[i];
        Snapshot { state: run.state.clone(), center: run.center, clock: run.clock, fault: run.fault }
    }

    fn restore(&mut self, i: usize, snapshot: &Snapshot) {
        self.runs[i].restore(snapshot);
    }
}
