//! A device with the processor as its fallback, which simulates what the device cannot.

use std::sync::{Arc, Mutex, PoisonError};

use crate::backend::lanes::LaneBackend;
use crate::backend::opencl::card::Card;
use crate::backend::opencl::device_runs::DeviceWorld;
use crate::backend::opencl::error::DeviceError;
use crate::backend::opencl::listing::OpenClDevice;
use crate::backend::run::Run;
use crate::meter::Stopwatch;
use nbc_base::model::{Setting, WorldFactors};

/// A device, and the processor for what the device cannot simulate. Clones share the device and its failure.
#[derive(Clone, Debug)]
pub struct FallbackDevice {
    /// The numbers of the physics, and the back end of what the device cannot do.
    pub processor: LaneBackend,
    card: Arc<Card>,
    failure: Arc<Mutex<Option<DeviceError>>>,
}

impl FallbackDevice {
    pub fn open(device: &OpenClDevice, processor: LaneBackend, group: Option<usize>) -> Result<Self, DeviceError> {
        Ok(Self { processor, card: Arc::new(Card::open(device, group)?), failure: Arc::default() })
    }

    pub fn device(&self) -> &OpenClDevice {
        &self.card.device
    }

    pub fn failure(&self) -> Option<DeviceError> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    pub fn give_up(&self, error: DeviceError) {
        *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    }

    /// Simulates runs on the device until they are done, calling `record` with the center of mass after each env step.
    /// Returns those that are too large for it, or nothing if it failed, now or before, or if the world has other
    /// physics than the kernels of the device, which contain the numbers of the paper's.
    pub fn finish(
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
