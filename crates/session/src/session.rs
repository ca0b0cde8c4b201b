//! The session: each door (command line, editor, page, cluster) calls one and repeats none of its steps. A session is a
//! value: it can be dropped at any moment, and two sessions share no mutable state.

use std::sync::Arc;

use crate::documents::Documents;
use crate::observer::Observer;
use crate::replay::{self, Excerpt};
use crate::simulation::{self, SimulationRun};
use crate::swarm_run::Physics;
use crate::test::TestOptions;
use crate::{Checked, CompileOptions, Compiled, Formatted, RunList, RunReport, formatted, store, swarm_run};
use nbc_base::diag::Diagnostics;
use nbc_base::model::{Library, Simulation};
use nbc_base::source::{SourceWorld, Sources};
use nbc_sim::Simulator;
use nbc_swarm::{Level, LiveSwarm, Room};

/// From sources in a [`SourceWorld`] to checked programs, compiled circuits, tests and running swarms.
pub struct Session {
    documents: Documents,
    pub(super) physics: Physics,
}

impl Session {
    /// Ground of [`Session::swarm`]: enough for a robot that moves by its own width in each of so many cycles.
    pub const LIVE_CYCLES: usize = swarm_run::LIVE_CYCLES;

    pub fn new(world: impl SourceWorld + Send + Sync + 'static) -> Self {
        Self { documents: Documents::new(Arc::new(world)), physics: Physics::default() }
    }

    pub fn with_simulator(mut self, simulator: Simulator) -> Self {
        self.physics.simulator = simulator;
        self
    }

    /// Replaces declared files, by name and path.
    pub fn with_files(mut self, files: Vec<(String, String)>) -> Self {
        self.documents.replace_files(files);
        self
    }

    /// Records the poses of swarms. `room` limits the size of a recording.
    pub fn with_poses(mut self, room: Room) -> Self {
        self.physics.poses = Some(room);
        self
    }

    /// Hides the file of the world. A text with a lower revision than the last one is ignored.
    pub fn update(&mut self, path: &str, revision: u64, text: impl Into<String>) {
        self.documents.update(path, revision, text);
    }

    /// The text given last, or else that of the world.
    pub fn text(&self, path: &str) -> Option<String> {
        self.documents.world().read(path).ok()
    }

    pub fn close(&mut self, path: &str) {
        self.documents.close(path);
    }

    /// Parses and checks a source; the same value until one of its files changes. An unreadable file is a diagnostic.
    pub fn checked(&mut self, path: &str) -> Arc<Checked> {
        self.documents.checked(path)
    }

    /// A cancelled check does not count.
    pub fn is_checked(&self, path: &str) -> bool {
        self.documents.is_known(path)
    }

    pub fn dependencies(&self, path: &str) -> Vec<String> {
        self.documents.asked(path).into_iter().collect()
    }

    pub fn open(&mut self, path: &str) -> Result<Arc<Checked>, Diagnostics> {
        let checked = self.checked(path);
        if checked.has_errors() { Err(checked.fail(checked.diagnostics.clone())) } else { Ok(checked) }
    }

    pub fn formatted(&self, path: &str) -> Result<Formatted, Diagnostics> {
        formatted::format(self.documents.world(), path)
    }

    pub fn shipped(&self) -> &Library {
        self.documents.built_in().shipped()
    }

    /// The robots of a folder of the world, best first.
    pub fn library(&self, folder: &str) -> Result<Library, Diagnostics> {
        if let Some(library) = store::built_in(folder) {
            return Ok(library);
        }
        let read = store::read_library(self.documents.world(), folder);
        read.map_err(|list| Diagnostics { list, sources: Sources::default() })
    }

    pub fn simulate(
        &self,
        checked: &Checked,
        simulation: &Simulation,
        options: &CompileOptions,
        observer: &mut dyn Observer,
    ) -> Result<SimulationRun, Diagnostics> {
        let compiled = simulation::compiled(checked, simulation, options)?;
        Ok(simulation::run(&self.physics, simulation, compiled, observer))
    }

    pub fn swarm(&self, compiled: &Compiled) -> LiveSwarm {
        self.physics.swarm(compiled, Self::LIVE_CYCLES)
    }

    pub fn replay(&self, excerpt: &Excerpt, observer: &mut dyn Observer) -> SimulationRun {
        replay::replay(&self.physics, excerpt, observer)
    }

    /// Runs every test and simulation of a source in physics.
    pub fn run(
        &mut self,
        path: &str,
        options: &CompileOptions,
        observer: &mut dyn Observer,
    ) -> Result<RunReport, Diagnostics> {
        let checked = self.open(path)?;
        let options = TestOptions { level: Some(Level::Physics), compile: options.clone() };
        self.run_list(&checked, &RunList::all(&checked.program), &options, observer)
    }
}

#[cfg(feature = "disk")]
pub fn run_file(path: impl AsRef<std::path::Path>, options: &CompileOptions) -> Result<RunReport, Diagnostics> {
    Session::new(crate::store::DiskWorld).run(&path.as_ref().to_string_lossy(), options, &mut ())
}
