//! The data shared by simulations with the same setting.

use std::sync::Arc;

use crate::backend::lanes::batch::Floor;
use crate::backend::lanes::kernel::Kernel;
use crate::constants::Constants;
use crate::meter::Meter;
use crate::monitor::Monitor;

/// The data shared by simulations with the same setting.
#[derive(Clone, Debug)]
pub struct World {
    /// The numbers of the physics.
    pub constants: Constants,
    /// The kernel that simulates.
    pub kernel: Kernel,
    /// What the robots stand on.
    pub floor: Floor,
    /// Measures the time of each part, if requested.
    pub meter: Option<Arc<Meter>>,
    /// Follows simulations, if requested.
    pub monitor: Option<Arc<Monitor>>,
}

impl World {
    /// Whether simulations are to end now.
    pub fn is_stopped(&self) -> bool {
        self.monitor.as_ref().is_some_and(|monitor| monitor.is_stopped())
    }

    /// Counts an env step of that many robots.
    pub fn count(&self, robots: usize) {
        if let Some(monitor) = &self.monitor {
            monitor.count(robots);
        }
    }
}
