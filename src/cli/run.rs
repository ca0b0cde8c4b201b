//! `nbc run`: compiles a file's circuits, tests and simulates their swarms, and draws the results.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::options::device::DeviceArguments;
use crate::cli::options::files::FilesArguments;
use crate::cli::options::making::MakingArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::options::timings::{TimedStage, Timings};
use crate::cli::runs::{CompleteRun, run_list, unknown_run};
use crate::cli::source_path::{result_path, source_path};
use crate::cli::{Context, Failure, Interrupt, OpenDevice, OutputFormat, Status, runs};
use nbc_session::report::{
    self, Document, PageSwarm, RunResult, Schema, SchematicPages, Scheme, Svg, SwarmResult, SwarmTiming,
};
use nbc_session::store::{self, ResultPlace};
use nbc_session::{Checked, CompileOptions, RUNS, RunList, Session, SwarmRun, TestRun};
use nbc_swarm::Room;

/// Run the tests and simulations of a file in physics, with pictures and a report
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc run circuits/latch.nb
  nbc run circuits/latch.nb --out /tmp/latch --format json
  nbc run circuits/latch.nb --only d_latch      a test's title, a circuit or a swarm

Every robot is simulated voxel by voxel. A test runs once for each swarm that is declared for its circuit, in each \
world that the test names. Pictures, waveforms, a table of the cycles, a report page and result.json are written to a \
folder in `out/` with the file's name. Of several tests, each that passed is a line; one that failed, or the only one, \
has its table, too.
Exit status: 0 every test passed, 1 a test or a robot failed, 2 the file has errors, 4 interrupted.")]
pub struct RunArguments {
    /// The source file
    file: PathBuf,
    /// Run only tests and simulations with this name: a test's title, a circuit or a swarm
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// The folder for pictures and results [default: `out/NAME` for the file `NAME.nb`]
    #[arg(long, value_name = "DIR", value_parser = new_path())]
    out: Option<PathBuf>,
    /// Do not write the report page
    #[arg(long)]
    no_report: bool,
    /// Print the table, the files and the hold of every test, also of those that passed
    #[arg(long)]
    tables: bool,
    #[command(flatten)]
    making: MakingArguments,
    #[command(flatten)]
    named: FilesArguments,
    #[command(flatten)]
    device: DeviceArguments,
    #[command(flatten)]
    timings: Timings,
}

struct Drawn<'a> {
    ran: &'a CompleteRun,
    spacetime: Svg,
    schematic: SchematicPages,
    files: Vec<String>,
}

impl RunArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let (timer, interrupt) = (self.timings.start(), Interrupt::watch()?);
        let device = OpenDevice::open(self.device, timer.processor(), context)?;
        let mut session =
            Session::new(interrupt.world()).with_simulator(device.simulator()).with_files(self.named.files());
        if !self.no_report {
            session = session.with_poses(Room::SWARM);
        }
        let file = match session.open(source_path(&self.file)?) {
            Err(_) if interrupt.is_raised() => return Ok(Status::Interrupted),
            file => file?,
        };
        self.named.check(std::slice::from_ref(&file))?;
        let list = self.chosen(&file)?;
        let folder = self.folder();
        folder.probe().map_err(|error| Failure::unwritable(&folder.path(), &error))?;
        let compile = CompileOptions { cancel: interrupt.cancel(), ..self.named.of(&file, self.making.options()?) };
        let report = run_list(&session, &file, &list, compile, &interrupt)?;
        device.end(context)?;
        let (all, left) = (list.len(), report.left);
        let runs = CompleteRun::complete(report);
        context.warn(&file, file.diagnostics.iter().chain(runs.iter().flat_map(CompleteRun::warnings)));
        context.origins(&file);
        if interrupt.is_raised() {
            context.log(&format!("interrupted: {} of {all} tests and simulations complete\n", all - left));
            if runs.is_empty() {
                return Ok(Status::Interrupted);
            }
        }
        let folder = folder.create().map_err(|error| Failure::unwritable(&folder.path(), &error))?;
        let status = timer.time(TimedStage::Output, || self.report(&runs, &folder, context))?;
        timer.report(context);
        Ok(if interrupt.is_raised() { Status::Interrupted } else { status })
    }

    fn chosen<'f>(&'f self, file: &'f Checked) -> Result<RunList<'f>, Failure> {
        let choice = self.making.choice();
        let list = RunList::chosen(file, self.only.as_deref(), &choice)?.in_physics();
        if !list.is_empty() {
            return Ok(list);
        }
        let named = self.only.as_ref().or(choice.swarm.as_ref()).or(choice.circuit.as_ref());
        let fault = named.map_or_else(|| runs::wording::nothing_to_run(&file.path), |name| unknown_run(file, name));
        Err(fault.into())
    }

    fn folder(&self) -> ResultPlace {
        let stem = self.file.file_stem().unwrap_or(self.file.as_os_str());
        ResultPlace::new(self.out.as_deref(), &Path::new(RUNS).join(stem), "")
    }

    fn report(&self, runs: &[CompleteRun], folder: &Path, context: &mut Context) -> Result<Status, Failure> {
        let stems = stems(runs);
        let drawn =
            runs.iter().zip(&stems).map(|(run, stem)| draw(run, stem, folder)).collect::<Result<Vec<_>, _>>()?;
        let source = self.file.to_string_lossy();
        let result = result(&source, &drawn);
        let json = serde_json::to_string_pretty(&Document::new(Schema::Run, &result))
            .expect("a result can be written as JSON")
            + "\n";
        write(&folder.join("result.json"), json.as_bytes())?;
        let page = folder.join("report.html");
        if !self.no_report {
            let swarms: Vec<PageSwarm<'_>> = drawn.iter().map(page_swarm).collect();
            write(&page, report::draw_run_page(&source, &swarms, Scheme::default()).as_bytes())?;
        }
        match context.format {
            OutputFormat::Json => context.print_json(Schema::Run, &result)?,
            OutputFormat::Text => {
                let is_alone = drawn.len() == 1;
                for drawn in &drawn {
                    let is_whole = self.tables || is_alone || !drawn.ran.passed();
                    context.print_verdicts(&if is_whole { describe(drawn) } else { summarize(drawn) })?;
                }
                let files = if is_alone { String::new() } else { format!("files    {}\n", folder.display()) };
                let page = if self.no_report { String::new() } else { format!("report   {}\n", page.display()) };
                let verdict = match (result.tests.len(), result.passed) {
                    (0, true) => "",
                    (_, true) => "pass\n",
                    (_, false) => "FAIL\n",
                };
                let results = folder.join("result.json");
                context.print_verdicts(&format!("{files}{page}results  {}\n{verdict}", results.display()))?;
            }
        }
        Ok(if result.passed { Status::Done } else { Status::TestFailed })
    }
}

/// The circuit's name, with those of the swarm and the world if a test has several, and a number for repeated names.
fn stems(runs: &[CompleteRun]) -> Vec<String> {
    let mut cases: BTreeMap<(&str, usize), usize> = BTreeMap::new();
    for run in runs {
        if let CompleteRun::Test(TestRun { verdict, .. }) = run {
            *cases.entry((&verdict.circuit, verdict.line)).or_default() += 1;
        }
    }
    let name = |run: &CompleteRun| match run {
        CompleteRun::Test(TestRun { verdict, .. }) => {
            let is_one_of_several = cases[&(verdict.circuit.as_str(), verdict.line)] > 1;
            let world = verdict.world.as_ref().filter(|_| verdict.is_world_named);
            let others = [verdict.swarm.as_ref(), world].into_iter().flatten().filter(|_| is_one_of_several);
            others.fold(verdict.circuit.clone(), |name, other| format!("{name}-{other}"))
        }
        CompleteRun::Simulation(run) => format!("simulate-{}", run.result.swarm),
    };
    let names: Vec<String> = runs.iter().map(name).collect();
    let numbered = |(i, name): (usize, &String)| {
        let before = names[..i].iter().filter(|other| *other == name).count();
        let several = names.iter().filter(|other| *other == name).count() > 1;
        if several { format!("{name}-{}", before + 1) } else { name.clone() }
    };
    names.iter().enumerate().map(numbered).collect()
}

fn draw<'a>(ran: &'a CompleteRun, stem: &str, folder: &Path) -> Result<Drawn<'a>, Failure> {
    let SwarmRun { compiled, trace } = ran.swarm();
    let (spacetime, schematic) = (report::draw_swarm(trace), compiled.schematic(Scheme::default()));
    let top = schematic.top();
    let mut drawn = Drawn { ran, spacetime, schematic: schematic.pages(), files: Vec::new() };
    let files = [
        ("spacetime.svg", drawn.spacetime.finish().into_bytes()),
        ("spacetime.png", report::png(&drawn.spacetime)),
        ("schematic.svg", top.finish().into_bytes()),
        ("schematic.png", report::png(&top)),
        ("waves.vcd", report::vcd(trace).into_bytes()),
        ("cycles.csv", report::cycle_table(trace).into_bytes()),
    ];
    for (kind, bytes) in files {
        let path = folder.join(format!("{stem}-{kind}"));
        write(&path, &bytes)?;
        drawn.files.push(result_path(&path));
    }
    Ok(drawn)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    store::write_result(path, bytes).map_err(|error| Failure::unwritable(path, &error))
}

fn page_swarm<'a>(drawn: &'a Drawn<'a>) -> PageSwarm<'a> {
    let swarm = drawn.ran.swarm();
    PageSwarm {
        outcome: drawn.ran.outcome(),
        trace: &swarm.trace,
        assembly: &swarm.compiled.assembly,
        schematic: &drawn.schematic,
        spacetime: &drawn.spacetime,
        timing: timing(drawn.ran).describe(),
    }
}

fn describe(drawn: &Drawn<'_>) -> String {
    let trace = &drawn.ran.swarm().trace;
    let files: String = drawn.files.iter().map(|file| format!("{:<8} {file}\n", word_of(file))).collect();
    let (outcome, hold) = match drawn.ran {
        CompleteRun::Test(run) => (report::describe_test(&run.verdict), run.hold),
        CompleteRun::Simulation(run) => (report::describe_simulation(&run.result), None),
    };
    let (swarm, hold) = (report::describe_swarm(trace), timing(drawn.ran).describe_hold(hold));
    format!("{}: {swarm}\n\n{outcome}\n{files}{hold}", trace.circuit)
}

/// Of several that passed: a line for a test, the table of a simulation.
fn summarize(drawn: &Drawn<'_>) -> String {
    match drawn.ran {
        CompleteRun::Test(run) => report::describe_verdict(&run.verdict),
        CompleteRun::Simulation(run) => report::describe_simulation(&run.result),
    }
}

fn word_of(file: &str) -> &'static str {
    match file.rsplit('.').next() {
        Some("vcd") => "waves",
        Some("csv") => "cycles",
        _ => "picture",
    }
}

fn result<'a>(source: &'a str, drawn: &'a [Drawn<'a>]) -> RunResult<'a> {
    let (mut tests, mut simulations) = (Vec::new(), Vec::new());
    for one in drawn {
        let (trace, timing, files) = (&one.ran.swarm().trace, timing(one.ran), one.files.clone());
        match one.ran {
            CompleteRun::Test(run) => tests.push(SwarmResult::new(&run.verdict, trace, timing, files)),
            CompleteRun::Simulation(run) => simulations.push(SwarmResult::new(&run.result, trace, timing, files)),
        }
    }
    RunResult::new(source, tests, simulations)
}

fn timing(ran: &CompleteRun) -> SwarmTiming {
    ran.swarm().compiled.swarm_timing()
}
