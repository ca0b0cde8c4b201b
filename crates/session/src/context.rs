//! What a checked source is made with: the files as they were when it was checked, the robots of the program, and what
//! was made last.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use crate::compiled::Compiled;
use crate::store;
use nbc_base::model::{Instance, Library};
use nbc_base::source::{
    CancelFlag, FileError, OverlayWorld, SharedWorld, SourceWorld, VerilogError, VerilogFiles, VerilogModules,
};
use nbc_circuit::{Effort, MappingObjective, Netlist};

#[derive(Default)]
pub(super) struct BuiltIn {
    shipped: OnceLock<Library>,
    three: OnceLock<Library>,
}

impl BuiltIn {
    pub(super) fn shipped(&self) -> &Library {
        self.shipped.get_or_init(store::shipped_library)
    }

    pub(super) fn three(&self) -> &Library {
        self.three.get_or_init(store::three_library)
    }
}

pub(super) struct CheckContext {
    pub(super) world: RecordingWorld,
    pub(super) built_in: Arc<BuiltIn>,
    pub(super) netlists: Mutex<BTreeMap<Instance, Arc<Netlist>>>,
    /// The last ones, so that the tests of a circuit share its swarm.
    pub(super) compiled: Mutex<Vec<(MappingObjective, Effort, Compiled)>>,
}

impl fmt::Debug for CheckContext {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("CheckContext")
    }
}

/// A panic leaves what these locks guard whole.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Results of reading Verilog, by the paths of the files.
pub(super) type Readings = Arc<Mutex<BTreeMap<Vec<String>, (VerilogFiles, VerilogModules)>>>;

/// The files of a session, and which of them were asked for.
pub(super) struct RecordingWorld {
    world: OverlayWorld<SharedWorld>,
    asked: Mutex<BTreeSet<String>>,
    readings: Readings,
    is_cancelled: AtomicBool,
}

impl RecordingWorld {
    pub(super) fn of(world: OverlayWorld<SharedWorld>, readings: Readings) -> Self {
        Self { world, asked: Mutex::default(), readings, is_cancelled: AtomicBool::new(false) }
    }

    fn note(&self, path: &str) {
        lock(&self.asked).insert(self.world.identity(path));
    }

    pub(super) fn asked(&self) -> BTreeSet<String> {
        lock(&self.asked).clone()
    }

    pub(super) fn has_asked(&self, identity: &str) -> bool {
        lock(&self.asked).contains(identity)
    }

    pub(super) fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }
}

impl SourceWorld for RecordingWorld {
    fn read(&self, path: &str) -> Result<String, FileError> {
        self.note(path);
        self.world.read(path)
    }

    fn read_bytes(&self, path: &str) -> Result<Vec<u8>, FileError> {
        self.note(path);
        self.world.read_bytes(path)
    }

    fn read_verilog(&self, files: &VerilogFiles) -> Result<VerilogModules, VerilogError> {
        let paths: Vec<String> = files.files.iter().map(|file| file.path.clone()).collect();
        let known = lock(&self.readings).get(&paths).filter(|(known, _)| known == files).cloned();
        if let Some((_, modules)) = known {
            return Ok(modules);
        }
        let modules = self.world.read_verilog(files);
        if modules == Err(VerilogError::Cancelled) {
            self.is_cancelled.store(true, Ordering::Relaxed);
        }
        let modules = modules?;
        lock(&self.readings).insert(paths, (files.clone(), modules.clone()));
        Ok(modules)
    }

    fn cancel(&self) -> CancelFlag {
        self.world.cancel()
    }

    fn list(&self, folder: &str) -> Result<Vec<String>, FileError> {
        self.note(folder);
        self.world.list(folder)
    }

    fn identity(&self, path: &str) -> String {
        self.world.identity(path)
    }
}
