//! `nbc test`: files' tests, at the level of logic or in full physics.

mod keeping;
pub(super) mod worlds;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use serde::Serialize;

use crate::cli::documents::Interrupted;
use crate::cli::in_order::in_order;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::files::FilesArguments;
use crate::cli::options::making::MakingArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::options::queue::{self, QueueArguments};
use crate::cli::runs::unknown_run;
use crate::cli::source_path::source_path;
use crate::cli::task_executor::threads;
use crate::cli::{Context, Failure, Interrupt, OpenDevice, OutputFormat, Progress, Status, runs};
use nbc_base::diag::Diagnostic;
use nbc_session::report::{self, Schema};
use nbc_session::store;
use nbc_session::{Checked, CompileOptions, RunEnd, RunList, Session, TestCase, TestOptions};
use nbc_sim::LaneBackend;
use nbc_swarm::{Executor, Level, Task, TaskResult, TestVerdict};

use keeping::{Keeper, Keeping};
use worlds::WorldsArguments;
pub(super) use worlds::share;

/// Test the circuits of a file
#[derive(Args)]
#[command(after_help = "Examples:
  nbc test circuits/counter.nb
  nbc test circuits/latch.nb --logic
  nbc test circuits/latch.nb --physics
  nbc test circuits/latch.nb --worlds 200 --vary friction=10%,gravity=5%,stiffness=5%

At the level of logic, every cell takes one time step, and a row is held until nothing changes. In physics, every \
robot is simulated voxel by voxel, and a test runs once for each swarm that is declared for its circuit, in each \
world that the test names. A robot whose simulation fails fails its row and all that follow. By default, \
circuits of fewer than 40 robots are tested in physics and larger ones at the level of logic.

With --vary, each test runs in physics in a sample of worlds. Each factor (friction, gravity, stiffness, drag, \
damping, swelling) is uniform within its change to either side, and each noise (start, missed, weak, dead, phase, \
drift) from nothing to its change. The output has the share of worlds in which the test passes, with its 95 % \
interval, the robots that fail first, and the smallest margin of the others. A test that fails in some worlds does \
not change the exit status, unless --least-yield asks for more.
Exit status: 0 every test passed, 1 a test failed or its yield is too low, 2 the file has errors, 4 interrupted.")]
pub struct TestArguments {
    /// The source files
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Run only tests with this name: a title, a circuit or a swarm
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Test at the level of logic
    #[cfg_attr(feature = "cluster", arg(conflicts_with = "nats"))]
    #[cfg_attr(feature = "gpu", arg(conflicts_with = "device"))]
    #[arg(long, conflicts_with = "physics")]
    logic: bool,
    /// Test in full physics
    #[arg(long)]
    physics: bool,
    /// Keep the swarms of tests in physics in this folder once a minute, and go on with those that are there
    #[arg(long, value_name = "DIR", conflicts_with = "logic", value_parser = new_path())]
    checkpoints: Option<PathBuf>,
    #[command(flatten)]
    worlds: WorldsArguments,
    #[command(flatten)]
    making: MakingArguments,
    #[command(flatten)]
    named: FilesArguments,
    #[command(flatten)]
    device: DeviceArguments,
    #[command(flatten)]
    queue: QueueArguments,
}

/// A case with the index of its file on the command line.
type Numbered = (usize, TestCase);

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct TestResults {
    /// Whether every test passed.
    passed: bool,
    /// Those that are complete.
    tests: Vec<TestVerdict>,
    #[serde(skip_serializing_if = "Option::is_none")]
    interrupted: Option<Interrupted>,
}

impl TestArguments {
    /// Runs the tests in parallel, and prints each result as soon as those before it are done.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let device = self.device(context)?;
        let mut session =
            Session::new(interrupt.world()).with_simulator(device.simulator()).with_files(self.named.files());
        let files = match self.files.iter().map(|file| load(&mut session, file)).collect::<Result<Vec<_>, _>>() {
            Err(_) if interrupt.is_raised() => return Ok(Status::Interrupted),
            files => files?,
        };
        let status = self.test(&session, &files, &interrupt, context)?;
        device.end(context)?;
        Ok(status)
    }

    pub(super) fn device(&self, context: &Context) -> Result<OpenDevice, Failure> {
        OpenDevice::open(self.device, LaneBackend::default(), context)
    }

    pub(super) fn named_files(&self) -> Vec<(String, String)> {
        self.named.files()
    }

    pub(super) fn paths(&self) -> Result<Vec<&str>, Diagnostic> {
        self.files.iter().map(|file| source_path(file)).collect()
    }

    pub(super) fn test(
        &self,
        session: &Session,
        files: &[Arc<Checked>],
        interrupt: &Interrupt,
        context: &mut Context,
    ) -> Result<Status, Failure> {
        let cases = self.cases(files, interrupt)?;
        if let Some(folder) = &self.checkpoints {
            store::create_folder(folder).map_err(|error| Failure::unwritable(folder, &error))?;
        }
        for file in files {
            context.warn(file, &file.diagnostics);
            context.origins(file);
        }
        if self.worlds.is_used() {
            let cases: Vec<TestCase> = cases.into_iter().map(|(_, case)| case).collect();
            return self.worlds.test(session, &cases, interrupt, context);
        }
        let verdicts = run_cases(session, &cases, files, &self.queue, self.checkpoints.as_deref(), interrupt, context)?;
        let failed = verdicts.iter().filter(|verdict| !verdict.passed).count();
        let left = interrupt.is_raised().then_some(cases.len() - verdicts.len());
        match context.format {
            OutputFormat::Json => {
                let passed = failed == 0 && left.is_none();
                let interrupted = left.map(|left| Interrupted { left });
                context.print_json(Schema::Test, &TestResults { passed, tests: verdicts, interrupted })?
            }
            OutputFormat::Text => {
                let left = left.map_or(String::new(), |left| format!(", {left} interrupted or not begun"));
                context.print(format_args!("{} passed, {failed} failed{left}\n", verdicts.len() - failed))?
            }
        }
        Ok(match (left, failed) {
            (Some(_), _) => Status::Interrupted,
            (None, 0) => Status::Done,
            (None, _) => Status::TestFailed,
        })
    }

    fn level(&self) -> Option<Level> {
        match (self.logic, self.physics) {
            (true, _) => Some(Level::Logic),
            (_, true) => Some(Level::Physics),
            _ if self.worlds.is_used() => Some(Level::Physics),
            _ => None,
        }
    }

    fn cases(&self, files: &[Arc<Checked>], interrupt: &Interrupt) -> Result<Vec<Numbered>, Failure> {
        self.named.check(files)?;
        let (mut cases, choice, making) = (Vec::new(), self.making.choice(), self.making.options()?);
        for (number, file) in files.iter().enumerate() {
            let compile = self.named.of(file, making.clone());
            let compile = CompileOptions { cancel: interrupt.cancel(), ..compile };
            let options = TestOptions { level: self.level(), compile };
            for test in RunList::chosen(file, self.only.as_deref(), &choice)?.tests {
                cases.extend(file.cases(test, &options)?.into_iter().map(|case| (number, case)));
            }
        }
        let named = self.only.as_ref().or(choice.swarm.as_ref()).or(choice.circuit.as_ref());
        match (named, files) {
            (Some(name), [first, ..]) if cases.is_empty() => Err(unknown_run(first, name).into()),
            _ => Ok(cases),
        }
    }
}

fn load(session: &mut Session, path: &Path) -> Result<Arc<Checked>, Failure> {
    let file = session.open(source_path(path)?)?;
    if file.program.tests.is_empty() {
        return Err(runs::wording::no_test(&file.path).into());
    }
    Ok(file)
}

fn run_cases(
    session: &Session,
    cases: &[Numbered],
    files: &[Arc<Checked>],
    queue: &QueueArguments,
    checkpoints: Option<&Path>,
    interrupt: &Interrupt,
    context: &mut Context,
) -> Result<Vec<TestVerdict>, Failure> {
    let bar = Arc::new(Progress::new("testing", cases.iter().map(|(_, case)| case.work()).sum()));
    let shown = Arc::clone(&bar);
    let workers = queue.open(interrupt, move |note| shown.note(note))?;
    // The trace is dropped, because it is large and not needed.
    let run = |place: usize, (file, case): &Numbered| {
        // After an interruption circuits are compiled with little effort, so their tests are not begun.
        if interrupt.is_raised() {
            return Ok(None);
        }
        // A test without a swarm is run here.
        let there = workers.as_ref().and_then(|workers| Some((workers, case.task()?)));
        let run = match there {
            Some((workers, task)) => {
                let observe = || bar.add(case.work());
                let Some(mut results) = workers.perform(place, &[Task::Swarm(Box::new(task))], &observe) else {
                    return Ok(None);
                };
                let result = results.pop().map(TaskResult::bits);
                case.clone().judge(&result.expect("a result for each task"))
            }
            None => {
                let name = format!("test-{}", place + 1);
                let keeper = checkpoints.map(|folder| Keeper::new(folder, &name));
                let mut observer = Keeping { observer: interrupt.observe(bar.part()), keeper };
                let run = session.run_case(case.clone(), &mut observer);
                if let Some(fault) = observer.keeper.and_then(|keeper| keeper.fault) {
                    return Err(fault);
                }
                run
            }
        };
        Ok((run.end == RunEnd::Complete).then_some((*file, run.verdict, run.warnings)))
    };
    let (mut verdicts, mut warned) = (Vec::new(), BTreeSet::new());
    let mut tell = |done: Result<Option<(usize, TestVerdict, Vec<Diagnostic>)>, Diagnostic>| -> Result<(), Failure> {
        let Some((file, verdict, mut warnings)) = done? else { return Ok(()) };
        warnings.retain(|warning| warned.insert((file, warning.code, warning.message.clone())));
        context.warn(&files[file], &warnings);
        if context.format == OutputFormat::Text {
            context.print_verdicts(&report::describe_verdict(&verdict))?;
            context.flush()?;
        }
        verdicts.push(verdict);
        Ok(())
    };
    in_order(threads(workers.as_ref()), cases, run, |judged| bar.suspend(|| tell(judged)))?;
    queue::end(workers)?;
    Ok(verdicts)
}
