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
//! # From source to swarm
//!
//! A [`Session`] reads sources from a [`SourceWorld`], such as a [`MemoryWorld`]. Everything that can be wrong with a
//! source is [`Diagnostics`].
//!
//! ```
//! let mut session = nbc::Session::new(nbc::MemoryWorld::default());
//! session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
//! let checked = session.open("a.nb")?;
//! let compiled = checked.compile(&"f".into(), &nbc::CompileOptions::default())?;
//! let mut swarm = session.swarm(&compiled);
//! for _ in 0..compiled.timing.hold + 3 {
//!     swarm.step(&[true]).unwrap();
//! }
//! assert_eq!(swarm.step(&[true]).unwrap().outputs, [false]);
//! # Ok::<(), nbc::Diagnostics>(())
//! ```
//!
//! # Tests and proofs
//!
//! [`Session::test`] runs a test, [`Checked::prove`] decides the properties of a circuit for all its steps. A refuted
//! property has a test that shows it.
//!
//! ```
//! # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
//! session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }\nprove f {\n    never a and q\n    never q\n}");
//! let checked = session.open("a.nb")?;
//! let (claim, budget) = (&checked.program.claims[0], nbc::SearchBudget::default());
//! let mut search = checked.prove(claim, budget, nbc::CancelFlag::default())?;
//! while search.advance(&mut ()) {}
//! let decided = search.finish();
//! assert_eq!([0, 1].map(|property| decided.properties[property].verdict), ["proved", "refuted"]);
//! let (_, test) = decided.refuted().next().unwrap();
//! assert!(session.test(&checked, test, &nbc::TestOptions::default(), &mut ())?[0].verdict.passed);
//! # Ok::<(), nbc::Diagnostics>(())
//! ```
//!
//! [`Yields`] are tests in samples of worlds, whose runs can be made on any threads:
//!
//! ```
//! # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
//! session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }\ntest f {\n    a | q\n    0 | 1\n}");
//! let checked = session.open("a.nb")?;
//! let cases = checked.cases(&checked.program.tests[0], &nbc::TestOptions::default())?;
//! let yields = nbc::Yields::of(&cases, &["friction=10%".parse().unwrap()], &[1.0], 2, 1);
//! let mut tally = yields.tally();
//! let results = yields.runs().into_iter().map(|run| session.run_in_world(&yields, run, &mut ()).unwrap());
//! let found: Vec<nbc::Robustness> = results.filter_map(|result| tally.tell(result)).collect();
//! assert_eq!(found[0].passed.attempts, 2);
//! # Ok::<(), nbc::Diagnostics>(())
//! ```
//!
//! # Physics
//!
//! A [`Simulator`] runs robots without a circuit.
//!
//! ```
//! use nbc::{Body, Palette, Pattern, Schedule, Setting, Simulator, Trial};
//! let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
//! let trial = Trial { body, schedule: Schedule::constant(Pattern::PAIRS[0], 2) };
//! let trajectory = &Simulator::default().run_trials(&Setting::default(), &[trial])[0];
//! assert_eq!((trajectory.com_x.len(), trajectory.fault), (3, None));
//! ```
//!
//! [`Scenes`] are Evolution Gym's worlds: robots that are driven from outside, on terrain and among objects
//! (docs/physics.md 16).
//!
//! ```
//! use nbc::{Grid, Scene, SceneObject, Scenes};
//! let ground = SceneObject { grid: Grid::structure(10, 1, &[5; 10]), at: [0, 0] };
//! let robot = SceneObject { grid: Grid::structure(2, 2, &[3, 3, 4, 4]), at: [4, 1] };
//! let mut scenes = Scenes::new(vec![Scene::new(&[robot, ground], &nbc::Constants::default())]);
//! scenes.set_targets(0, &[1.6, 1.6, 0.6, 0.6]);
//! scenes.advance(10);
//! assert_eq!((scenes.clock(0), scenes.fault(0)), (10, None));
//! ```
//!
//! # Evolution
//!
//! A [`Search`] proposes bodies and takes their scores. An [`EvolutionRun`] also makes tasks, which an [`Executor`]
//! does anywhere.
//!
//! ```
//! # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
//! session.update("run.nb", 1, "evolution mine { from: gates, box: 3 x 2, batch: 2, generations: 2 }");
//! let checked = session.open("run.nb")?;
//! use nbc::{EvolutionRun, Executor, LocalExecutor};
//! let mut run = EvolutionRun::new(checked.program.evolution("mine").unwrap(), 1);
//! let candidates = run.search().ask();
//! let results = LocalExecutor::default().perform(0, &run.tasks(&candidates), &|| ()).unwrap();
//! let line = run.tell(&candidates, results);
//! assert_eq!((line.generation, line.work), (1, run.work()));
//! # Ok::<(), nbc::Diagnostics>(())
//! ```
//!
//! A [`RobotRequest`] measures the best bodies of a run, or one that somebody wrote.
//!
//! # Circuits of other tools, and of rows
//!
//! ```
//! # #[cfg(feature = "disk")] {
//! use nbc::{CircuitFile, CircuitFormat, Synthesis, SynthesisOptions, TopModule};
//! let top = TopModule::default();
//! let path = std::path::Path::new("tests/benchmarks/c17.aig");
//! let read = nbc::read_circuit(&CircuitFile { path, others: &[], clock: None, top: &top })?;
//! let cells = nbc::cell_library(&["nand".to_owned(), "not".to_owned()])?;
//! let made = Synthesis::of(&read.design, &SynthesisOptions::onto(cells))?;
//! assert_eq!(made.cells(), 6);
//! assert!(nbc::encode_circuit(&made.result, CircuitFormat::Blif)?.starts_with(b".model"));
//!
//! use nbc::{LearnOptions, Learning, LearningReport, LearningRequest, Sources};
//! let mut sources = Sources::default();
//! let rows = sources.add("votes.csv", "votes,q\n0,0\n1,0\n2,0\n3,1\n4,0\n5,1\n6,1\n7,1\n");
//! let options = LearnOptions { hold_out: 0.0, ..LearnOptions::default() };
//! let request = LearningRequest { circuit: "majority", rows: sources.file(rows), outputs: &[], options };
//! let mut learning = Learning::new(&request).unwrap();
//! while learning.advance() {}
//! let report = LearningReport::of(&learning.finish(), 0.1);
//! assert!(report.text().contains("training: 100.00 % (8 of 8 rows)"));
//! # }
//! # Ok::<(), nbc::Diagnostics>(())
//! ```
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | none | source to swarm, circuits, simulation, search |
//! | `parallel` | simulation on all cores |
//! | `pictures` | drawings as pixels, films |
//! | `disk` | [`DiskWorld`], [`run_file`], [`Checkpoint`]s, circuits of other tools and of rows |
//! | `gpu` (default) | simulation on graphics cards and other OpenCL devices |
//! | `cli` | the program, with threads, pictures and files |
//! | `play` (default) | the program's live page |
//! | `cluster` | the program's work on several machines |
//! | `program` | `program`, the program as a function |
//!
//! A feature adds names and never changes results.
#![deny(missing_docs)]

#[cfg(feature = "program")]
mod cli;

/// Runs the program in this process and returns its exit status. The first argument is the name of the program.
///
/// Like a process of its own, it watches signals, starts threads for the whole process, and uses standard input and
/// output.
///
/// ```
/// assert_eq!(nbc::program(["nbc", "check", "circuits/latch.nb"].map(Into::into)), 0);
/// ```
#[cfg(feature = "program")]
pub fn program(arguments: impl IntoIterator<Item = std::ffi::OsString>) -> u8 {
    cli::run(arguments).code()
}

// From source to swarm.
pub use nbc_base::diag::suggest::nearest;
pub use nbc_base::diag::{Diagnostic, Diagnostics, Finding, Severity};
pub use nbc_base::source::{MemoryWorld, OverlayWorld, SourceWorld};
pub use nbc_circuit::{CancelFlag, Effort, MappingObjective, Netlist, Node};
#[cfg(feature = "disk")]
pub use nbc_session::store::{DiskWorld, GuardedWorld};
pub use nbc_session::{Checked, Choice, CompileOptions, Compiled, Observer, Session};
pub use nbc_swarm::{LiveSwarm, Member, RobotFault, Room};

// Tests, proofs and worlds.
pub use nbc_base::model::{CircuitTest, Claim, Variation};
pub use nbc_circuit::properties::SearchBudget;
#[cfg(feature = "disk")]
pub use nbc_session::run_file;
pub use nbc_session::{ClaimSearch, DecidedClaim, DecidedProperty};
pub use nbc_session::{Experiment, TestCase, WorldResult, WorldRun, YieldTally, Yields};
pub use nbc_session::{Hardened, Hardening, HardeningStep};
pub use nbc_session::{RunList, RunReport, RunningTest, SimulationRun, TestOptions, TestRun};
pub use nbc_swarm::{Level, Robustness, RowVerdict, TestVerdict};

// Physics.
pub use nbc_base::model::{Body, Material, Palette};
pub use nbc_base::model::{CYCLE_STEPS, Image, ImageSize, Pattern, Schedule, Spell};
pub use nbc_base::model::{Fault, FaultKind, Setting, SettingError, Trajectory, Trial};
pub use nbc_session::read_schedule;
pub use nbc_sim::{Constants, Grid, ObjectCenter, Scene, SceneObject, SceneState, Scenes, Sight, State};
pub use nbc_sim::{Flock, Monitor, Simulator, Snapshot};

// Evolution and robots.
pub use nbc_base::model::{Axis, Behavior, Character, Count, Displacements, Evolution, Library, Robot};
#[cfg(feature = "disk")]
pub use nbc_session::report::Answer;
pub use nbc_session::report::EvolutionLine;
#[cfg(feature = "disk")]
pub use nbc_session::store::{Checkpoint, print_robot, write_file};
pub use nbc_session::{EvolutionRun, Reach, Verified};
#[cfg(feature = "disk")]
pub use nbc_session::{OwnBody, RobotRequest, behavior};
pub use nbc_swarm::evolve::{Archive, Candidate, CandidateOutcome, Descriptor, Elite, NicheKey, Scores, Search};
pub use nbc_swarm::evolve::{Undeveloped, validate};
pub use nbc_swarm::{Executor, LocalExecutor, Task, TaskResult, Work, evaluate, evaluate_bodies, evolve_generation};
#[cfg(feature = "disk")]
pub use nbc_swarm::{Selected, Selection};

// Circuits of other tools, and circuits that are learned.
#[cfg(feature = "disk")]
pub use {
    nbc_base::source::Sources,
    nbc_circuit::CellLibrary,
    nbc_circuit::formats::CircuitFormat,
    nbc_session::store::{CircuitFile, CircuitRead, ParameterValue, TopModule, encode_circuit, read_circuit},
    nbc_session::store::{read_rows, with_comment},
    nbc_session::{LearnOptions, Learning, LearningReport, LearningRequest},
    nbc_session::{Synthesis, SynthesisOptions, SynthesisReport, cell_library, named_functions, robot_cells},
};

// Pictures and texts.
pub use nbc_session::report::{Scheme, Svg, SwarmTiming, describe_robustness, draw_portrait, draw_swarm};
