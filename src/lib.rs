//! Circuits made of soft robots: a declarative language, a compiler to swarms of robots without a brain, and their
//! physics.
//!
//! A circuit with its tests, run in full physics:
//!
//! ```
//! # #[cfg(feature = "disk")]
//! nbc::run_file("circuits/half_adder.nb", &nbc::CompileOptions::default())?.assert_passed();
//! # Ok::<(), nbc::Diagnostics>(())
//! ```
//!
//! The names below are the library, each with an example. A [`Session`] goes from source text to a swarm:
//! [`Session::open`], [`Session::compile`], [`Session::test`], [`Session::simulate`] and [`Session::swarm`]. Everything
//! that can be wrong with a source is [`Diagnostics`]. Robots can be simulated without a circuit by a [`Simulator`],
//! and evolved by a [`Search`].
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | none | source to swarm, circuits, simulation, search |
//! | `parallel` | simulation on all cores |
//! | `pictures` | drawings as pixels, films |
//! | `disk` | [`DiskWorld`], [`run_file`], [`Checkpoint`]s |
//! | `cli` (default) | the program, with all of them |
//!
//! A feature adds names and never changes results.
#![deny(missing_docs)]

// The project's program, tests and benches use the rooms themselves; other users have the names below.
#[doc(hidden)]
pub mod check;
#[doc(hidden)]
pub mod circuit;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod diag;
#[doc(hidden)]
pub mod evolve;
#[doc(hidden)]
pub mod model;
#[doc(hidden)]
pub mod report;
#[doc(hidden)]
pub mod session;
#[doc(hidden)]
pub mod sim;
#[doc(hidden)]
pub mod source;
#[doc(hidden)]
pub mod store;
#[doc(hidden)]
pub mod swarm;
#[doc(hidden)]
pub mod syntax;

/// ```
/// use nbc::{CompileOptions, Effort, MappingObjective};
/// let fast = CompileOptions { objective: MappingObjective::Delay, effort: Effort::High, ..CompileOptions::default() };
/// assert_eq!(fast.runs, "out");
/// ```
pub use circuit::{Effort, MappingObjective};

/// ```
/// use nbc::{MemoryWorld, Session, Severity};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = b }");
/// let fault: &nbc::Diagnostic = &session.open("a.nb").unwrap_err().list[0];
/// assert_eq!((fault.code.word(), fault.severity), ("unknown", Severity::Error));
/// ```
pub use diag::{Diagnostic, Severity};

/// ```
/// use nbc::{MemoryWorld, Session};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = b }");
/// let found: nbc::Diagnostics = session.open("a.nb").unwrap_err();
/// assert!(found.to_string().starts_with("a.nb:1:27: error[unknown]"), "{found}");
/// ```
pub use diag::Diagnostics;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("run.nb", 1, "evolution mine { from: gates }");
/// let checked = session.open("run.nb")?;
/// let mut search = nbc::Search::new(checked.program.evolution("mine").unwrap(), 1);
/// assert!(!search.ask().is_empty());
/// let archive: &nbc::Archive = search.archive();
/// let elites: Vec<&nbc::Elite> = archive.elites().collect();
/// assert!(elites.is_empty());
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use evolve::{Archive, Elite, Search};

/// ```
/// use std::sync::Arc;
/// use nbc::{Body, Material, Palette};
/// let paper: Arc<Palette> = Palette::paper();
/// let muscle: &Material = paper.material(3).unwrap();
/// assert_eq!(muscle.name, "muscle");
/// let body = Body::parse(&["343", "563"], &paper).unwrap();
/// assert_eq!((body.width(), body.height()), (3, 2));
/// ```
pub use model::{Body, Material, Palette};

/// ```
/// let session = nbc::Session::new(nbc::MemoryWorld::default());
/// let library: &nbc::Library = session.shipped();
/// let robot: &nbc::Robot = &library.robots[0];
/// let character: &nbc::Character = &robot.character;
/// assert!(character.clock >= 1);
/// ```
pub use model::{Character, Library, Robot};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("run.nb", 1, "evolution mine { from: gates, generations: 2 }");
/// let checked = session.open("run.nb")?;
/// let evolution: &nbc::Evolution = checked.program.evolution("mine").unwrap();
/// assert_eq!(evolution.generations, 2);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use model::Evolution;

/// ```
/// use nbc::{Body, Fault, Palette, Pattern, Schedule, Setting, Simulator, Trajectory, Trial};
/// let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
/// let trial = Trial { body, schedule: Schedule::constant(Pattern::PAIRS[0], 2) };
/// let trajectory: &Trajectory = &Simulator::default().run_trials(&Setting::default(), &[trial])[0];
/// let fault: Option<Fault> = trajectory.fault;
/// assert_eq!((trajectory.com_x.len(), fault), (3, None));
/// ```
pub use model::{Fault, Pattern, Schedule, Setting, Trajectory, Trial};

/// ```
/// use nbc::{Checked, MemoryWorld, Session};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// let checked: std::sync::Arc<Checked> = session.checked("a.nb");
/// assert!(checked.diagnostics.is_empty() && checked.program.circuit("f").is_some());
/// ```
pub use session::Checked;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// # let checked = session.open("a.nb")?;
/// let last = checked.circuit(&nbc::Choice::default())?;
/// assert_eq!(last.to_string(), "f");
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use session::Choice;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// # let checked = session.open("a.nb")?;
/// let compiled: nbc::Compiled = session.compile(&checked, &"f".into(), &nbc::CompileOptions::default())?;
/// assert_eq!(compiled.assembly.members.len(), 1);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use session::{CompileOptions, Compiled};

/// ```
/// struct Until(u64);
/// impl nbc::Observer for Until {
///     fn progress(&mut self, done: u64, all: u64) {
///         println!("{done} of {all}");
///         self.0 -= 1;
///     }
///     fn is_cancelled(&self) -> bool {
///         self.0 == 0
///     }
/// }
/// ```
pub use session::Observer;

/// ```
/// use nbc::{MemoryWorld, Session};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// assert!(session.open("a.nb").is_ok());
/// session.update("a.nb", 2, "circuit f(a) -> (q) { q = not }");
/// assert!(session.open("a.nb").is_err());
/// ```
pub use session::Session;

/// ```
/// use nbc::{Level, RowVerdict, TestOptions, TestRun};
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }\ntest f {\n    a | q\n    0 | 1\n}");
/// let checked = session.open("a.nb")?;
/// let options = TestOptions { level: Some(Level::Logic), ..TestOptions::default() };
/// let runs: Vec<TestRun> = session.test(&checked, &checked.program.tests[0], &options, &mut ())?;
/// let row: &RowVerdict = &runs[0].verdict.rows[0];
/// assert!(row.passed);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use session::{TestOptions, TestRun};

/// ```no_run
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # let checked = session.open("a.nb")?;
/// let simulation = &checked.program.simulations[0];
/// let mut observe = |done: u64, all: u64| println!("{done} of {all}");
/// let options = nbc::CompileOptions::default();
/// let run: nbc::SimulationRun = session.simulate(&checked, simulation, &options, &mut observe)?;
/// println!("{:?}", run.result.rows);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use session::SimulationRun;

/// ```no_run
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// let report: nbc::RunReport = session.run("a.nb", &nbc::CompileOptions::default(), &mut ())?;
/// report.assert_passed();
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use session::RunReport;

/// ```no_run
/// nbc::run_file("circuits/latch.nb", &nbc::CompileOptions::default())?.assert_passed();
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
#[cfg(feature = "disk")]
pub use session::run_file;

/// ```
/// let session = nbc::Session::new(nbc::MemoryWorld::default()).with_simulator(nbc::Simulator::default());
/// ```
pub use sim::Simulator;

/// ```
/// use nbc::{MemoryWorld, OverlayWorld, SourceWorld};
/// let mut below = MemoryWorld::default();
/// below.insert("a.nb", "circuit f(a) -> (q) { q = a }");
/// let mut world = OverlayWorld::new(below);
/// world.insert("a.nb", "circuit f(a) -> (q) { q = not a }");
/// assert!(world.read("a.nb").unwrap().contains("not"));
/// ```
pub use source::{MemoryWorld, OverlayWorld, SourceWorld};

/// ```
/// let mut session = nbc::Session::new(nbc::DiskWorld);
/// assert!(session.open("circuits/latch.nb").is_ok());
/// ```
#[cfg(feature = "disk")]
pub use store::DiskWorld;

/// ```no_run
/// let bytes = std::fs::read("out/gates/seed-1/checkpoint.json").unwrap();
/// let checkpoint = nbc::Checkpoint::read("checkpoint.json", &bytes).unwrap();
/// println!("{} env steps", checkpoint.env_steps);
/// ```
#[cfg(feature = "disk")]
pub use store::Checkpoint;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// let checked = session.open("a.nb")?;
/// let compiled = session.compile(&checked, &"f".into(), &nbc::CompileOptions::default())?;
/// let mut swarm: nbc::LiveSwarm = session.swarm(&compiled);
/// for _ in 0..compiled.timing.hold + 3 {
///     swarm.step(&[true]);
/// }
/// assert_eq!(swarm.step(&[true]).outputs, [false]);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use swarm::LiveSwarm;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("run.nb", 1, "evolution mine { from: gates, box: 3 x 2, batch: 2, generations: 2 }");
/// let checked = session.open("run.nb")?;
/// let mut search = nbc::Search::new(checked.program.evolution("mine").unwrap(), 1);
/// while !search.is_done() {
///     nbc::evolve_generation(&mut search);
/// }
/// assert_eq!(search.generation(), 2);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use swarm::evolve_generation;

/// ```
/// use nbc::{Level, TestOptions};
/// let in_physics = TestOptions { level: Some(Level::Physics), ..TestOptions::default() };
/// ```
pub use swarm::{Level, RowVerdict};
