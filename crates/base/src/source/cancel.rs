//! A flag by which another thread can end work early.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A request to end work early: a search of mapping, a translation, a check. Clones share their state.
/// A cancelled search soon returns the best network so far: it has the function of its source, but perhaps more cells.
/// A flag that is never raised does not affect a result.
#[derive(Clone, Debug, Default)]
pub struct CancelFlag(Arc<AtomicBool>);

impl From<Arc<AtomicBool>> for CancelFlag {
    fn from(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }
}

impl CancelFlag {
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
