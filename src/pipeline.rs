//! Every stage in order, from source text to verdict.

use std::path::Path;

use crate::check::{self, Checked};
use crate::circuit::logic::Logic;
use crate::circuit::timing::Delays;
use crate::circuit::{Netlist, Proof, Timing, elaborate, map, prove};
use crate::diag::{Code, Diagnostic, counted, render};
use crate::model::{CYCLE_STEPS, CircuitTest, Hold, Instance, Library, Origin, Program, Stimulation, TestRow};
use crate::report;
use crate::sim::Simulator;
use crate::source::{MemoryWorld, Sources, Span, World};
use crate::store::{self, DiskWorld};
use crate::swarm::{self, Assembly, Demand, Exposure, SwarmTrace, TestVerdict};

/// The most input bits of a test that tries all patterns.
const MAX_EXHAUSTIVE_BITS: usize = 16;

/// The cycles by which a row is held longer than its slowest path needs, so that outputs have been right over two.
const STEADY_EXTRA: u32 = 1;

/// A program with everything that was found in its text.
#[derive(Clone, Debug, Default)]
pub struct Loaded {
    /// The texts that spans point into: the file, the prelude, and what the file uses.
    pub sources: Sources,
    /// The program and what is wrong with it.
    pub checked: Checked,
}

/// A circuit on its way from source to swarm.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The netlist as written.
    pub source: Netlist,
    /// The netlist of library cells.
    pub mapped: Netlist,
    /// How the two were proved equal.
    pub proof: Proof,
    /// When each net is right.
    pub timing: Timing,
    /// The robots and their wiring.
    pub assembly: Assembly,
}

/// How a swarm's test is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Protocol {
    /// How long a row is held that does not say so itself.
    pub hold: Hold,
    /// Cycles over which an output is taken.
    pub window: u32,
}

/// A test with what came of it.
#[derive(Clone, Debug)]
pub struct TestRun {
    /// The circuit, compiled.
    pub compiled: Compiled,
    /// What the swarm did.
    pub trace: SwarmTrace,
    /// Whether it did what was asked.
    pub verdict: TestVerdict,
    /// What is legal and surely not meant.
    pub warnings: Vec<Diagnostic>,
}

/// How tests are run.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// These robots instead of those that the file asks for.
    pub library: Option<Library>,
    /// How their robots are simulated.
    pub simulator: Simulator,
}

/// Reads and checks a file. What cannot be read is a diagnostic like any other.
pub fn load(world: &dyn World, path: &str) -> Loaded {
    let mut sources = Sources::default();
    let checked = match check::open(world, path, &mut sources) {
        Ok(file) => check::check(world, &mut sources, file),
        Err(fault) => Checked { diagnostics: vec![fault], ..Checked::default() },
    };
    Loaded { sources, checked }
}

/// The program of the prelude alone.
pub fn prelude() -> Program {
    let mut sources = Sources::default();
    let nothing = sources.add("nothing", "");
    check::check(&MemoryWorld::default(), &mut sources, nothing).program
}

/// Compiles a circuit of a program without errors to a swarm of a library's robots: elaborate, map, prove, time, assemble.
///
/// # Errors
/// When the circuit cannot be built as asked for at `place`, or the library lacks a function.
///
/// # Panics
/// When the mapped netlist is not proved equal to its source, which is a fault of the compiler.
pub fn compile(
    program: &Program,
    circuit: &Instance,
    library: &Library,
    place: Span,
) -> Result<Compiled, Vec<Diagnostic>> {
    let source = elaborate(program, circuit)?;
    let cells = swarm::cells(library);
    let mapped = map(&source, &cells).map_err(|error| {
        let fault = Diagnostic::new(Code::IncompleteLibrary, error.to_string(), place, "for this circuit");
        vec![match error.help() {
            Some(help) => fault.with_help(help),
            None => fault,
        }]
    })?;
    let proof = match prove(&source, &mapped) {
        Ok(proof) => proof,
        Err(error) => panic!("the compiled circuit `{circuit}` differs from its source: {error}"),
    };
    let timing = Timing::of(&mapped, &cells, Delays::Clock);
    let assembly = swarm::assemble(&mapped, library).expect("the netlist was mapped onto this library");
    Ok(Compiled { source, mapped, proof, timing, assembly })
}

/// The protocol of a test: that of the first swarm declared for its circuit, else automatic holds and the paper's window.
pub fn protocol(program: &Program, test: &CircuitTest) -> Protocol {
    let declared = program.swarms.iter().find(|swarm| swarm.circuit == test.circuit);
    declared
        .map_or(Protocol { hold: Hold::Auto, window: 1 }, |swarm| Protocol { hold: swarm.hold, window: swarm.window })
}

/// The rows of a test. Those of a test over all inputs come from its reference, which a program without errors can be asked for.
///
/// # Errors
/// When there are too many inputs for all patterns, or the reference cannot be built.
pub fn rows(program: &Program, test: &CircuitTest) -> Result<Vec<TestRow>, Vec<Diagnostic>> {
    let reference = match &test.stimulation {
        Stimulation::Rows(rows) => return Ok(rows.clone()),
        Stimulation::All { reference } => reference,
    };
    let bits = test.input_bits().len();
    if bits > MAX_EXHAUSTIVE_BITS {
        let message =
            format!("{bits} input bits are too many to try all patterns, expected at most {MAX_EXHAUSTIVE_BITS}");
        return Err(vec![Diagnostic::new(Code::BadValue, message, test.span, "in this test")]);
    }
    let mut logic = Logic::new(&elaborate(program, reference)?);
    let row = |pattern: usize| {
        let inputs: Vec<bool> = (0..bits).rev().map(|bit| pattern >> bit & 1 == 1).collect();
        let expected = match logic.settle(&inputs) {
            Ok(outputs) => outputs.into_iter().map(Some).collect(),
            Err(_) => vec![None; test.output_bits().len()],
        };
        TestRow { inputs, expected, hold: None, span: test.span }
    };
    Ok((0..1 << bits).map(row).collect())
}

/// How long each row is held, and what it asks for. The first has the time on top in which robots find their feet.
pub fn demands(rows: &[TestRow], protocol: Protocol, timing: &Timing) -> Vec<Demand> {
    let usual = timing.hold + STEADY_EXTRA + (protocol.window - 1);
    let demand = |(i, row): (usize, &TestRow)| {
        let needed = if i == 0 { usual + swarm::START_CYCLES as u32 } else { usual };
        let hold = match protocol.hold {
            Hold::Auto => needed,
            Hold::Cycles(cycles) => cycles,
        };
        let hold = row.hold.unwrap_or(hold).max(1) as usize;
        Demand { hold, needed: needed as usize, expected: row.expected.clone() }
    };
    rows.iter().enumerate().map(demand).collect()
}

/// Runs a test in full physics, calling `observe` with the cycles done and the cycles in all after each.
///
/// # Errors
/// As [`compile`] and [`rows`], and when the robots cannot be read.
pub fn run_test(
    program: &Program,
    test: &CircuitTest,
    options: &Options,
    observe: &mut dyn FnMut(usize, usize),
) -> Result<TestRun, Vec<Diagnostic>> {
    simulate_test(program, test, compile_test(program, test, options)?, options, observe)
}

/// Compiles the circuit of a test onto the robots that it asks for.
///
/// # Errors
/// As [`compile`], and when the robots cannot be read.
pub fn compile_test(program: &Program, test: &CircuitTest, options: &Options) -> Result<Compiled, Vec<Diagnostic>> {
    compile(program, &test.circuit, &library(program, test, options)?, test.span)
}

/// Runs a test whose circuit is compiled, calling `observe` as [`run_test`] does.
///
/// # Errors
/// As [`rows`].
pub fn simulate_test(
    program: &Program,
    test: &CircuitTest,
    compiled: Compiled,
    options: &Options,
    observe: &mut dyn FnMut(usize, usize),
) -> Result<TestRun, Vec<Diagnostic>> {
    let protocol = protocol(program, test);
    let rows = rows(program, test)?;
    let demands = demands(&rows, protocol, &compiled.timing);
    let warnings = short_holds(test, &rows, &demands, &compiled);
    let held = rows.iter().zip(&demands).flat_map(|(row, demand)| std::iter::repeat_n(row.inputs.clone(), demand.hold));
    let exposure = Exposure { inputs: held.collect(), cycle_steps: CYCLE_STEPS, window: protocol.window as usize };
    let cycles = exposure.inputs.len();
    let mut tell = |done| observe(done, cycles);
    let trace = swarm::simulate(&options.simulator, &compiled.assembly, &exposure, &mut tell);
    let clocks: Vec<u32> = compiled.assembly.members.iter().map(|member| member.robot.character.clock).collect();
    let verdict = swarm::judge(&test.title, &trace, &demands, &clocks);
    Ok(TestRun { compiled, trace, verdict, warnings })
}

/// The robots for a test: those of the options, else of the library that the circuit's swarm names, else those of the program.
fn library(program: &Program, test: &CircuitTest, options: &Options) -> Result<Library, Vec<Diagnostic>> {
    if let Some(library) = &options.library {
        return Ok(library.clone());
    }
    let swarm = program.swarms.iter().find(|swarm| swarm.circuit == test.circuit);
    let Some(declared) = swarm.and_then(|swarm| program.library(&swarm.library)) else {
        return Ok(store::shipped_library().clone());
    };
    let mut library = match &declared.from {
        Origin::Shipped => store::shipped_library().clone(),
        Origin::Folder(folder) => store::read_library(folder)?,
        Origin::Evolution(name) => store::read_library(&format!("out/{name}/robots")).map_err(|faults| {
            let help = format!(
                "`nbc evolve --run {name}` and then `nbc library add out/{name}/seed-1 --into out/{name}/robots`"
            );
            faults.into_iter().map(|fault| fault.with_help(help.clone())).collect::<Vec<_>>()
        })?,
    };
    if let Some(behaviors) = &declared.behaviors {
        library.robots.retain(|robot| behaviors.contains(&robot.behavior));
    }
    Ok(library)
}

/// Reads, checks, compiles, simulates and tests a file of the disk.
///
/// # Errors
/// When the file has errors or its circuits cannot be built; a test that fails is no error.
pub fn run_file(path: impl AsRef<Path>, options: &Options) -> Result<RunReport, RunError> {
    let Loaded { sources, checked } = load(&DiskWorld, &path.as_ref().to_string_lossy());
    let fail = |diagnostics: Vec<Diagnostic>| RunError(render::text(&diagnostics, &sources, false));
    if checked.has_errors() {
        return Err(fail(checked.diagnostics));
    }
    let run = |test| run_test(&checked.program, test, options, &mut |_, _| {});
    let tests = checked.program.tests.iter().map(run).collect::<Result<Vec<_>, _>>().map_err(fail)?;
    Ok(RunReport { tests })
}

/// What came of a file's tests.
#[derive(Clone, Debug)]
pub struct RunReport {
    /// The tests in order.
    pub tests: Vec<TestRun>,
}

impl RunReport {
    /// Whether every test passed.
    pub fn passed(&self) -> bool {
        self.tests.iter().all(|test| test.verdict.passed)
    }

    /// Asserts that every test passed.
    ///
    /// # Panics
    /// With the truth tables of the tests that failed.
    pub fn assert_passed(&self) {
        let failed = self.tests.iter().filter(|test| !test.verdict.passed);
        let tables: String = failed.map(|test| report::describe_test(&test.verdict)).collect();
        assert!(tables.is_empty(), "tests of the swarm failed\n{tables}");
    }
}

/// Why a file could not be run: its diagnostics as text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct RunError(String);

/// Warns where a row is held for fewer cycles than the slowest path needs; names the path.
fn short_holds(test: &CircuitTest, rows: &[TestRow], demands: &[Demand], compiled: &Compiled) -> Vec<Diagnostic> {
    let needed = compiled.timing.hold as usize;
    let path: Vec<String> = compiled.timing.critical_path.iter().map(|&net| compiled.mapped.net_name(net)).collect();
    let short = rows.iter().zip(demands).find(|(_, demand)| demand.hold < needed);
    let warn = |(row, demand): (&TestRow, &Demand)| {
        let message = format!("a hold of {} is too short, expected {needed} at least", counted(demand.hold, "cycle"));
        let place = if row.hold.is_some() { row.span } else { test.span };
        Diagnostic::new(Code::HoldTooShort, message, place, "held here")
            .with_help(format!("the slowest path is {}; `hold: auto` waits for it", path.join(" -> ")))
    };
    short.map(warn).into_iter().collect()
}
