//! A request to end a search early, which another thread can make.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A request to end a search of mapping early. The copies of a flag are one flag.
///
/// A search that was cancelled ends soon with the best network it has: of cells of the library and with the function of
/// its source as any other, but of more cells than the whole search would need, and how many depends on the moment. A
/// flag that is never raised does not affect the result.
#[derive(Clone, Debug, Default)]
pub struct CancelFlag(Arc<AtomicBool>);

impl From<Arc<AtomicBool>> for CancelFlag {
    fn from(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }
}

impl CancelFlag {
    /// Ends the searches that have this flag, and those that will start.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the search is to end.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
