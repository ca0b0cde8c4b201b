//! Checkpoints of swarms in tests: a line with format and checksum, then the swarm as JSON.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::atomic::write_file;
use crate::checkpoint::{framed, unframed};
use crate::disk::read;
use crate::wording::{CheckpointError, StateError};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::FileError;
use nbc_swarm::{KeptSwarm, SwarmTask};

/// The version that this program writes and reads.
const FORMAT: &str = "1";
/// The first bytes of the files.
const MAGIC: &str = "nbc-swarm";

/// A swarm that was kept, and the task that it belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SwarmCheckpoint {
    /// What tells the task: checksums of its robots and of its inputs.
    task: [u32; 2],
    /// The swarm.
    pub swarm: KeptSwarm,
}

impl SwarmCheckpoint {
    /// The checkpoint of a task.
    pub fn new(task: &SwarmTask, swarm: KeptSwarm) -> Self {
        Self { task: checksums(task), swarm }
    }

    /// Writes the file, whole or not at all.
    pub fn save(&self, path: &Path) -> Result<(), Diagnostic> {
        write_file(path, &framed(MAGIC, FORMAT, &serde_json::to_string(self).expect("a swarm can be written as JSON")))
    }

    /// Reads the file of a task; `None` if there is none.
    pub fn open(path: &Path, task: &SwarmTask) -> Result<Option<Self>, Diagnostic> {
        let name = path.display().to_string();
        let bytes = match read(path, Limit::CheckpointBytes.most()) {
            Ok(bytes) => bytes,
            Err(FileError::NotFound) => return Ok(None),
            Err(error) => return Err(Diagnostic::unreadable(&name, &error)),
        };
        Self::read(&bytes, task).map(Some).map_err(|error| error.of(&name))
    }

    fn read(bytes: &[u8], task: &SwarmTask) -> Result<Self, CheckpointError> {
        let (format, text) = unframed(MAGIC, bytes)?;
        if format != FORMAT {
            return Err(CheckpointError::Format { found: format.to_owned(), expected: FORMAT });
        }
        let text = text?;
        let kept: Self =
            serde_json::from_slice(text).map_err(|error| CheckpointError::Unreadable(StateError::from(error)))?;
        let is_same = kept.task == checksums(task) && kept.swarm.outputs(task.robots()).is_some();
        if is_same { Ok(kept) } else { Err(CheckpointError::OtherSwarm) }
    }
}

/// Checksums of all that the bits of a task depend on.
fn checksums(task: &SwarmTask) -> [u32; 2] {
    let robots = format!("{:?} {:?} {:?}", task.assembly.members, task.assembly.beat, task.assembly.world);
    let inputs = format!("{:?} {}", task.conditions.inputs, task.conditions.window);
    [robots, inputs].map(|text| crc32fast::hash(text.as_bytes()))
}
