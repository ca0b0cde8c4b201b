//! The physics of voxel robots: bodies and stimuli in, trajectories out (docs/physics.md).
//!
//! It knows nothing of languages, gates or evolution.

mod backend;
mod constants;
mod grid;
mod lattice;
mod meter;
mod monitor;
mod observation;
mod scene;
mod signal;
mod simulator;
mod state;
mod terrain;

pub use backend::lanes::{InstructionSet, Kernel, LaneBackend, SceneState, Scenes};
#[cfg(feature = "gpu")]
pub use backend::opencl::{BoxComparison, DeviceError, DeviceKind, OpenClBackend, OpenClDevice, SelfTest};
pub use backend::{Backend, Flock, Snapshot};
pub use constants::Constants;
pub use grid::{DriveAxis, Grid, GridCell};
pub use lattice::{DrivenEdge, Edge, Lattice, LatticePart, LatticePoint, Voxel};
pub use meter::{Meter, Part, Times};
pub use monitor::Monitor;
pub use observation::{ObjectCenter, Sight};
pub use scene::{Scene, SceneObject};
pub use signal::Signals;
pub use simulator::Simulator;
pub use state::State;
