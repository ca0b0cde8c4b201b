//! How a circuit becomes a swarm: which declared swarm is meant, and with it the robots, the hold and the window. Every command asks here.

use crate::check::DEFAULT_LIBRARY;
use crate::circuit::is_same_instance;
use crate::diag::{Code, Diagnostic, suggest};
use crate::model::{CircuitTest, Hold, Instance, Library, LibrarySource, Origin, Program, Swarm};
use crate::pipeline::{Loaded, Options};
use crate::store::{self, DiskWorld};

/// A circuit with all that a swarm declares for it.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The circuit.
    pub circuit: Instance,
    /// The declared swarm; none where the file declares none for the circuit.
    pub swarm: Option<String>,
    /// The robots.
    pub library: Library,
    /// How long a row of a test is held that does not say so itself.
    pub hold: Hold,
    /// Cycles over which an output is taken.
    pub window: u32,
}

/// The swarms that are declared for a circuit, in order.
pub fn swarms_of<'p>(program: &'p Program, circuit: &Instance) -> Vec<&'p Swarm> {
    program.swarms.iter().filter(|swarm| is_same_instance(program, &swarm.circuit, circuit)).collect()
}

/// The plans of a circuit: one for each swarm that is declared for it, or that of the default library where there is none.
///
/// # Errors
/// When robots cannot be read.
pub fn plans(program: &Program, circuit: &Instance, options: &Options) -> Result<Vec<Plan>, Vec<Diagnostic>> {
    match &swarms_of(program, circuit)[..] {
        [] => Ok(vec![plan(program, circuit, None, options)?]),
        swarms => swarms.iter().map(|swarm| plan(program, circuit, Some(swarm), options)).collect(),
    }
}

/// The plan of a circuit as a declared swarm, or of the default library.
///
/// # Errors
/// When robots cannot be read.
pub fn plan(
    program: &Program,
    circuit: &Instance,
    swarm: Option<&Swarm>,
    options: &Options,
) -> Result<Plan, Vec<Diagnostic>> {
    let declared = program.library(swarm.map_or(DEFAULT_LIBRARY, |swarm| swarm.library.as_str()));
    let library = match (&options.library, declared) {
        (Some(library), _) => library.clone(),
        (None, Some(declared)) => robots(declared, options)?,
        (None, None) => store::shipped_library(),
    };
    Ok(Plan {
        circuit: circuit.clone(),
        swarm: swarm.map(|swarm| swarm.name.clone()),
        library,
        hold: swarm.map_or(Hold::Auto, |swarm| swarm.hold),
        window: swarm.map_or(1, |swarm| swarm.window),
    })
}

/// The robots of a declared library.
fn robots(declared: &LibrarySource, options: &Options) -> Result<Library, Vec<Diagnostic>> {
    let placed = |faults: Vec<Diagnostic>, help: Option<String>| {
        let placed = faults.into_iter().map(|fault| fault.with_label(declared.span, "the robots of this library"));
        placed.map(|fault| help.iter().fold(fault, |fault, help| fault.with_help(help.as_str()))).collect::<Vec<_>>()
    };
    let mut library = match &declared.from {
        Origin::Shipped => store::shipped_library(),
        Origin::Folder(folder) => store::read_library(&DiskWorld, folder).map_err(|faults| placed(faults, None))?,
        Origin::Evolution(name) => {
            let run = format!("{}/{name}", options.runs);
            let help = format!(
                "`nbc evolve --run {name} --out {}`, then `nbc library add {run}/seed-1 --into {run}/robots`",
                options.runs
            );
            store::read_library(&DiskWorld, &format!("{run}/robots")).map_err(|faults| placed(faults, Some(help)))?
        }
    };
    if let Some(behaviors) = &declared.behaviors {
        library.robots.retain(|robot| behaviors.contains(&robot.behavior));
    }
    Ok(library)
}

/// Which circuit of a file is meant, in the words of a command line; what is left out is chosen by the file.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    /// A circuit, such as `adder` or `adder[8]`.
    pub circuit: Option<String>,
    /// A declared swarm.
    pub swarm: Option<String>,
}

/// The circuit of a file that is meant, and its swarm: those chosen, else the last circuit that the file itself declares. Where that
/// needs numbers for its parameters, they are those of its swarm or its test. `needs_swarm` is whether one of several swarms of the
/// circuit must be chosen.
///
/// # Errors
/// When there is no such circuit or swarm, or several swarms are declared for the circuit. Diagnostics point into `loaded.sources`, to
/// which the words of the command line are added.
pub fn choose(
    loaded: &mut Loaded,
    choice: &Choice,
    needs_swarm: bool,
) -> Result<(Instance, Option<Swarm>), Diagnostic> {
    let chosen = match &choice.circuit {
        Some(circuit) => {
            let file = loaded.sources.add("--circuit", circuit.as_str());
            Some(crate::check::named(&loaded.checked.program, &loaded.sources, file)?)
        }
        None => None,
    };
    let program = &loaded.checked.program;
    let swarm = choice.swarm.as_deref().map(|name| declared_swarm(program, name)).transpose()?;
    let circuit = match (chosen, swarm) {
        (Some(circuit), _) => circuit,
        (None, Some(swarm)) => swarm.circuit.clone(),
        (None, None) => last_circuit(loaded)?,
    };
    let swarms = swarms_of(program, &circuit);
    match (swarm, &swarms[..]) {
        (Some(swarm), all) if all.iter().all(|one| one.name != swarm.name) => {
            let message = format!("the swarm `{}` is of `{}`, not of `{circuit}`", swarm.name, swarm.circuit);
            Err(Diagnostic::without_place(Code::BadValue, message))
        }
        (Some(swarm), _) => Ok((circuit, Some(swarm.clone()))),
        (None, [first, second, ..]) if needs_swarm => {
            let message = format!("several swarms are declared for `{circuit}`");
            let help = format!("choose one, for example `--swarm {}` or `--swarm {}`", first.name, second.name);
            Err(Diagnostic::without_place(Code::BadValue, message).with_help(help))
        }
        (None, all) => Ok((circuit, all.first().map(|&swarm| swarm.clone()))),
    }
}

fn declared_swarm<'p>(program: &'p Program, name: &str) -> Result<&'p Swarm, Diagnostic> {
    program.swarm(name).ok_or_else(|| {
        let fault = Diagnostic::without_place(Code::Unknown, format!("no swarm is called `{name}`"));
        match suggest::help(name, program.swarms.iter().map(|swarm| swarm.name.as_str())) {
            Some(help) => fault.with_help(help),
            None => fault,
        }
    })
}

/// The last circuit of the file itself.
fn last_circuit(loaded: &Loaded) -> Result<Instance, Diagnostic> {
    let program = &loaded.checked.program;
    let Some(last) = program.circuits.iter().rfind(|circuit| Some(circuit.span.file) == loaded.file) else {
        let help = "choose one that it uses: `--circuit NAME`";
        return Err(Diagnostic::without_place(Code::Empty, "the file declares no circuit").with_help(help));
    };
    if last.parameters.iter().all(|parameter| parameter.default.is_some()) {
        return Ok(last.name.as_str().into());
    }
    let swarms = program.swarms.iter().map(|swarm| &swarm.circuit);
    let used = swarms.chain(program.tests.iter().map(|test| &test.circuit));
    Ok(used.into_iter().find(|used| used.circuit == last.name).cloned().unwrap_or_else(|| last.name.as_str().into()))
}

/// The tests that go by a name: a test's title, its circuit, or one of its circuit's swarms.
pub fn is_called(program: &Program, test: &CircuitTest, name: &str) -> bool {
    test.title == name
        || test.circuit.circuit == name
        || test.circuit.to_string() == name
        || swarms_of(program, &test.circuit).iter().any(|swarm| swarm.name == name)
}
