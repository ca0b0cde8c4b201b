//! What can be wrong with files, as data, and how it is worded: a file for each kind of file.

#[cfg(feature = "disk")]
mod checkpoints;
#[cfg(feature = "disk")]
mod circuits;
mod robots;

#[cfg(feature = "disk")]
pub(super) use checkpoints::{CheckpointError, StateError};
#[cfg(feature = "disk")]
pub(super) use circuits::StoreError;
pub(super) use robots::{Flaw, LibraryError, RobotFileError, with_body_example};
