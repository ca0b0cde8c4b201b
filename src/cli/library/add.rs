//! `nbc library add`: the best gates of evolution runs as robot files.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use serde::Serialize;

use crate::cli::evolution_folder::{CHECKPOINT, checkpoints, read_checkpoint};
use crate::cli::evolve::wording::EvolveError;
use crate::cli::in_order::in_order;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::queue::QueueArguments;
use crate::cli::robots::behavior;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::{Context, Failure, OutputFormat, Progress, Status};
use nbc_base::model::{Axis, Behavior, Provenance, Robot};
use nbc_session::report::{Answer, Schema};
use nbc_session::store::{self, Checkpoint, ResultPlace};
use nbc_swarm::evolve::{self, Elite};
use nbc_swarm::{RobotCandidate, Selected, Selection};

/// Measure the best gates of evolution runs and write them as robot files
#[derive(Args)]
#[command(after_help = "Examples:
  nbc library add out/gates5/seed-1 --into library/robots --behavior RRRL --behavior RRLL
  nbc library add out/gates5 --into robots --max-error 0.01     the runs of all seeds
  nbc library add out/gates5/seed-1 --into robots --behavior not

The output shows for each behavior the robot that was added, or why there is none.
Exit status: 0 done, 1 if there is no robot for a behavior named by --behavior, or none at all, 2 bad input.")]
pub struct AddArguments {
    /// Folders of runs, each of one seed or of all seeds of an evolution
    #[arg(required = true)]
    runs: Vec<PathBuf>,
    /// The folder for robot files
    #[arg(long, value_name = "DIR")]
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
    /// Highest accepted error rate over the measured switches, from 0 to 1
    #[arg(long, value_name = "SHARE", default_value = "0", value_parser = share)]
    max_error: f64,
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
struct Answers<'a> {
    folder: &'a Path,
    answers: Vec<Answer>,
}

impl AddArguments {
    /// Selects, measures and writes robots.
    ///
    /// # Errors
    /// When a run has no checkpoint, the server cannot be used, or a file cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let selection = self.selection();
        let asked = self.asked(&selection)?;
        let into = ResultPlace::new(Some(&self.into), &self.into, "");
        into.probe().map_err(|error| Failure::unwritable(&self.into, &error))?;
        let work = asked.iter().map(|(_, candidates)| selection.cost(candidates.len())).sum();
        let bar = Arc::new(Progress::new("measuring", work));
        let tasks = TaskExecutor::choose(self.device, &self.queue, &bar, context)?;
        let select = |place: usize, (behavior, candidates): &(Behavior, Vec<RobotCandidate>)| {
            (*behavior, selection.select(tasks.executor(), place, *behavior, candidates, &|more| bar.add(more)))
        };
        let mut answers = Vec::new();
        let mut tell = |(behavior, selected): (Behavior, Option<Selected>)| {
            let Some(selected) = selected else { return Ok(()) };
            if let Selected::Robot(robot) = &selected {
                write(&self.into, robot)?;
            }
            let answer = Answer::of(behavior, &selected, self.max_error);
            if context.format == OutputFormat::Text {
                context.print(&answer)?;
                context.flush()?;
            }
            answers.push(answer);
            Ok::<(), Failure>(())
        };
        in_order(tasks.threads(), &asked, select, |selected| bar.suspend(|| tell(selected)))?;
        drop(bar);
        let stopped = tasks.is_stopped();
        tasks.end(context)?;
        if stopped { Ok(Status::Interrupted) } else { self.end(answers, context) }
    }

    /// Prints the summary and returns the exit status.
    fn end(&self, answers: Vec<Answer>, context: &mut Context) -> Result<Status, Failure> {
        let (asked, added) = (answers.len(), answers.iter().filter(|answer| answer.is_added()).count());
        match context.format {
            OutputFormat::Json => context.print_json(Schema::Added, &Answers { folder: &self.into, answers })?,
            OutputFormat::Text => {
                let folder = self.into.display();
                context.print(format_args!("{added} of {asked} behaviors have a robot in {folder}\n"))?;
            }
        }
        let missed = if self.behavior.is_empty() { added == 0 } else { added < asked };
        Ok(if missed { Status::TestFailed } else { Status::Done })
    }

    /// The checkpoints of the runs, each once.
    fn checkpoints(&self) -> Result<BTreeSet<PathBuf>, Failure> {
        let mut found = BTreeSet::new();
        for folder in &self.runs {
            let seeds = checkpoints(folder);
            if seeds.is_empty() {
                return Err(missing(&folder.join(CHECKPOINT)));
            }
            found.extend(seeds);
        }
        Ok(found)
    }

    fn selection(&self) -> Selection {
        let Self { max_error, wide_margin, .. } = *self;
        Selection { tries: self.tries as usize, finalists: self.finalists as usize, max_error, wide_margin }
    }

    /// The requested behaviors, in order of their functions, with the elites to screen. An archive of classes has an
    /// elite for all behaviors of its class.
    fn asked(&self, selection: &Selection) -> Result<Vec<(Behavior, Vec<RobotCandidate>)>, Failure> {
        let mut candidates: BTreeMap<Behavior, Vec<RobotCandidate>> =
            self.behavior.iter().map(|&behavior| (behavior, Vec::new())).collect();
        for path in self.checkpoints()? {
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
        Ok(asked)
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
