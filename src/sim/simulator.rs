//! How to simulate: the numbers of the physics and the kernel.

use crate::model::{Body, Setting};
use crate::sim::constants::Constants;
use crate::sim::flock::Flock;
use crate::sim::kernel::Kernel;
use crate::sim::probe::Probe;

/// How to simulate. The default is the physics on the fastest kernel of this processor; results do not depend on the kernel.
#[derive(Clone, Debug, Default)]
pub struct Simulator {
    /// The numbers of the physics.
    pub constants: Constants,
    /// The kernel.
    pub kernel: Kernel,
    /// Told where time goes, if anybody asks.
    pub probe: Option<Probe>,
}

impl Simulator {
    /// Robots that live on; see [`Flock::new`].
    pub fn flock(&self, setting: &Setting, bodies: &[Body]) -> Flock {
        Flock::with(self, setting, bodies)
    }
}
