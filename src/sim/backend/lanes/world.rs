//! The data shared by simulations with the same setting.

use std::sync::Arc;

use crate::sim::backend::lanes::kernel::Kernel;
use crate::sim::constants::Constants;
use crate::sim::meter::Meter;

/// The data shared by simulations with the same setting.
#[derive(Clone, Debug)]
pub struct World {
    /// The numbers of the physics.
    pub constants: Constants,
    /// The kernel that simulates.
    pub kernel: Kernel,
    /// Ground voxels in a row.
    pub width: usize,
    /// Measures the time of each part, if requested.
    pub meter: Option<Arc<Meter>>,
}
