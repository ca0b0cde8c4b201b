//! What the simulations of one setting share.

use std::sync::Arc;

use crate::sim::backend::lanes::kernel::Kernel;
use crate::sim::constants::Constants;
use crate::sim::meter::Meter;

/// What the simulations of one setting share.
#[derive(Clone, Debug)]
pub struct World {
    /// The numbers of the physics.
    pub constants: Constants,
    /// The kernel that simulates.
    pub kernel: Kernel,
    /// Ground voxels in a row.
    pub width: usize,
    /// Counts where time goes, where that is wanted.
    pub meter: Option<Arc<Meter>>,
}
