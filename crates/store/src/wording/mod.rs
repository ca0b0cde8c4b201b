//! Errors of files and their messages: a module for each kind of file.

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
