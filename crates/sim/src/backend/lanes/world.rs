//! The data shared by simulations with the same setting.

use std::sync::Arc;

use crate::backend::lanes::batch::Floor;
use crate::backend::lanes::kernel::Kernel;
use crate::constants::Constants;
use crate::meter::Meter;
use crate::monitor::Monitor;

#[derive(Clone, Debug)]
pub struct World {
    pub constants: Constants,
    pub kernel: Kernel,
    pub floor: Floor,
    pub meter: Option<Arc<Meter>>,
    pub monitor: Option<Arc<Monitor>>,
}

impl World {
    pub fn is_stopped(&self) -> bool {
        self.monitor.as_ref().is_some_and(|monitor| monitor.is_stopped())
    }

    pub fn count(&self, robots: usize) {
        if let Some(monitor) = &self.monitor {
            monitor.count(robots);
        }
    }
}
