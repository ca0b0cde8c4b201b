//! The physics of voxel robots: bodies, stimuli in; trajectories out (docs/physics.md).
//!
//! It knows nothing of languages, gates or evolution.
#![allow(clippy::needless_range_loop, reason = "an axis or a corner indexes several arrays at once")]

mod batch;
mod constants;
mod contact;
mod flock;
mod kernel;
mod lanes;
mod lattice;
mod limits;
mod probe;
mod proximity;
mod real;
mod response;
mod roster;
mod run;
mod signal;
mod simulator;
mod state;
mod step;
mod stiffness;
mod trials;

pub use constants::Constants;
pub use flock::Flock;
pub use kernel::{InstructionSet, Kernel};
pub use lattice::{DrivenEdge, Edge, Lattice, LatticePoint, Voxel};
pub use probe::{Part, Probe};
pub use simulator::Simulator;
pub use trials::run_trials;
