//! Files: the disk as a [`crate::source::SourceWorld`], atomic writes, robot files, checkpoints, the built-in library. The
//! only user of YAML.

mod atomic;
mod checkpoint;
mod circuit_file;
mod declared;
mod disk;
mod draft;
mod first_checkpoint;
mod library;
mod lock;
mod robot;
mod search_state;
mod shape;
mod soundness;
mod yaml;
mod yosys;

pub use atomic::{create_folder, write, write_with};
pub use checkpoint::Checkpoint;
pub use circuit_file::{encode_circuit, read_circuit};
pub use declared::Declared;
pub use disk::{
    DiskWorld, MAX_CHECKPOINT_BYTES, MAX_CIRCUIT_BYTES, MAX_PROGRESS_BYTES, MAX_ROBOT_BYTES, read, read_text,
};
pub use library::{best_first, read_library, shipped_library};
pub use lock::{FolderLock, LockFault, lock_folder};
pub use robot::{FORMAT, RobotRecord, own_materials, print_robot, read_robot};
pub use shape::read_body;
