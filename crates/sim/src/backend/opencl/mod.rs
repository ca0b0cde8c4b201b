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
mod fallback_device;
mod flock;
mod listing;
mod plan;
mod self_test;

use crate::backend::lanes::LaneBackend;
use crate::backend::run::runs;
use crate::backend::{Backend, Flock};
use nbc_base::model::{Body, Setting, Trajectory, Trial};

pub use error::DeviceError;
pub use listing::{DeviceKind, OpenClDevice};
pub use self_test::{BoxComparison, SelfTest};

use device_runs::AT_ONCE;
use fallback_device::FallbackDevice;
use flock::DeviceFlock;

#[derive(Clone, Debug)]
pub struct OpenClBackend {
    device: FallbackDevice,
}

impl OpenClBackend {
    /// Opens a device and compares a few of its results with those of this processor.
    pub fn open(device: &OpenClDevice, processor: LaneBackend) -> Result<Self, DeviceError> {
        let backend = Self::unchecked(device, processor, None)?;
        let (_, problem) = backend.test(SelfTest::QUICK)?;
        problem.map_or(Ok(backend), Err)
    }

    /// Opens a device without comparing its results, with groups of that many work-items instead of the best number.
    pub fn unchecked(device: &OpenClDevice, processor: LaneBackend, group: Option<usize>) -> Result<Self, DeviceError> {
        Ok(Self { device: FallbackDevice::open(device, processor, group)? })
    }

    pub fn device(&self) -> &OpenClDevice {
        self.device.device()
    }

    pub fn processor(&self) -> &LaneBackend {
        &self.device.processor
    }

    /// Why the device failed, if it did. All that it was to do was then done by this processor.
    pub fn failure(&self) -> Option<DeviceError> {
        self.device.failure()
    }

    /// Counts the device as failed: from now on this processor does its work.
    pub fn give_up(&self, error: DeviceError) {
        self.device.give_up(error);
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
}

impl Backend for OpenClBackend {
    fn at_once(&self) -> usize {
        match self.failure() {
            Some(_) => self.processor().at_once(),
            None => AT_ONCE * self.device().multiprocessors.max(1),
        }
    }

    fn flock(&self, setting: &Setting, bodies: &[Body]) -> Box<dyn Flock> {
        Box::new(DeviceFlock::new(&self.device, setting, bodies))
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
        let Some(too_large) = self.device.finish(setting, &mut runs, &mut record) else {
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
