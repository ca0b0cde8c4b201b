//! Checkpoints of swarms in tests: a line with format and checksum, then the swarm as JSON.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::atomic::write_file;
use crate::checkpoint::{framed, unframed};
use crate::disk::read;
use crate::wording;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::source::FileError;
use nbc_swarm::{KeptSwarm, SwarmTask};

const FORMAT: &str = "1";
const MAGIC: &str = "nbc-swarm";

/// A swarm that was kept, and the task that it belongs to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SwarmCheckpoint {
    task: [u32; 2],
    pub swarm: KeptSwarm,
}

impl SwarmCheckpoint {
    pub fn new(task: &SwarmTask, swarm: KeptSwarm) -> Self {
        Self { task: checksums(task), swarm }
    }

    pub fn save(&self, path: &Path) -> Result<(), Diagnostic> {
        write_file(path, &framed(MAGIC, FORMAT, &serde_json::to_string(self).expect("a swarm can be written as JSON")))
    }

    pub fn open(path: &Path, task: &SwarmTask) -> Result<Option<Self>, Diagnostic> {
        let name = path.display().to_string();
        let bytes = match read(path, Limit::CheckpointBytes.most()) {
            Ok(bytes) => bytes,
            Err(FileError::NotFound) => return Ok(None),
            Err(error) => return Err(Diagnostic::unreadable(&name, &error)),
        };
        let text = unframed(&name, MAGIC, FORMAT, &bytes)?;
        let kept: Self =
            serde_json::from_slice(text).map_err(|error| wording::unreadable_state(&name, &error.to_string()))?;
        let is_same = kept.task == checksums(task) && kept.swarm.outputs(task.robots()).is_some();
        if is_same { Ok(Some(kept)) } else { Err(wording::other_swarm(&name)) }
    }
}

/// Checksums of all that the bits of a task depend on.
fn checksums(task: &SwarmTask) -> [u32; 2] {
    let robots = format!("{:?} {:?} {:?}", task.assembly.members, task.assembly.beat, task.assembly.world);
    let inputs = format!("{:?} {}", task.conditions.inputs, task.conditions.window);
    [robots, inputs].map(|text| crc32fast::hash(text.as_bytes()))
}
