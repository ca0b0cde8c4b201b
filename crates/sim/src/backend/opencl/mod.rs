//! The back end for graphics cards and other OpenCL devices: thousands of robots side by side, a work-group each
//! (docs/gpu.md).
//!
//! The driver is looked for when a device is opened, so the program starts without one. Every robot that a device
//! cannot simulate, because it is too large or because the device fails, is simulated by this processor with the same
//! bits.

mod capacity;
mod card;
mod device_runs;
mod error;
mod listing;
mod plan;
mod self_test;

use std::sync::{Arc, Mutex, PoisonError};

use crate::backend::lanes::LaneBackend;
use crate::backend::run::{Run, runs};
use crate::backend::{Backend, Flock, Snapshot};
use crate::lattice::Lattice;
use crate::meter::Stopwatch;
use nbc_base::model::{Body, Fault, Schedule, Setting, Spell, Trajectory, Trial, WorldFactors};

pub use error::DeviceError;
pub use listing::{DeviceKind, OpenClDevice};
pub use self_test::{BoxComparison, SelfTest};

use card::Card;
use device_runs::{AT_ONCE, DeviceWorld};

/// A device, and this processor for what the device cannot do. Clones share the device and its failure.
#[derive(Clone, Debug)]
pub struct OpenClBackend {
    processor: LaneBackend,
    card: Arc<Card>,
    failure: Arc<Mutex<Option<DeviceError>>>,
}

impl OpenClBackend {
    pub fn open(device: &OpenClDevice, processor: LaneBackend) -> Result<Self, DeviceError> {
        let backend = Self::unchecked(device, processor, None)?;
        let (_, problem) = backend.test(SelfTest::QUICK)?;
        problem.map_or(Ok(backend), Err)
    }

    /// Opens a device without comparing its results, with groups of that many work-items instead of the best number.
    pub fn unchecked(device: &OpenClDevice, processor: LaneBackend, group: Option<usize>) -> Result<Self, DeviceError> {
        Ok(Self { processor, card: Arc::new(Card::open(device, group)?), failure: Arc::default() })
    }

    pub fn device(&self) -> &OpenClDevice {
        &self.card.device
    }

    pub fn processor(&self) -> &LaneBackend {
        &self.processor
    }

    /// Why the device failed, if it did. All that it was to do was then done by this processor.
    pub fn failure(&self) -> Option<DeviceError> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub fn give_up(&self, error: DeviceError) {
        *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    }

    pub fn test(&self, test: SelfTest) -> Result<(Vec<BoxComparison>, Option<DeviceError>), DeviceError> {
        let comparisons = test.compare(self, self.processor());
        if let Some(error) = self.failure() {
            return Err(error);
        }
        let differs = comparisons.iter().any(|comparison| comparison.different > 0);
        let problem = differs.then(|| DeviceError::Differs { device: self.device().name.clone() });
        Ok((comparisons, problem))
    }

    /// Returns the runs that are too large for the device, or nothing if it failed or the world has other physics than
    /// the paper's, whose numbers the kernels contain.
    fn finish(
        &self,
        setting: &Setting,
        runs: &mut [Run],
        record: &mut dyn FnMut(usize, [f64; 2]),
    ) -> Option<Vec<usize>> {
        if self.failure().is_some() || setting.factors != WorldFactors::default() || !setting.ground.is_flat() {
            return None;
        }
        let world = DeviceWorld {
            card: Arc::clone(&self.card),
            constants: self.processor.constants,
            width: setting.world_width,
            monitor: self.processor.monitor.clone(),
        };
        let mut stopwatch = self.processor.meter.as_ref().map(Stopwatch::new);
        let mut env_steps = 0;
        let mut count = |run: usize, center: [f64; 2]| {
            env_steps += 1;
            record(run, center);
        };
        let finished = world.finish(runs, &mut count);
        if let Some(stopwatch) = &mut stopwatch {
            stopwatch.lap_device(env_steps * u64::from(self.processor.constants.substeps));
        }
        finished.map_err(|error| self.give_up(error)).ok()
    }
}

impl Backend for OpenClBackend {
    fn at_once(&self) -> usize {
        match self.failure() {
            Some(_) => self.processor().at_once(),
            None => AT_ONCE * self.device().multiprocessors.max(1),
        }
    }

    fn flock(&self, setting: &Setting, bodies: &[Body]) -> Box<dyn Flock> {
        let runs = runs(&self.processor.constants.in_world(&setting.factors), setting, bodies);
        Box::new(DeviceFlock { device: self.clone(), setting: *setting, bodies: bodies.to_vec(), runs })
    }

    fn run_trials(&self, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
        let processor = self.processor();
        let constants = processor.constants.in_world(&setting.factors);
        let mut runs = runs(&constants, setting, trials.iter().map(|trial| &trial.body));
        let mut trajectories = vec![Trajectory::default(); trials.len()];
        for ((run, trial), trajectory) in runs.iter_mut().zip(trials).zip(&mut trajectories) {
            run.assign(&trial.schedule);
            trajectory.push(run.center);
        }
        let mut record = |run: usize, center| trajectories[run].push(center);
        let Some(too_large) = self.finish(setting, &mut runs, &mut record) else {
            return processor.run_trials(setting, trials);
        };
        for (trajectory, run) in trajectories.iter_mut().zip(&runs) {
            trajectory.fault = run.fault;
        }
        let here: Vec<Trial> = too_large.iter().map(|&trial| trials[trial].clone()).collect();
        for (trial, trajectory) in too_large.into_iter().zip(processor.run_trials(setting, &here)) {
            trajectories[trial] = trajectory;
        }
        trajectories
    }
}

/// States are read after each advance, so that nothing is lost if the device is.
#[derive(Debug)]
struct DeviceFlock {
    device: OpenClBackend,
    setting: Setting,
    bodies: Vec<Body>,
    runs: Vec<Run>,
}

impl DeviceFlock {
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

    fn set_clock(&mut self, i: usize, clock: u32) {
        self.runs[i].clock = clock;
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
