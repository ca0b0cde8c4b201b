//! Every stage in order, from source text to verdict.

mod case;
mod file;
mod plan;
mod simulation;

pub use case::{Case, TestRun, cases};
pub use file::{RunError, RunReport, run_file};
pub use plan::{Choice, Plan, choose, is_called, plan, plans, swarms_of};
pub use simulation::{SimulationRun, run_simulation};

use crate::check::{self, Checked};
use crate::circuit::timing::Delays;
use crate::circuit::{CellLibrary, MapError, MapOptions, Netlist, Proof, Timing, elaborate, map_with, prove};
use crate::diag::{Code, Diagnostic};
use crate::model::{Library, Program};
use crate::sim::Simulator;
use crate::source::{FileId, MemoryWorld, SourceWorld, Sources, Span};
use crate::swarm::{self, Assembly, SwarmTrace, WeakRobot};

/// A program with everything that was found in its text.
#[derive(Clone, Debug, Default)]
pub struct Loaded {
    /// The texts that spans point into: the file, the prelude, and what the file uses.
    pub sources: Sources,
    /// The file itself, where it could be read.
    pub file: Option<FileId>,
    /// The program and what is wrong with it.
    pub checked: Checked,
}

/// A circuit on its way from source to swarm.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// What it is made of.
    pub plan: Plan,
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
    /// The robots that make errors or have a thin margin.
    pub weak_robots: Vec<WeakRobot>,
    /// What is legal and surely not meant.
    pub warnings: Vec<Diagnostic>,
}

/// A swarm with what it did.
#[derive(Clone, Debug)]
pub struct SwarmRun {
    /// The circuit, compiled.
    pub compiled: Compiled,
    /// What its robots did.
    pub trace: SwarmTrace,
}

/// How swarms are made and run.
#[derive(Clone, Debug)]
pub struct Options {
    /// These robots instead of those that the file asks for.
    pub library: Option<Library>,
    /// How their robots are simulated.
    pub simulator: Simulator,
    /// The folder of evolution runs: the robots of `from: NAME` are in `NAME/robots` there.
    pub runs: String,
}

/// Where evolution runs are unless another place is named.
pub const RUNS: &str = "out";

impl Default for Options {
    fn default() -> Self {
        Self { library: None, simulator: Simulator::default(), runs: RUNS.to_owned() }
    }
}

/// Reads and checks a file. What cannot be read is a diagnostic like any other.
pub fn load(world: &dyn SourceWorld, path: &str) -> Loaded {
    let mut sources = Sources::default();
    match check::open(world, path, &mut sources) {
        Ok(file) => {
            let checked = check::check(world, &mut sources, file);
            Loaded { sources, file: Some(file), checked }
        }
        Err(fault) => {
            let checked = Checked { diagnostics: vec![fault], ..Checked::default() };
            Loaded { sources, file: None, checked }
        }
    }
}

/// The program of the prelude alone.
pub fn prelude() -> Program {
    let mut sources = Sources::default();
    let nothing = sources.add("nothing", "");
    check::check(&MemoryWorld::default(), &mut sources, nothing).program
}

/// Compiles a circuit of a program without errors to a swarm of its plan's robots: elaborate, map, prove, time, assemble.
///
/// # Errors
/// When the circuit cannot be built as asked for at `place`, or the library lacks a function.
///
/// # Panics
/// When the mapped netlist is not proved equal to its source, which is a fault of the compiler.
pub fn compile(program: &Program, plan: Plan, place: Span) -> Result<Compiled, Vec<Diagnostic>> {
    let source = elaborate(program, &plan.circuit)?;
    let cells = swarm::cells(&plan.library);
    let (mapped, proof) = synthesize(&source, &cells, MapOptions::default())
        .map_err(|fault| vec![fault.with_label(place, "for this circuit")])?;
    let timing = Timing::of(&mapped, &cells, Delays::Clock);
    let assembly = swarm::assemble(&mapped, &plan.library).expect("the netlist was mapped onto this library");
    let weak_robots = swarm::weak_robots(&assembly);
    let warnings = weak_robots.iter().map(|weak| warn_of(weak, &plan, place)).collect();
    Ok(Compiled { plan, source, mapped, proof, timing, assembly, weak_robots, warnings })
}

/// Maps a netlist onto a library's cells, and proves that the result is equal to it.
///
/// # Errors
/// When the library lacks functions, or the netlist is not well formed or too large.
///
/// # Panics
/// When the mapped netlist is not proved equal to its source, which is a fault of the compiler.
pub fn synthesize(source: &Netlist, cells: &CellLibrary, options: MapOptions) -> Result<(Netlist, Proof), Diagnostic> {
    let mapped = map_with(source, cells, options).map_err(|error| {
        let code = match error {
            MapError::Netlist(_) => Code::CircuitFile,
            MapError::TooLarge { .. } => Code::TooLarge,
            MapError::Incomplete { .. } => Code::IncompleteLibrary,
        };
        let fault = Diagnostic::without_place(code, error.to_string());
        match error.help() {
            Some(help) => fault.with_help(help),
            None => fault,
        }
    })?;
    match prove(source, &mapped) {
        Ok(proof) => Ok((mapped, proof)),
        Err(error) => panic!("the compiled circuit `{}` differs from its source: {error}", source.name),
    }
}

fn warn_of(weak: &WeakRobot, plan: &Plan, place: Span) -> Diagnostic {
    let message = format!("`{}` uses the robot `{}`, {}", plan.circuit, weak.robot, weak.complaint());
    let help = format!("it drives {}; a library without it, or a longer hold, may do better", weak.nets.join(", "));
    Diagnostic::new(Code::WeakRobot, message, place, "for this circuit").with_help(help)
}
