//! Files: the disk as a [`nbc_base::source::SourceWorld`], atomic writes, robot files, checkpoints, the built-in
//! library. The only user of YAML.

#[cfg(feature = "disk")]
mod atomic;
#[cfg(feature = "disk")]
mod checkpoint;
#[cfg(feature = "disk")]
mod circuit_file;
#[cfg(feature = "disk")]
mod disk;
#[cfg(feature = "disk")]
mod disk_world;
#[cfg(feature = "disk")]
mod draft;
#[cfg(feature = "disk")]
mod folder;
#[cfg(feature = "disk")]
mod guarded;
mod library;
#[cfg(feature = "disk")]
mod lock;
#[cfg(feature = "disk")]
mod results;
mod robot;
#[cfg(feature = "disk")]
mod search_state;
mod shape;
mod soundness;
#[cfg(feature = "disk")]
mod source_files;
#[cfg(feature = "disk")]
mod swarm_checkpoint;
#[cfg(feature = "disk")]
mod temporary;
#[cfg(feature = "disk")]
mod verilog;
mod wording;
mod yaml;

pub use library::{best_first, built_in, read_library, shipped_library, three_library};
pub use robot::{FORMAT, RobotRecord, print_robot, read_robot};
pub use shape::read_body;
pub use soundness::is_robot_name;
#[cfg(feature = "disk")]
pub use {
    atomic::{create_folder, write, write_file, write_with},
    checkpoint::Checkpoint,
    circuit_file::{CircuitFile, CircuitRead, encode_circuit, read_circuit, read_model, read_rows, with_comment},
    disk::{read, read_text},
    disk_world::DiskWorld,
    folder::FolderWorld,
    guarded::GuardedWorld,
    lock::{FolderLock, LockFault, lock_folder},
    results::{ResultPlace, write_result},
    source_files::source_files,
    swarm_checkpoint::SwarmCheckpoint,
    temporary::{PrivateFile, temporary_folder},
    verilog::{ParameterValue, TopModule},
};
