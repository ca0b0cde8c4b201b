//! Keeps the swarms of tests in files, so that a test that takes hours can go on after an end of the program.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use nbc_base::diag::Diagnostic;
use nbc_session::store::SwarmCheckpoint;
use nbc_session::{Observer, SwarmKeeper};
use nbc_swarm::{KeptSwarm, SwarmTask};

const PERIOD: Duration = Duration::from_secs(60);

pub(super) struct Keeping<O> {
    pub(super) observer: O,
    pub(super) keeper: Option<Keeper>,
}

impl<O: Observer> Observer for Keeping<O> {
    fn progress(&mut self, done: u64, all: u64) {
        self.observer.progress(done, all);
    }

    fn is_cancelled(&self) -> bool {
        self.observer.is_cancelled() || self.keeper.as_ref().is_some_and(|keeper| keeper.fault.is_some())
    }

    fn keeper(&mut self) -> Option<&mut dyn SwarmKeeper> {
        self.keeper.as_mut().map(|keeper| keeper as &mut dyn SwarmKeeper)
    }
}

pub(super) struct Keeper {
    path: PathBuf,
    task: Option<SwarmTask>,
    last: Instant,
    /// Why the file cannot be read or written; the test ends then.
    pub(super) fault: Option<Diagnostic>,
}

impl Keeper {
    /// `name` is that of no other test of the command.
    pub(super) fn new(folder: &Path, name: &str) -> Self {
        Self { path: folder.join(format!("{name}.swarm")), task: None, last: Instant::now(), fault: None }
    }
}

impl SwarmKeeper for Keeper {
    fn begin(&mut self, task: &SwarmTask) -> Option<KeptSwarm> {
        let kept = SwarmCheckpoint::open(&self.path, task);
        self.task = Some(task.clone());
        self.last = Instant::now();
        match kept {
            Ok(kept) => kept.map(|kept| kept.swarm),
            Err(fault) => {
                self.fault = Some(fault);
                None
            }
        }
    }

    fn is_due(&mut self) -> bool {
        self.last.elapsed() >= PERIOD
    }

    fn keep(&mut self, kept: &KeptSwarm) {
        // A file of another test stays as it is.
        if let (Some(task), None) = (&self.task, &self.fault) {
            self.fault = SwarmCheckpoint::new(task, kept.clone()).save(&self.path).err();
        }
        self.last = Instant::now();
    }

    fn end(&mut self) {
        if self.fault.is_none() {
            // A file that cannot be removed does no harm: the same test would go on from it.
            let _ = std::fs::remove_file(&self.path);
        }
    }
}
