//! A laboratory on other machines.

use crate::cli::Failure;
use nbc_swarm::Laboratory;

/// A laboratory on other machines. After a signal or a failure, all work is stopped.
pub trait DistantLaboratory: Laboratory {
    /// Ends it.
    ///
    /// # Errors
    /// When it has failed.
    fn end(self: Box<Self>) -> Result<(), Failure>;
}
