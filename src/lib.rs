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

/// ```
/// use nbc::{CancelFlag, CompileOptions};
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// # let checked = session.open("a.nb")?;
/// let cancel = CancelFlag::default();
/// let options = CompileOptions { cancel: cancel.clone(), ..CompileOptions::default() };
/// std::thread::spawn(move || cancel.raise());
/// let compiled = session.compile(&checked, &"f".into(), &options)?;
/// assert_eq!(compiled.assembly.members.len(), 1);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_circuit::CancelFlag;

/// ```
/// use nbc::{CompileOptions, Effort, MappingObjective};
/// let fast = CompileOptions { objective: MappingObjective::Delay, effort: Effort::Fast, ..CompileOptions::default() };
/// assert_eq!(fast.runs, "out");
/// ```
pub use nbc_circuit::{Effort, MappingObjective};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// # let checked = session.open("a.nb")?;
/// let compiled = session.compile(&checked, &"f".into(), &nbc::CompileOptions::default())?;
/// let netlist: &nbc::Netlist = &compiled.mapping.netlist;
/// let cells = netlist.ids().filter(|&id| matches!(netlist.node(id), nbc::Node::Cell(_)));
/// assert_eq!(cells.count(), 1);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_circuit::{Netlist, Node};

/// ```
/// use nbc::{MemoryWorld, Session, Severity};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = b }");
/// let fault: &nbc::Diagnostic = &session.open("a.nb").unwrap_err().list[0];
/// assert_eq!((fault.code.word(), fault.severity), ("unknown", Severity::Error));
/// ```
pub use nbc_base::diag::{Diagnostic, Severity};

/// ```
/// use nbc::{MemoryWorld, Session};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = b }");
/// let found: nbc::Diagnostics = session.open("a.nb").unwrap_err();
/// assert!(found.to_string().starts_with("a.nb:1:27: error[unknown]"), "{found}");
/// ```
pub use nbc_base::diag::Diagnostics;

/// ```
/// assert_eq!(nbc::nearest("nnad", ["and", "nand", "or"]), Some("nand"));
/// assert_eq!(nbc::nearest("register", ["and", "nand", "or"]), None);
/// ```
pub use nbc_base::diag::suggest::nearest;

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
pub use nbc_swarm::evolve::{Archive, Elite, Search};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("run.nb", 1, "evolution mine { from: gates, box: 3 x 2 }");
/// # let checked = session.open("run.nb")?;
/// use nbc::{Candidate, CandidateOutcome, Displacements, Scores};
/// let mut search = nbc::Search::new(checked.program.evolution("mine").unwrap(), 1);
/// let candidates: Vec<Candidate> = search.ask();
/// let displacement = Displacements::try_from(vec![1.0, 1.0, 1.0, -1.0]).unwrap();
/// let scores = Scores { fitness: [4.0, 1.0], behavior: displacement.behavior(), displacement };
/// search.tell(&candidates, &vec![CandidateOutcome::Measured(scores); candidates.len()]);
/// assert!(!search.archive().is_empty());
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_swarm::evolve::{Candidate, CandidateOutcome, Scores};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("run.nb", 1, "evolution mine { from: gates }");
/// # let checked = session.open("run.nb")?;
/// let descriptor = nbc::Descriptor::new(checked.program.evolution("mine").unwrap());
/// let body = nbc::Body::parse(&["33333", "55555", "00000", "00000", "00000"], &nbc::Palette::paper()).unwrap();
/// let niche: nbc::NicheKey = descriptor.niche(&body, "RRRL".parse().unwrap());
/// assert_eq!(niche.0, [1, 0, 0, 7]);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_swarm::evolve::{Descriptor, NicheKey};

/// ```
/// let body = nbc::Body::parse(&["33"], &nbc::Palette::paper()).unwrap();
/// let why: nbc::Undeveloped = nbc::validate(&body).unwrap_err();
/// assert_eq!(why.to_string(), "the body has 2 actuators, expected at least 3");
/// ```
pub use nbc_swarm::evolve::{Undeveloped, validate};

/// ```
/// use std::sync::Arc;
/// use nbc::{Body, Material, Palette};
/// let paper: Arc<Palette> = Palette::paper();
/// let muscle: &Material = paper.material(3).unwrap();
/// assert_eq!(muscle.name, "muscle");
/// let body = Body::parse(&["343", "563"], &paper).unwrap();
/// assert_eq!((body.width(), body.height()), (3, 2));
/// ```
pub use nbc_base::model::{Body, Material, Palette};

/// ```
/// let session = nbc::Session::new(nbc::MemoryWorld::default());
/// let library: &nbc::Library = session.shipped();
/// let robot: &nbc::Robot = &library.robots[0];
/// let character: &nbc::Character = &robot.character;
/// assert!(character.clock >= 1);
/// ```
pub use nbc_base::model::{Character, Library, Robot};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("run.nb", 1, "evolution mine { from: gates, generations: 2 }");
/// let checked = session.open("run.nb")?;
/// let evolution: &nbc::Evolution = checked.program.evolution("mine").unwrap();
/// assert_eq!(evolution.generations, 2);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_base::model::Evolution;

/// ```
/// use nbc::{Body, Fault, Palette, Pattern, Schedule, Setting, Simulator, Trajectory, Trial};
/// let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
/// let trial = Trial { body, schedule: Schedule::constant(Pattern::PAIRS[0], 2) };
/// let trajectory: &Trajectory = &Simulator::default().run_trials(&Setting::default(), &[trial])[0];
/// let fault: Option<Fault> = trajectory.fault;
/// assert_eq!((trajectory.com_x.len(), fault), (3, None));
/// ```
pub use nbc_base::model::{Fault, Pattern, Schedule, Setting, Trajectory, Trial};

/// ```
/// assert_eq!(nbc::CYCLE_STEPS, 84);
/// ```
pub use nbc_base::model::CYCLE_STEPS;

/// ```
/// use nbc::{Axis, Behavior, Count, Displacements};
/// let nand: Behavior = "RRRL".parse().unwrap();
/// assert_eq!(nand.function().name(), "nand");
/// assert_eq!(Displacements::zero(2).behavior().to_string(), "LLLL");
/// let axes = [Axis::Count { of: Count::Voxels, bins: 4 }, Axis::Behavior];
/// assert_eq!(axes.len(), 2);
/// ```
pub use nbc_base::model::{Axis, Behavior, Count, Displacements};

/// ```
/// use nbc::{Pattern, Schedule, Spell};
/// let spells = vec![Spell::of(Pattern::PAIRS[1], 840)];
/// assert_eq!(nbc::read_schedule("schedule", "01*10", 2)?, Schedule { spells });
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_base::model::Spell;

/// ```
/// use std::sync::Arc;
///
/// use nbc::{Image, ImageSize, Pattern, Spell};
/// let image = Image::new(ImageSize::new(1, 2), vec![0.25, 1.0]).unwrap();
/// let spell = Spell { image: Some(Arc::new(image)), ..Spell::of(Pattern::default(), 250) };
/// assert_eq!(spell.value_over([0, 1], [1, 2]), 1.0);
/// ```
pub use nbc_base::model::{Image, ImageSize};

/// ```
/// use nbc::{Body, Palette, Setting, SettingError};
/// let body = Body::parse(&["343"], &Palette::paper()).unwrap();
/// let narrow = Setting { world_width: 2, ..Setting::default() };
/// assert_eq!(narrow.check(&body), Err(SettingError::NarrowWorld { width: 2, columns: 3 }));
/// ```
pub use nbc_base::model::SettingError;

/// ```
/// use nbc::{Body, Palette, Scheme, Svg};
/// let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
/// let picture: Svg = nbc::draw_portrait("a body", &body, Scheme::Safe);
/// assert!(picture.finish().starts_with("<svg"));
/// ```
pub use nbc_session::report::{Scheme, Svg, draw_portrait};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// # let checked = session.open("a.nb")?;
/// let compiled = session.compile(&checked, &"f".into(), &nbc::CompileOptions::default())?;
/// let timing: nbc::SwarmTiming = compiled.swarm_timing();
/// assert_eq!(timing.robots[0].slack, 0);
/// let mut swarm = session.swarm(&compiled);
/// swarm.step(&[true]).unwrap();
/// assert!(nbc::draw_swarm(swarm.trace()).finish().starts_with("<svg"));
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_session::report::{SwarmTiming, draw_swarm};

/// ```
/// use nbc::{Checked, MemoryWorld, Session};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// let checked: std::sync::Arc<Checked> = session.checked("a.nb");
/// assert!(checked.diagnostics.is_empty() && checked.program.circuit("f").is_some());
/// ```
pub use nbc_session::Checked;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// # let checked = session.open("a.nb")?;
/// let last = checked.circuit(&nbc::Choice::default())?;
/// assert_eq!(last.to_string(), "f");
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_session::Choice;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// # let checked = session.open("a.nb")?;
/// let compiled: nbc::Compiled = session.compile(&checked, &"f".into(), &nbc::CompileOptions::default())?;
/// let member: &nbc::Member = &compiled.assembly.members[0];
/// assert_eq!(member.robot.function().name(), "not");
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use {
    nbc_session::{CompileOptions, Compiled},
    nbc_swarm::Member,
};

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
pub use nbc_session::Observer;

/// ```
/// use nbc::{MemoryWorld, Session};
/// let mut session = Session::new(MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// assert!(session.open("a.nb").is_ok());
/// session.update("a.nb", 2, "circuit f(a) -> (q) { q = not }");
/// assert!(session.open("a.nb").is_err());
/// ```
pub use nbc_session::Session;

/// ```
/// use nbc::{Level, RowVerdict, RunningTest, TestOptions, TestRun};
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }\ntest f {\n    a | q\n    0 | 1\n}");
/// let checked = session.open("a.nb")?;
/// let options = TestOptions { level: Some(Level::Logic), ..TestOptions::default() };
/// let mut running: RunningTest = session.begin_test(&checked, &checked.program.tests[0], &options)?;
/// while running.advance(&mut ()) {}
/// let runs: Vec<TestRun> = running.into_runs();
/// let row: &RowVerdict = &runs[0].verdict.rows[0];
/// assert!(row.passed);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use {
    nbc_base::model::CircuitTest,
    nbc_session::{RunningTest, TestOptions, TestRun},
};

/// Properties of all steps of a circuit, decided. A door ends the search with the flag, for example after some time.
///
/// ```
/// use nbc::{CancelFlag, Claim, ClaimReport, ClaimSearch, DecidedClaim, PropertyReport, SearchBudget};
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }\nprove f {\n    never a and q\n    never q\n}");
/// let checked = session.open("a.nb")?;
/// let claim: &Claim = &checked.program.claims[0];
/// let budget = SearchBudget { work: 100_000, ..SearchBudget::default() };
/// let mut search: ClaimSearch = session.prove(&checked, claim, budget, CancelFlag::default())?;
/// while search.advance(&mut ()) {}
/// let decided: DecidedClaim = search.finish();
/// let report = ClaimReport::of(&decided);
/// let found: &[PropertyReport] = report.properties();
/// assert_eq!((found[0].verdict, found[1].verdict), ("proved", "refuted"));
/// let (property, test) = decided.refuted().next().unwrap();
/// assert!(property == 1 && session.test(&checked, test, &nbc::TestOptions::default(), &mut ())?[0].verdict.passed);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use {
    nbc_base::model::Claim,
    nbc_circuit::properties::SearchBudget,
    nbc_session::{ClaimReport, ClaimSearch, DecidedClaim, PropertyReport},
};

/// Tests in samples of worlds. A door makes the runs on its threads; here they follow each other.
///
/// ```
/// use nbc::{Experiment, Level, Robustness, TestCase, TestOptions, WorldResult, WorldRun, YieldTally, Yields};
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }\ntest f {\n    a | q\n    0 | 1\n}");
/// let checked = session.open("a.nb")?;
/// let options = TestOptions { level: Some(Level::Physics), ..TestOptions::default() };
/// let cases: Vec<TestCase> = session.cases(&checked, &checked.program.tests[0], &options)?;
/// let variation: nbc::Variation = "friction=10%".parse().unwrap();
/// let yields = Yields::of(&cases, &[variation], &[1.0], 2, 1);
/// let experiment: &Experiment = &yields.experiments[0];
/// assert_eq!(experiment.scale, 1.0);
/// let mut tally: YieldTally = yields.tally();
/// let runs: Vec<WorldRun> = yields.runs();
/// let run = |run| -> WorldResult { session.run_in_world(&yields, run, &mut ()).unwrap() };
/// let found: Vec<Robustness> = runs.into_iter().filter_map(|one| tally.tell(run(one))).collect();
/// assert_eq!(found[0].passed.attempts, 2);
/// assert!(nbc::describe_robustness(&found[0]).starts_with("f"));
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use {
    nbc_base::model::Variation,
    nbc_session::report::describe_robustness,
    nbc_session::{Experiment, TestCase, WorldResult, WorldRun, YieldTally, Yields},
    nbc_swarm::Robustness,
};

/// ```no_run
/// use nbc::{Hardened, Hardening, HardeningStep};
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # let checked = session.open("a.nb")?;
/// # fn run(yields: &nbc::Yields) -> Result<Vec<nbc::Robustness>, nbc::Diagnostics> { Ok(Vec::new()) }
/// let hardening = Hardening { variation: "20%".parse().unwrap(), worlds: 40, seed: 1, least_yield: 0.95 };
/// let mut tell = |step: &HardeningStep| eprintln!("{step}");
/// let options = nbc::CompileOptions::default();
/// let found: Option<Hardened> = session.harden(&checked, &"f".into(), &options, hardening, &mut run, &mut tell)?;
/// println!("{}", found.unwrap());
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_session::{Hardened, Hardening, HardeningStep};

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
pub use nbc_session::SimulationRun;

/// ```
/// let schedule: nbc::Schedule = nbc::read_schedule("schedule", "00*10 01*56steps", 2)?;
/// assert_eq!(schedule.steps(), 896);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_session::read_schedule;

/// ```no_run
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// let report: nbc::RunReport = session.run("a.nb", &nbc::CompileOptions::default(), &mut ())?;
/// report.assert_passed();
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_session::{RunList, RunReport};

/// ```no_run
/// nbc::run_file("circuits/latch.nb", &nbc::CompileOptions::default())?.assert_passed();
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
#[cfg(feature = "disk")]
pub use nbc_session::run_file;

/// ```
/// let session = nbc::Session::new(nbc::MemoryWorld::default()).with_simulator(nbc::Simulator::default());
/// ```
pub use nbc_sim::Simulator;

/// ```
/// use std::sync::Arc;
/// use nbc::{Body, FaultKind, Monitor, Palette, Pattern, Schedule, Setting, Simulator, Trial};
/// let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
/// let trial = Trial { body, schedule: Schedule::constant(Pattern::PAIRS[0], 84) };
/// let monitor = Arc::new(Monitor::default());
/// let simulator = Simulator::monitored(monitor.clone());
/// simulator.run_trials(&Setting::default(), &[trial.clone()]);
/// assert_eq!(monitor.env_steps(), 84);
/// monitor.stop();
/// let fault = simulator.run_trials(&Setting::default(), &[trial])[0].fault.unwrap();
/// assert_eq!((fault.env_step, fault.kind), (1, FaultKind::Stopped));
/// ```
pub use {nbc_base::model::FaultKind, nbc_sim::Monitor};

/// ```
/// use nbc::{Body, Flock, Palette, Pattern, Setting, Simulator, Snapshot};
/// let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
/// let mut flock: Box<dyn Flock> = Simulator::default().flock(&Setting::default(), &[body]);
/// let start: Snapshot = flock.snapshot(0);
/// flock.advance(&[Pattern::PAIRS[1]], 84);
/// assert_eq!(flock.clock(0), 84);
/// flock.restore(0, &start);
/// assert_eq!(flock.center(0), start.center);
/// ```
pub use nbc_sim::{Flock, Snapshot};

/// Evolution Gym's worlds: robots that are driven from outside, on terrain and among objects (docs/physics.md 16).
///
/// ```
/// use nbc::{Grid, Scene, SceneObject, Scenes};
/// let object = |grid, at| SceneObject { grid, at };
/// let ground = object(Grid::structure(10, 1, &[5; 10]), [0, 0]);
/// let robot = object(Grid::structure(2, 2, &[3, 3, 4, 4]), [4, 1]);
/// let scene = Scene::new(&[robot, ground], &nbc::Constants::default());
/// let mut scenes = Scenes::new(vec![scene]);
/// scenes.set_targets(0, &[1.6, 1.6, 0.6, 0.6]);
/// scenes.advance(10);
/// assert_eq!((scenes.clock(0), scenes.fault(0)), (10, None));
/// assert_eq!(scenes.positions(0, 0).len(), 9);
/// let before = scenes.state(0);
/// scenes.reset(0);
/// scenes.restore(0, &before);
/// ```
pub use nbc_sim::{Constants, Grid, ObjectCenter, Scene, SceneObject, SceneState, Scenes, Sight, State};

/// ```
/// use nbc::{MemoryWorld, OverlayWorld, SourceWorld};
/// let mut below = MemoryWorld::default();
/// below.insert("a.nb", "circuit f(a) -> (q) { q = a }");
/// let mut world = OverlayWorld::new(below);
/// world.insert("a.nb", "circuit f(a) -> (q) { q = not a }");
/// assert!(world.read("a.nb").unwrap().contains("not"));
/// ```
pub use nbc_base::source::{MemoryWorld, OverlayWorld, SourceWorld};

/// ```
/// let mut session = nbc::Session::new(nbc::DiskWorld);
/// assert!(session.open("circuits/latch.nb").is_ok());
/// ```
#[cfg(feature = "disk")]
pub use nbc_session::store::DiskWorld;

/// ```
/// let stop = nbc::CancelFlag::default();
/// let mut session = nbc::Session::new(nbc::GuardedWorld::until(nbc::DiskWorld, stop.clone()));
/// assert!(session.open("circuits/latch.nb").is_ok());
/// stop.raise();
/// ```
#[cfg(feature = "disk")]
pub use nbc_session::store::GuardedWorld;

/// A circuit of another tool, mapped onto cells and proved.
///
/// ```
/// use std::path::Path;
/// use nbc::{CellLibrary, CircuitFile, CircuitFormat, CircuitRead, Synthesis, SynthesisOptions, SynthesisReport};
/// let top = nbc::TopModule::default();
/// let file = CircuitFile { path: Path::new("tests/benchmarks/c17.aig"), others: &[], clock: None, top: &top };
/// let CircuitRead { design, origin, .. } = nbc::read_circuit(&file)?;
/// let cells: CellLibrary = nbc::cell_library(&["nand".to_owned(), "not".to_owned()])?;
/// let what_if = nbc::named_functions(&["xor".to_owned()])?;
/// let options = SynthesisOptions { what_if, ..SynthesisOptions::onto(cells) };
/// let made = Synthesis::of(&design, &options)?;
/// assert_eq!(made.cells(), 6);
/// let report = SynthesisReport::of(&made, origin, 0.1);
/// assert!(report.text().starts_with("6 cells (6 nand), 3 levels, proved"));
/// assert!(nbc::encode_circuit(&made.result, CircuitFormat::Blif)?.starts_with(b".model"));
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
#[cfg(feature = "disk")]
pub use {
    nbc_circuit::CellLibrary,
    nbc_circuit::formats::CircuitFormat,
    nbc_session::store::{CircuitFile, CircuitRead, ParameterValue, TopModule, encode_circuit, read_circuit},
    nbc_session::{Synthesis, SynthesisOptions, SynthesisReport, cell_library, named_functions, robot_cells},
};

/// A circuit that is learned from the rows of a file.
///
/// ```
/// use nbc::{CircuitFormat, LearnOptions, Learning, LearningReport, LearningRequest, Sources};
/// let mut sources = Sources::default();
/// let rows = sources.add("votes.csv", "votes,q\n0,0\n1,0\n2,0\n3,1\n4,0\n5,1\n6,1\n7,1\n");
/// let options = LearnOptions { hold_out: 0.0, ..LearnOptions::default() };
/// let request = LearningRequest { circuit: "majority", rows: sources.file(rows), outputs: &[], options };
/// let (command, mut learning) = (request.command(), Learning::new(&request).unwrap());
/// while learning.advance() {}
/// let learned = learning.finish();
/// let report = LearningReport::of(&learned, 0.1);
/// assert!(report.text().contains("training: 100.00 % (8 of 8 rows)"));
/// let program = nbc::encode_circuit(&learned.design, CircuitFormat::Nb)?;
/// let program = nbc::with_comment(program, CircuitFormat::Nb, &report.provenance(&command));
/// assert!(program.starts_with(b"//! Learned by nbc"));
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
#[cfg(feature = "disk")]
pub use {
    nbc_base::source::Sources,
    nbc_session::store::{read_rows, with_comment},
    nbc_session::{LearnOptions, Learning, LearningReport, LearningRequest},
};

/// ```no_run
/// use std::path::Path;
/// let checkpoint = nbc::Checkpoint::open(Path::new("out/gates/seed-1/checkpoint.nbc")).unwrap().unwrap();
/// println!("{} env steps", checkpoint.env_steps);
/// nbc::write_file(Path::new("out/version.txt"), checkpoint.version.as_bytes()).unwrap();
/// ```
#[cfg(feature = "disk")]
pub use nbc_session::store::{Checkpoint, write_file};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("a.nb", 1, "circuit f(a) -> (q) { q = not a }");
/// let checked = session.open("a.nb")?;
/// let compiled = session.compile(&checked, &"f".into(), &nbc::CompileOptions::default())?;
/// let mut swarm: nbc::LiveSwarm = session.swarm(&compiled);
/// for _ in 0..compiled.timing.hold + 3 {
///     swarm.step(&[true]).unwrap();
/// }
/// assert_eq!(swarm.step(&[true]).unwrap().outputs, [false]);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_swarm::LiveSwarm;

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// let text = "world stiff { stiffness: 10 }\ncircuit f(a) -> (q) { q = not a }\nswarm s { circuit: f, world: stiff }";
/// session.update("a.nb", 1, text);
/// let checked = session.open("a.nb")?;
/// let compiled = session.compile(&checked, &"f".into(), &nbc::CompileOptions::default())?;
/// let mut swarm = session.swarm(&compiled);
/// let fault: nbc::RobotFault = (0..100).find_map(|_| swarm.step(&[true]).err()).unwrap();
/// assert_eq!(fault.kind, nbc::FaultKind::Unstable);
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_swarm::RobotFault;

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
pub use nbc_swarm::evolve_generation;

/// The best robot of a behavior among the elites of a run, measured.
///
/// ```no_run
/// use std::path::Path;
/// use nbc::{Answer, Behavior, Checkpoint, LocalExecutor, OwnBody, RobotRequest, Selected, Selection};
/// let run = Checkpoint::open(Path::new("out/gates/seed-1/checkpoint.nbc")).unwrap().unwrap();
/// let selection = Selection { tries: 8, finalists: 2, max_error: 0.0, wide_margin: 0.0 };
/// let nand: Behavior = nbc::behavior("nand").unwrap();
/// let executor = LocalExecutor::new(nbc::Simulator::default());
/// for request in RobotRequest::of_runs([&run], &[nand], &selection) {
///     match request.select(&selection, &executor, 0, &|_| ()).unwrap() {
///         Selected::Robot(robot) => println!("{}", nbc::print_robot(&robot)),
///         none => println!("{}", Answer::of(nand, &none, selection.max_error)),
///     }
/// }
/// let body = nbc::Body::parse(&["343", "563"], &nbc::Palette::paper()).unwrap();
/// let own = RobotRequest::Own(Box::new(OwnBody::by_hand("mine".to_owned(), body)));
/// assert!(own.select(&selection, &executor, 0, &|_| ()).is_some());
/// ```
#[cfg(feature = "disk")]
pub use {
    nbc_session::report::Answer,
    nbc_session::store::print_robot,
    nbc_session::{OwnBody, RobotRequest, behavior},
    nbc_swarm::{Selected, Selection},
};

/// Robots measured again and compared with their files, and how far worlds may differ before they make errors.
///
/// ```no_run
/// use nbc::{LocalExecutor, Reach, Verified};
/// let robots = nbc::Session::new(nbc::MemoryWorld::default()).shipped().robots.clone();
/// let (simulator, executor) = (nbc::Simulator::default(), LocalExecutor::default());
/// assert!(Verified::of(&executor, 0, &robots[0]).unwrap().differs.is_empty());
/// let changes: nbc::Variation = "friction=10%".parse().unwrap();
/// println!("{}", Reach::of(&simulator, &robots[0], changes, 20, 1).found.radius);
/// ```
pub use nbc_session::{Reach, Verified};

/// A run of an evolution whose work is counted, with an executor that remembers the bodies it has simulated.
///
/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// session.update("run.nb", 1, "evolution mine { from: gates, box: 3 x 2, batch: 2, generations: 2 }");
/// let checked = session.open("run.nb")?;
/// use nbc::{EvolutionLine, EvolutionRun, Executor, LocalExecutor, Task, TaskResult};
/// let executor = LocalExecutor::new(nbc::Simulator::default());
/// let mut run = EvolutionRun::new(checked.program.evolution("mine").unwrap(), 1);
/// let candidates = run.ask();
/// let tasks: Vec<Task> = run.tasks(&candidates);
/// let results: Vec<TaskResult> = executor.perform(0, &tasks, &|| ()).unwrap();
/// let line: EvolutionLine = run.tell(&candidates, results);
/// assert_eq!((line.generation, line.work), (1, run.work()));
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use {
    nbc_session::EvolutionRun,
    nbc_session::report::EvolutionLine,
    nbc_swarm::{Executor, LocalExecutor, Task, TaskResult},
};

/// ```
/// # let mut session = nbc::Session::new(nbc::MemoryWorld::default());
/// # session.update("run.nb", 1, "evolution mine { from: gates, box: 3 x 2, fixed: 1 cycles }");
/// # let checked = session.open("run.nb")?;
/// use nbc::{Simulator, Work};
/// let evolution = checked.program.evolution("mine").unwrap();
/// let body = nbc::Body::parse(&["343", "563"], &nbc::Palette::paper()).unwrap();
/// let outcomes = nbc::evaluate_bodies(&Simulator::default(), evolution, vec![body]);
/// assert_eq!(outcomes.len(), 1);
/// let search = nbc::Search::new(evolution, 1);
/// let (outcomes, work): (_, Work) = nbc::evaluate(&Simulator::default(), &search, &search.ask());
/// assert_eq!((outcomes.len(), work.env_steps > 0), (17, true));
/// # Ok::<(), nbc::Diagnostics>(())
/// ```
pub use nbc_swarm::{Work, evaluate, evaluate_bodies};

/// ```
/// let session = nbc::Session::new(nbc::MemoryWorld::default()).with_poses(nbc::Room::SWARM);
/// ```
pub use nbc_swarm::Room;

/// ```
/// use nbc::{Level, TestOptions};
/// let in_physics = TestOptions { level: Some(Level::Physics), ..TestOptions::default() };
/// ```
pub use nbc_swarm::{Level, RowVerdict};
