//! The session: each door (command line, editor, page, cluster) calls one and repeats none of its steps. A session is a
//! value: it can be dropped at any moment, and two sessions share no mutable state.

use std::sync::Arc;

use crate::claims::ClaimSearch;
use crate::documents::Documents;
use crate::observer::Observer;
use crate::replay::{self, Excerpt};
use crate::robots::RobotSources;
use crate::script::EnvironmentRun;
use crate::simulation::{self, SimulationRun};
use crate::swarm_run::Physics;
use crate::test::{self, TestCase, TestOptions};
use crate::{
    Checked, CompileOptions, Compiled, Formatted, Mapping, RunList, RunReport, compile, formatted, plan, start_bodies,
    store, swarm_run,
};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostics;
use nbc_base::model::{CircuitTest, Claim, Evolution, Instance, Library, Simulation};
use nbc_base::source::{SourceWorld, Sources, Span};
use nbc_circuit::properties::SearchBudget;
use nbc_circuit::{CancelFlag, CellLibrary, RegisterForm, elaborate};
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
        Self { documents: Documents::new(Box::new(world)), physics: Physics::default() }
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
        self.documents.asked(path).map(str::to_owned).collect()
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

    /// The robots of a declared library or the default one, best first for each function.
    pub fn robots(
        &self,
        checked: &Checked,
        library: Option<&str>,
        options: &CompileOptions,
    ) -> Result<Library, Diagnostics> {
        let robots = plan::robots(self.sources(checked), &checked.program, library, options);
        let robots = robots.map_err(|faults| checked.fail(faults))?;
        Ok(nbc_swarm::prefer(robots, options.objective))
    }

    /// `runs` is the folder of other evolutions' runs.
    pub fn started(&self, checked: &Checked, evolution: &Evolution, runs: &str) -> Result<Evolution, Diagnostics> {
        let started = start_bodies::started(self.sources(checked), &checked.program, evolution, runs);
        started.map_err(|faults| checked.fail(faults))
    }

    fn sources<'a>(&'a self, checked: &'a Checked) -> RobotSources<'a> {
        RobotSources { world: self.documents.world(), built_in: self.documents.built_in(), file: &checked.path }
    }

    /// Maps a circuit onto the robots of its swarm, and proves the result.
    pub fn map(&self, checked: &Checked, circuit: &Instance, options: &CompileOptions) -> Result<Mapping, Diagnostics> {
        let plan = plan::plan(self.sources(checked), &checked.program, circuit, options);
        let plan = plan.map_err(|faults| checked.fail(faults))?;
        let source = elaborate(&checked.program, circuit).map_err(|faults| checked.fail(faults))?;
        let mapping = compile::map(source, &plan, &options.mapping(), checked.place(circuit), Limit::Cells);
        mapping.map_err(|faults| checked.fail(faults))
    }

    pub fn map_net(
        &self,
        checked: &Checked,
        circuit: &Instance,
        net: Span,
        options: &CompileOptions,
    ) -> Result<Mapping, Diagnostics> {
        let plan = plan::plan(self.sources(checked), &checked.program, circuit, options);
        let plan = plan.map_err(|faults| checked.fail(faults))?;
        let mapping = compile::map_net(&checked.program, &plan, net, options.mapping());
        mapping.map_err(|faults| checked.fail(faults))
    }

    /// Maps a circuit onto cells that need not be robots, and proves the result.
    pub fn map_onto(
        &self,
        checked: &Checked,
        circuit: &Instance,
        cells: &CellLibrary,
        options: &CompileOptions,
    ) -> Result<Mapping, Diagnostics> {
        let source = elaborate(&checked.program, circuit).map_err(|faults| checked.fail(faults))?;
        let place = checked.place(circuit);
        let mapping = compile::map_onto(source, cells, &options.mapping(), RegisterForm::Nands, place, Limit::Cells);
        mapping.map_err(|faults| checked.fail(faults))
    }

    /// Compiles a circuit to the swarm that is declared for it: elaborate, map, prove, time, assemble.
    pub fn compile(
        &self,
        checked: &Checked,
        circuit: &Instance,
        options: &CompileOptions,
    ) -> Result<Compiled, Diagnostics> {
        let (program, place) = (&checked.program, checked.place(circuit));
        let plan = plan::plan(self.sources(checked), program, circuit, options);
        let compiled = plan.and_then(|plan| {
            let source = elaborate(program, &plan.circuit)?;
            compile::compile(program, source, plan, &options.mapping(), place)
        });
        compiled.map_err(|faults| checked.fail(faults))
    }

    /// One case for each swarm that is declared for the test's circuit, or one at the level of logic.
    pub fn cases(
        &self,
        checked: &Checked,
        test: &CircuitTest,
        options: &TestOptions,
    ) -> Result<Vec<TestCase>, Diagnostics> {
        test::cases(self.sources(checked), &checked.program, test, options).map_err(|faults| checked.fail(faults))
    }

    /// What the environment of a test does in its first rows in physics; `None` without an environment.
    pub fn environment(
        &self,
        checked: &Checked,
        test: &CircuitTest,
        rows: usize,
        options: &CompileOptions,
    ) -> Result<Option<EnvironmentRun>, Diagnostics> {
        let run = test::environment(self.sources(checked), &checked.program, test, rows, options);
        run.map_err(|faults| checked.fail(faults))
    }

    /// Begins to decide a claim. The search ends when its budget does, or when the flag is raised.
    pub fn prove(
        &self,
        checked: &Checked,
        claim: &Claim,
        budget: SearchBudget,
        cancel: CancelFlag,
    ) -> Result<ClaimSearch, Diagnostics> {
        ClaimSearch::new(&checked.program, claim, budget, cancel).map_err(|faults| checked.fail(faults))
    }

    pub fn simulate(
        &self,
        checked: &Checked,
        simulation: &Simulation,
        options: &CompileOptions,
        observer: &mut dyn Observer,
    ) -> Result<SimulationRun, Diagnostics> {
        let compiled = simulation::compiled(self.sources(checked), &checked.program, simulation, options);
        let compiled = compiled.map_err(|faults| checked.fail(faults))?;
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
