//! Messages about files: a module for each kind of file.

#[cfg(feature = "disk")]
mod checkpoints;
#[cfg(feature = "disk")]
mod circuits;
mod robots;

#[cfg(feature = "disk")]
pub(super) use checkpoints::*;
#[cfg(feature = "disk")]
pub(super) use circuits::*;
pub(super) use robots::*;
