//! A view of running simulations for another thread, which can also end them.

use std::sync::atomic::{AtomicU64, Ordering};

use nbc_base::source::CancelFlag;

/// Counts the env steps of simulations and ends them on request; the results up to the end are the same bits.
#[derive(Debug, Default)]
pub struct Monitor {
    env_steps: AtomicU64,
    stop: CancelFlag,
}

impl Monitor {
    pub fn until(stop: CancelFlag) -> Self {
        Self { env_steps: AtomicU64::new(0), stop }
    }

    /// Env steps done so far, of all robots together.
    pub fn env_steps(&self) -> u64 {
        self.env_steps.load(Ordering::Relaxed)
    }

    /// Stops all simulations, also later ones, with the fault [`nbc_base::model::FaultKind::Stopped`].
    pub fn stop(&self) {
        self.stop.raise();
    }

    pub fn is_stopped(&self) -> bool {
        self.stop.is_raised()
    }

    pub(super) fn count(&self, robots: usize) {
        self.env_steps.fetch_add(robots as u64, Ordering::Relaxed);
    }
}
