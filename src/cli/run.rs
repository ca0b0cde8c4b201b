//! `nbc run`: compile a file's circuits, simulate their swarms, test them, and draw what happened.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use crate::cli::timings::{self, Timings};
use crate::cli::{Context, Failure, Format, Progress, Status};
use crate::diag::{Code, Diagnostic};
use crate::model::{CircuitTest, Robot};
use crate::pipeline::{self, Compiled, Loaded, Options, TestRun};
use crate::report::{self, PageTest, Recording, Room, RunResult, Scheme, Stage, Svg, SwarmTiming, TestResult};
use crate::store::{self, DiskWorld};

/// Compile, simulate and test the circuits of a file
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc run circuits/latch.nb
  nbc run circuits/latch.nb --out /tmp/latch --format json

Every robot is simulated voxel by voxel. Pictures, waveforms, a report page and result.json are written to `out/` and the file's name.
Exit status: 0 every test passed, 1 a test failed, 2 the file has errors.")]
pub struct Arguments {
    /// The source file
    file: PathBuf,
    /// The folder for pictures and results [default: out/ and the file's name]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Leave out the report page
    #[arg(long)]
    no_report: bool,
    #[command(flatten)]
    timings: Timings,
}

/// A test's run with its drawings.
struct Drawn<'a> {
    run: &'a TestRun,
    spacetime: Svg,
    schematic: Svg,
    files: Vec<String>,
}

impl Arguments {
    /// Runs the file's tests and writes what came of them.
    ///
    /// # Errors
    /// When the file has errors, or results cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let started = Instant::now();
        let Loaded { sources, checked } = pipeline::load(&DiskWorld, &self.file.to_string_lossy());
        if checked.has_errors() {
            return Err(Failure::input(checked.diagnostics, sources));
        }
        if checked.program.tests.is_empty() {
            let message = format!("`{}` declares no test, so there is nothing to run", self.file.display());
            let help =
                "declare one: `test my_circuit { a b | q` and a row for each input pattern; `nbc check` only checks";
            return Err(Failure::plain(Diagnostic::without_place(Code::Empty, message).with_help(help)));
        }
        let folder = self.folder();
        store::create_folder(&folder).map_err(|error| Failure::unwritable(&folder, &error))?;
        let options = Options { simulator: self.timings.simulator(), ..Options::default() };
        let mut warnings = checked.diagnostics;
        let mut runs = Vec::new();
        for test in &checked.program.tests {
            match simulate(&checked.program, test, &options) {
                Ok(run) => {
                    warnings.extend(run.warnings.iter().cloned());
                    runs.push(run);
                }
                Err(faults) => return Err(Failure::input(faults, sources)),
            }
        }
        context.tell(&warnings, &sources);
        let status = timings::time(timings::Stage::Output, || self.report(&runs, &folder, context))?;
        self.timings.tell(started, context);
        Ok(status)
    }

    fn folder(&self) -> PathBuf {
        let stem = self.file.file_stem().unwrap_or(self.file.as_os_str());
        self.out.clone().unwrap_or_else(|| Path::new("out").join(stem))
    }

    /// Writes pictures and results, then prints the verdict.
    fn report(&self, runs: &[TestRun], folder: &Path, context: &mut Context) -> Result<Status, Failure> {
        let drawn =
            runs.iter().enumerate().map(|(i, run)| draw(run, &stem(runs, i), folder)).collect::<Result<Vec<_>, _>>()?;
        let source = self.file.to_string_lossy();
        let tests = drawn.iter().map(test_result);
        let result = RunResult::new(&source, tests.collect());
        let json = serde_json::to_string_pretty(&result).expect("a result has nothing that JSON cannot say") + "\n";
        write(&folder.join("result.json"), json.as_bytes())?;
        let page = folder.join("report.html");
        if !self.no_report {
            let tests: Vec<PageTest<'_>> = drawn.iter().map(page_test).collect();
            write(&page, report::draw_run_page(&source, &tests, Scheme::default()).as_bytes())?;
        }
        match context.format {
            Format::Json => context.print_json(&result)?,
            Format::Text => {
                for drawn in &drawn {
                    context.print(describe(drawn))?;
                }
                let page = if self.no_report { String::new() } else { format!("report   {}\n", page.display()) };
                let verdict = if result.passed { "pass" } else { "FAIL" };
                context.print(format_args!("{page}results  {}\n{verdict}\n", folder.join("result.json").display()))?;
            }
        }
        Ok(if result.passed { Status::Done } else { Status::TestFailed })
    }
}

fn simulate(
    program: &crate::model::Program,
    test: &CircuitTest,
    options: &Options,
) -> Result<TestRun, Vec<Diagnostic>> {
    let bar = Progress::new("simulating", 0);
    pipeline::run_test(program, test, options, &mut |done, all| {
        bar.set_total(all as u64);
        bar.set(done as u64);
    })
}

/// The name of a test's files: the circuit's, with a number where a circuit has several tests.
fn stem(runs: &[TestRun], i: usize) -> String {
    let circuit = &runs[i].verdict.circuit;
    let before = runs[..i].iter().filter(|run| run.verdict.circuit == *circuit).count();
    let several = runs.iter().filter(|run| run.verdict.circuit == *circuit).count() > 1;
    if several { format!("{circuit}-{}", before + 1) } else { circuit.clone() }
}

/// Draws a test's run and writes the drawings and waveforms.
fn draw<'a>(run: &'a TestRun, stem: &str, folder: &Path) -> Result<Drawn<'a>, Failure> {
    let (spacetime, schematic) = (report::draw_swarm(&run.trace), draw_circuit(run, Scheme::default()));
    let files = [
        ("spacetime.svg", spacetime.finish().into_bytes()),
        ("spacetime.png", report::png(&spacetime)),
        ("schematic.svg", schematic.finish().into_bytes()),
        ("schematic.png", report::png(&schematic)),
        ("waves.vcd", report::vcd(&run.trace).into_bytes()),
    ];
    let mut written = Vec::new();
    for (kind, bytes) in files {
        let path = folder.join(format!("{stem}-{kind}"));
        write(&path, &bytes)?;
        written.push(path.display().to_string());
    }
    Ok(Drawn { run, spacetime, schematic, files: written })
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    store::write(path, bytes).map_err(|error| Failure::unwritable(path, &error))
}

fn draw_circuit(run: &TestRun, scheme: Scheme) -> Svg {
    let compiled = &run.compiled;
    let robots: Vec<&Robot> = compiled.assembly.members.iter().map(|member| &member.robot).collect();
    report::draw_schematic(&compiled.mapped, &robots, &compiled.timing.critical_path, scheme)
}

/// The page of tests that were run.
pub(super) fn run_page(source: &str, runs: &[TestRun], scheme: Scheme) -> String {
    let drawn: Vec<Drawn<'_>> = runs
        .iter()
        .map(|run| Drawn {
            run,
            spacetime: report::draw_swarm(&run.trace),
            schematic: draw_circuit(run, scheme),
            files: Vec::new(),
        })
        .collect();
    let tests: Vec<PageTest<'_>> = drawn.iter().map(page_test).collect();
    report::draw_run_page(source, &tests, scheme)
}

fn page_test<'a>(drawn: &'a Drawn<'a>) -> PageTest<'a> {
    let run = drawn.run;
    PageTest {
        verdict: &run.verdict,
        trace: &run.trace,
        assembly: &run.compiled.assembly,
        recording: record(run),
        schematic: &drawn.schematic,
        spacetime: &drawn.spacetime,
    }
}

/// The film of a swarm, as far as a page has room for it.
fn record(run: &TestRun) -> Recording {
    let (assembly, trace) = (&run.compiled.assembly, &run.trace);
    let probe = Stage::of_swarm(assembly, trace, crate::model::CYCLE_STEPS);
    let points: Vec<usize> = (0..probe.robots()).map(|i| probe.points(i).len()).collect();
    let (stride, robots) = Room::SWARM.fit(&points, trace.cycles.len());
    Recording::of(Stage::of_swarm(assembly, trace, stride), robots)
}

fn describe(drawn: &Drawn<'_>) -> String {
    let (trace, verdict) = (&drawn.run.trace, &drawn.run.verdict);
    let files: String = drawn.files.iter().map(|file| format!("picture  {file}\n")).collect();
    let (swarm, test, timing) =
        (report::describe_swarm(trace), report::describe_test(verdict), timing(drawn.run).describe());
    format!("{}: {swarm}\n\n{test}\n{files}{timing}", trace.circuit)
}

fn test_result<'a>(drawn: &Drawn<'a>) -> TestResult<'a> {
    TestResult::new(&drawn.run.verdict, &drawn.run.trace, timing(drawn.run), drawn.files.clone())
}

fn timing(run: &TestRun) -> SwarmTiming {
    let Compiled { mapped, timing, assembly, .. } = &run.compiled;
    SwarmTiming::of(mapped, timing, assembly)
}
