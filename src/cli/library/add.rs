//! `nbc library add`: the best gates of evolution runs, and robots written by hand, as robot files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use serde::Serialize;

use crate::cli::evolution_folder::{CHECKPOINT, checkpoints, read_checkpoint};
use crate::cli::evolve::wording::EvolveError;
use crate::cli::in_order::in_order;
use crate::cli::library::measured::Measured;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::options::queue::QueueArguments;
use crate::cli::robots::behavior;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::wording::UsageError;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Progress, Status};
use nbc_base::budget::Limit;
use nbc_base::diag::{Diagnostic, counted};
use nbc_base::model::{Axis, Behavior, Body, Genotype, Provenance, Robot};
use nbc_base::source::Sources;
use nbc_session::report::{Answer, Schema};
use nbc_session::store::{self, Checkpoint, DiskWorld, ResultPlace};
use nbc_swarm::evolve::{self, Elite};
use nbc_swarm::{Executor, MEASUREMENT_COST, Measurement, RobotCandidate, Selected, Selection, Task};

/// Measure the best gates of evolution runs, or robots of your own, and write them as robot files
#[derive(Args)]
#[command(after_help = "Examples:
  nbc library add out/gates5/seed-1 --into library/robots --behavior RRRL --behavior RRLL
  nbc library add out/gates5 --into robots --max-error 0.01     the runs of all seeds
  nbc library add out/gates5/seed-1 --into robots --behavior not
  nbc library add mine.yaml --into robots                       a body that you wrote

The output shows for each behavior the robot that was added, or why there is none. A robot of your own has the name \
of its file. After Ctrl-C, the same command goes on with what it has measured.
Exit status: 0 done, 1 if there is no robot for a behavior named by --behavior, or for a file, or none at all, 2 bad \
input, 4 interrupted.")]
pub struct AddArguments {
    /// Folders of runs, each of one seed or of all seeds of an evolution, and files with a body
    #[arg(required = true, value_name = "RUN")]
    runs: Vec<PathBuf>,
    /// The folder for robot files
    #[arg(long, value_name = "DIR", value_parser = new_path())]
    into: PathBuf,
    /// Add only this behavior, such as `RRRL` or its function `nand`; may be given several times
    #[arg(long, value_name = "BEHAVIOR", value_parser = behavior)]
    behavior: Vec<Behavior>,
    /// Number of elites of each behavior that are screened
    #[arg(long, value_name = "N", default_value = "8", value_parser = clap::value_parser!(u32).range(1..))]
    tries: u32,
    /// Number of these that are measured in full
    #[arg(long, value_name = "N", default_value = "2", value_parser = clap::value_parser!(u32).range(1..))]
    finalists: u32,
    /// Highest accepted error rate over the measured switches, from 0 to 1 [default: 0; of robots of your own, any]
    #[arg(long, value_name = "SHARE", value_parser = share)]
    max_error: Option<f64>,
    /// Prefer robots with at least this margin to quicker ones with less, in voxels per cycle
    #[arg(long, value_name = "VOXELS", default_value = "0")]
    wide_margin: f64,
    #[command(flatten)]
    device: DeviceArguments,
    #[command(flatten)]
    queue: QueueArguments,
}

/// The output as JSON.
#[derive(Serialize)]
struct Answers {
    folder: String,
    answers: Vec<Answer>,
}

/// What is to be measured.
enum Asked {
    /// The best robot of a behavior among candidates.
    Behavior(Behavior, Vec<RobotCandidate>),
    /// A body in a file, and the highest accepted error rate.
    Own { own: Box<OwnRobot>, max_error: f64 },
}

/// A body in a file, which becomes a robot with the name of the file.
#[derive(Clone)]
struct OwnRobot {
    path: PathBuf,
    name: String,
    body: Body,
    provenance: Provenance,
    genotype: Option<Genotype>,
}

/// What was asked for.
enum Wanted {
    Behavior(Behavior),
    Own(PathBuf),
}

/// What was found for it.
struct Found {
    wanted: Wanted,
    selected: Selected,
}

impl AddArguments {
    /// Selects, measures and writes robots.
    ///
    /// # Errors
    /// When a run has no checkpoint, a body cannot be read, the server cannot be used, or a file cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let selection = self.selection();
        let asked = self.asked(&selection)?;
        let into = ResultPlace::new(Some(&self.into), &self.into, "");
        into.probe().map_err(|error| Failure::unwritable(&self.into, &error))?;
        let work = asked.iter().map(|asked| asked.cost(&selection)).sum();
        let bar = Arc::new(Progress::new("measuring", work));
        let interrupt = Interrupt::watch()?;
        let tasks = TaskExecutor::choose(self.device, &self.queue, &interrupt, &bar, context)?;
        let measured = Measured::open(&self.into, tasks.executor(), tasks.is_elsewhere(), &interrupt);
        if measured.len() > 0 {
            context.log(&format!("{} known from an earlier command\n", counted(measured.len(), "result")));
        }
        let select = |place: usize, asked: &Asked| asked.select(&selection, &measured, place, &|more| bar.add(more));
        let mut answers = Vec::new();
        let mut tell = |found: Option<Found>| {
            let Some(found) = found else { return Ok(()) };
            if let Selected::Robot(robot) = &found.selected {
                write(&self.into, robot)?;
            }
            let answer = found.answer(self.max_error.unwrap_or(0.0))?;
            if context.format == OutputFormat::Text {
                context.print(&answer)?;
                context.flush()?;
            }
            answers.push(answer);
            Ok::<(), Failure>(())
        };
        let made = in_order(tasks.threads(), &asked, select, |found| bar.suspend(|| tell(found)));
        drop(bar);
        let is_complete = made.is_ok() && answers.len() == asked.len();
        measured.end(is_complete)?;
        made?;
        tasks.end(context)?;
        if !is_complete {
            let (done, all) = (answers.len(), asked.len());
            context.log(&format!("interrupted: {done} of {all} complete; the same command goes on from here\n"));
            return Ok(Status::Interrupted);
        }
        self.end(answers, context)
    }

    /// Prints the summary and returns the exit status.
    fn end(&self, answers: Vec<Answer>, context: &mut Context) -> Result<Status, Failure> {
        let (asked, added) = (answers.len(), answers.iter().filter(|answer| answer.is_added()).count());
        match context.format {
            OutputFormat::Json => {
                context.print_json(Schema::Added, &Answers { folder: self.into.display().to_string(), answers })?
            }
            OutputFormat::Text => {
                let folder = self.into.display();
                let (noun, are, have) = if self.files().next().is_some() {
                    ("robot", "was added to", "were added to")
                } else {
                    ("behavior", "has a robot in", "have a robot in")
                };
                let (asked, does) = (counted(asked, noun), if asked == 1 { are } else { have });
                context.print(format_args!("{added} of {asked} {does} {folder}\n"))?;
            }
        }
        let is_each_wanted = !self.behavior.is_empty() || self.files().next().is_some();
        let missed = if is_each_wanted { added < asked } else { added == 0 };
        Ok(if missed { Status::TestFailed } else { Status::Done })
    }

    /// The checkpoints of the runs, each once.
    fn checkpoints(&self) -> Result<BTreeSet<PathBuf>, Failure> {
        let mut found = BTreeSet::new();
        for folder in self.runs.iter().filter(|path| !path.is_file()) {
            let seeds = checkpoints(folder);
            if seeds.is_empty() {
                return Err(missing(&folder.join(CHECKPOINT)));
            }
            found.extend(seeds);
        }
        Ok(found)
    }

    fn selection(&self) -> Selection {
        let (max_error, wide_margin) = (self.max_error.unwrap_or(0.0), self.wide_margin);
        Selection { tries: self.tries as usize, finalists: self.finalists as usize, max_error, wide_margin }
    }

    /// The files with bodies.
    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.runs.iter().filter(|path| path.is_file())
    }

    /// What is to be measured: the bodies in files, and the requested behaviors of runs.
    fn asked(&self, selection: &Selection) -> Result<Vec<Asked>, Failure> {
        let own = self.files().map(|path| own_robot(path)).collect::<Result<Vec<_>, _>>()?;
        for (at, robot) in own.iter().enumerate() {
            if own[..at].iter().any(|other| other.name == robot.name) {
                return Err(UsageError::SameRobot { name: robot.name.clone() }.into());
            }
        }
        if !own.is_empty() && !self.behavior.is_empty() && own.len() == self.runs.len() {
            return Err(UsageError::BehaviorOfFile.into());
        }
        let max_error = self.max_error.unwrap_or(1.0);
        let own = own.into_iter().map(|robot| Asked::Own { own: Box::new(robot), max_error });
        Ok(own.chain(self.asked_of_runs(selection)?).collect())
    }

    /// The requested behaviors, in order of their functions, with the elites to screen. An archive of classes has an
    /// elite for all behaviors of its class.
    fn asked_of_runs(&self, selection: &Selection) -> Result<Vec<Asked>, Failure> {
        let checkpoints = self.checkpoints()?;
        if checkpoints.is_empty() {
            return Ok(Vec::new());
        }
        let mut candidates: BTreeMap<Behavior, Vec<RobotCandidate>> =
            self.behavior.iter().map(|&behavior| (behavior, Vec::new())).collect();
        for path in checkpoints {
            let checkpoint = read_checkpoint(&path)?.ok_or_else(|| missing(&path))?;
            if self.behavior.is_empty() {
                for behavior in Behavior::all(checkpoint.declared.palette.inputs()).filter(|one| is_usual(*one)) {
                    candidates.entry(behavior).or_default();
                }
            }
            let has_classes = checkpoint.declared.axes.contains(&Axis::Class);
            for elite in checkpoint.state.niches.iter().flat_map(|(_, elites)| elites) {
                let shown = if has_classes { evolve::images(elite) } else { vec![elite.clone()] };
                for elite in shown {
                    if let Some(found) = candidates.get_mut(&elite.behavior) {
                        let provenance = provenance(&checkpoint, &elite);
                        found.push(RobotCandidate { elite, provenance });
                    }
                }
            }
        }
        let mut asked: Vec<_> =
            candidates.into_iter().map(|(behavior, found)| (behavior, selection.candidates_of(found))).collect();
        asked.sort_by_key(|(behavior, _)| behavior.function());
        Ok(asked.into_iter().map(|(behavior, candidates)| Asked::Behavior(behavior, candidates)).collect())
    }
}

impl Asked {
    /// The amount of work, as [`Selection::cost`].
    fn cost(&self, selection: &Selection) -> u64 {
        match self {
            Self::Behavior(_, candidates) => selection.cost(candidates.len()),
            Self::Own { .. } => MEASUREMENT_COST,
        }
    }

    /// The best robot, measured; `None` if the work was stopped.
    fn select(
        &self,
        selection: &Selection,
        executor: &dyn Executor,
        run: usize,
        observe: &dyn Fn(u64),
    ) -> Option<Found> {
        match self {
            Self::Behavior(behavior, candidates) => {
                let selected = selection.select(executor, run, *behavior, candidates, observe)?;
                Some(Found { wanted: Wanted::Behavior(*behavior), selected })
            }
            Self::Own { own, max_error } => {
                let task = Task::Measurement(own.body.clone());
                let measured = executor.perform(run, &[task], &|| observe(MEASUREMENT_COST))?.pop()?.measured();
                let selected = match measured {
                    Err(fault) => Selected::Faulty(fault),
                    Ok(measurement) => {
                        let robot = Box::new(own.measured(measurement));
                        let is_right = robot.character.error_rate <= *max_error;
                        if is_right { Selected::Robot(robot) } else { Selected::Erring(robot) }
                    }
                };
                Some(Found { wanted: Wanted::Own(own.path.clone()), selected })
            }
        }
    }
}

impl Found {
    /// The answer for the output.
    ///
    /// # Errors
    /// When the simulation of a body in a file failed: it has no behavior.
    fn answer(&self, max_error: f64) -> Result<Answer, Failure> {
        let behavior = match (&self.wanted, &self.selected) {
            (Wanted::Behavior(behavior), _) => *behavior,
            (_, Selected::Robot(robot) | Selected::Erring(robot)) => robot.behavior,
            (Wanted::Own(path), Selected::Faulty(fault)) => {
                return Err(UsageError::Unstable { path: path.display().to_string(), env_step: fault.env_step }.into());
            }
            (Wanted::Own(_), Selected::Other(_) | Selected::Missing) => unreachable!("any behavior is right"),
        };
        Ok(Answer::of(behavior, &self.selected, max_error))
    }
}

impl OwnRobot {
    /// The robot with its measurements.
    fn measured(&self, Measurement { displacement, behavior, character }: Measurement) -> Robot {
        let Self { name, body, provenance, genotype, .. } = self.clone();
        Robot { name, behavior, body, displacement, character, provenance, genotype }
    }
}

/// The body in a file that somebody wrote, or in a robot file.
fn own_robot(path: &Path) -> Result<OwnRobot, Failure> {
    let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default().to_owned();
    if !store::is_robot_name(&name) {
        return Err(UsageError::RobotName { path: path.display().to_string() }.into());
    }
    let shown = path.display().to_string();
    let text = store::read_text(path, Limit::RobotBytes.most());
    let text = text.map_err(|error| Failure::plain(Diagnostic::unreadable_in(&DiskWorld, &shown, &error)))?;
    let mut sources = Sources::default();
    let is_robot = text.lines().any(|line| line.starts_with("format:"));
    let id = sources.add(&shown, text);
    let path = path.to_owned();
    let read = if is_robot {
        store::read_robot(sources.file(id)).map(|robot| {
            let Robot { body, provenance, genotype, .. } = robot;
            OwnRobot { path, name, body, provenance, genotype }
        })
    } else {
        store::read_body(sources.file(id)).map(|body| OwnRobot {
            path,
            name,
            body,
            provenance: by_hand(),
            genotype: None,
        })
    };
    read.map_err(|fault| Failure::input(vec![fault], sources))
}

/// The provenance of a body that no run made.
fn by_hand() -> Provenance {
    Provenance {
        program: nbc_base::PROGRAM.to_owned(),
        version: nbc_base::VERSION.to_owned(),
        evolution: "by hand".to_owned(),
        seed: 0,
        generation: 0,
        evaluations: 0,
    }
}

/// Whether a behavior is asked for if none is named: all of two stimuli; of those of three, those that depend on all of
/// them, and one of each that differ in the order of their stimuli.
fn is_usual(behavior: Behavior) -> bool {
    let function = behavior.function();
    behavior.stimuli() == 2 || function.arity() == 3 && function.arranged() == function
}

/// A share between 0 and 1.
fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "expected a number from 0 to 1, such as 0.01 for one per cent".to_owned())
}

fn provenance(checkpoint: &Checkpoint, elite: &Elite) -> Provenance {
    Provenance {
        program: nbc_base::PROGRAM.to_owned(),
        version: checkpoint.version.clone(),
        evolution: checkpoint.declared.name.clone(),
        seed: checkpoint.state.seed,
        generation: elite.generation,
        evaluations: elite.evaluations,
    }
}

fn write(folder: &Path, robot: &Robot) -> Result<(), Failure> {
    let path = folder.join(format!("{}.yaml", robot.name));
    let text = store::print_robot(robot);
    let written = store::create_folder(folder).and_then(|()| store::write_result(&path, text.as_bytes()));
    written.map_err(|error| Failure::unwritable(&path, &error))
}

fn missing(path: &Path) -> Failure {
    EvolveError::NoCheckpoint { path: path.display().to_string() }.into()
}
