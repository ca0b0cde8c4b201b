//! This processor's back end: several robots in the lanes of its vector instructions, on all its threads.
#![allow(clippy::needless_range_loop, reason = "an axis or a corner indexes several arrays at once")]

mod batch;
mod contact;
mod flock;
mod group;
mod grouping;
mod kernel;
mod lane_batch;
mod limits;
mod loads;
mod mass;
mod proximity;
mod real;
mod response;
mod scenes;
mod springs;
mod step;
mod stiffness;
mod terrain;
mod threads;
mod trials;
#[cfg_attr(all(target_arch = "wasm32", target_feature = "simd128"), path = "simd128.rs")]
mod vector;
mod world;

use std::sync::Arc;

use crate::backend::{Backend, Flock};
use crate::constants::Constants;
use crate::meter::Meter;
use crate::monitor::Monitor;
use crate::terrain::Terrain;
use nbc_base::model::{Body, Setting, Trajectory, Trial};

pub use kernel::{InstructionSet, Kernel};
#[cfg(feature = "gpu")]
pub(super) use proximity::{MARGIN, SLACK};
pub use scenes::{SceneState, Scenes};
#[cfg(feature = "gpu")]
pub(super) use springs::FRAME;

use batch::Floor;
use flock::LaneFlock;
use world::World;

#[derive(Clone, Debug, Default)]
pub struct LaneBackend {
    pub constants: Constants,
    pub kernel: Kernel,
    /// Measures the time of each part, at the cost of a few percent of speed.
    pub meter: Option<Arc<Meter>>,
    pub monitor: Option<Arc<Monitor>>,
}

impl LaneBackend {
    fn world(&self, setting: &Setting) -> World {
        let Self { constants, kernel, meter, monitor } = self.clone();
        let constants = constants.in_world(&setting.factors);
        let floor = if setting.ground.is_flat() {
            Floor::Flat(setting.world_width)
        } else {
            Floor::Terrain(Arc::new(Terrain::ground(setting.world_width, &setting.ground, &constants)))
        };
        World { constants, kernel, floor, meter, monitor }
    }
}

impl Backend for LaneBackend {
    fn at_once(&self) -> usize {
        self.kernel.lanes() * threads::count()
    }

    fn flock(&self, setting: &Setting, bodies: &[Body]) -> Box<dyn Flock> {
        Box::new(LaneFlock::new(self.world(setting), setting, bodies))
    }

    fn run_trials(&self, setting: &Setting, trials: &[Trial]) -> Vec<Trajectory> {
        trials::run_trials(&self.world(setting), setting, trials)
    }
}
