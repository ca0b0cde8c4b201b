//! The simulator: the physics in the hands of a back end.

use std::sync::Arc;

use crate::backend::lanes::LaneBackend;
use crate::backend::{Backend, Flock};
use crate::monitor::Monitor;
use nbc_base::model::{Body, Setting, Trajectory, Trial};

/// The back end of simulations. The default is the fastest kernel of this processor; results do not depend on it.
#[derive(Clone, Debug)]
pub struct Simulator {
    backend: Arc<dyn Backend>,
}

impl Default for Simulator {
    fn default() -> Self {
        Self::new(LaneBackend::default())
    }
}

impl Simulator {
    pub fn new(backend: impl Backend + 'static) -> Self {
        Self { backend: Arc::new(backend) }
    }

    pub fn monitored(monitor: Arc<Monitor>) -> Self {
        Self::new(LaneBackend { monitor: Some(monitor), ..LaneBackend::default() })
    }

    pub fn at_once(&self) -> usize {
        self.backend.at_once()
    }

    pub fn flock(&self, setting: &Setting, bodies: &[Body]) -> Box<dyn Flock> {
        self.backend.flock(setting, bodies)
    }

    pub fn run_trials(&self, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
        self.backend.run_trials(setting, trials)
    }
}
