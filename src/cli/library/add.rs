//! `nbc library add`: the best gates of evolution runs, and robots written by hand, as robot files.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use serde::Serialize;

use crate::cli::evolution_folder::{CHECKPOINT, checkpoints, read_checkpoint};
use crate::cli::evolve::wording::no_checkpoint;
use crate::cli::in_order::in_order;
use crate::cli::library::measured::Measured;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::options::queue::QueueArguments;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::wording;
use crate::cli::{Context, Failure, Interrupt, OutputFormat, Progress, Status, robots};
use nbc_base::diag::counted;
use nbc_base::model::{Behavior, Robot};
use nbc_base::source::Sources;
use nbc_session::report::{Answer, Schema};
use nbc_session::store::{self, Checkpoint, ResultPlace};
use nbc_session::{OwnBody, RobotRequest, behavior};
use nbc_swarm::{Selected, Selection};

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

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(in crate::cli) struct Answers {
    folder: String,
    answers: Vec<Answer>,
}

/// A request, with the file of its body, if it has one.
struct Asked {
    path: Option<PathBuf>,
    request: RobotRequest,
}

struct Found<'a> {
    asked: &'a Asked,
    selected: Selected,
}

impl AddArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let selection = self.selection();
        let asked = self.asked(&selection)?;
        let into = ResultPlace::new(Some(&self.into), &self.into, "");
        into.probe().map_err(|error| Failure::unwritable(&self.into, &error))?;
        let work = asked.iter().map(|asked| asked.request.cost(&selection)).sum();
        let bar = Arc::new(Progress::new("measuring", work));
        let interrupt = Interrupt::watch()?;
        let tasks = TaskExecutor::choose(self.device, &self.queue, &interrupt, &bar, context)?;
        let measured = Measured::open(&self.into, tasks.executor(), tasks.is_elsewhere(), &interrupt);
        if measured.len() > 0 {
            context.log(&format!("{} known from an earlier command\n", counted(measured.len(), "result")));
        }
        let select = |place: usize, asked: &Asked| {
            let selected = asked.request.select(&selection, &measured, place, &|more| bar.add(more))?;
            Some((place, selected))
        };
        let mut answers = Vec::new();
        let mut tell = |found: Option<(usize, Selected)>| {
            let Some((place, selected)) = found else { return Ok(()) };
            let found = Found { asked: &asked[place], selected };
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

    /// Each once.
    fn checkpoints(&self) -> Result<BTreeSet<PathBuf>, Failure> {
        let mut found = BTreeSet::new();
        for folder in self.runs.iter().filter(|path| !path.is_file()) {
            let seeds = checkpoints(folder);
            if seeds.is_empty() {
                return Err(no_checkpoint(&folder.join(CHECKPOINT)).into());
            }
            found.extend(seeds);
        }
        Ok(found)
    }

    fn selection(&self) -> Selection {
        let (max_error, wide_margin) = (self.max_error.unwrap_or(0.0), self.wide_margin);
        Selection { tries: self.tries as usize, finalists: self.finalists as usize, max_error, wide_margin }
    }

    fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.runs.iter().filter(|path| path.is_file())
    }

    /// The bodies in files, and the requested behaviors of runs.
    fn asked(&self, selection: &Selection) -> Result<Vec<Asked>, Failure> {
        let own = self.files().map(|path| self.own_body(path)).collect::<Result<Vec<_>, _>>()?;
        for (at, body) in own.iter().enumerate() {
            if own[..at].iter().any(|other| other.name == body.name) {
                return Err(wording::same_robot(&body.name).into());
            }
        }
        if !own.is_empty() && !self.behavior.is_empty() && own.len() == self.runs.len() {
            return Err(wording::behavior_of_file().into());
        }
        let of_file = |(own, path): (OwnBody, &PathBuf)| Asked {
            path: Some(path.clone()),
            request: RobotRequest::Own(Box::new(own)),
        };
        let mut asked: Vec<Asked> = own.into_iter().zip(self.files()).map(of_file).collect();
        let checkpoints = self.checkpoints()?;
        let read = |path: &PathBuf| read_checkpoint(path)?.ok_or_else(|| no_checkpoint(path).into());
        let runs = checkpoints.iter().map(read).collect::<Result<Vec<Checkpoint>, Failure>>()?;
        if !runs.is_empty() {
            let requests = RobotRequest::of_runs(&runs, &self.behavior, selection);
            asked.extend(requests.into_iter().map(|request| Asked { path: None, request }));
        }
        Ok(asked)
    }

    /// The body in a file written by hand, or in a robot file.
    fn own_body(&self, path: &Path) -> Result<OwnBody, Failure> {
        let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default().to_owned();
        if !store::is_robot_name(&name) {
            return Err(wording::robot_name(path).into());
        }
        let mut sources = Sources::default();
        let id = robots::read_source(path, &mut sources)?;
        let file = sources.file(id);
        let read = if file.text.lines().any(|line| line.starts_with("format:")) {
            store::read_robot(file).map(|robot| {
                let Robot { body, provenance, genotype, .. } = robot;
                OwnBody { provenance, genotype, ..OwnBody::by_hand(name, body) }
            })
        } else {
            store::read_body(file).map(|body| OwnBody::by_hand(name, body))
        };
        let own = read.map_err(|fault| Failure::input(vec![fault], sources))?;
        Ok(OwnBody { max_error: self.max_error.unwrap_or(own.max_error), ..own })
    }
}

impl Found<'_> {
    fn answer(&self, max_error: f64) -> Result<Answer, Failure> {
        match (self.asked.request.behavior(&self.selected), &self.selected, &self.asked.path) {
            (Some(behavior), selected, _) => Ok(Answer::of(behavior, selected, max_error)),
            (None, Selected::Faulty(fault), Some(path)) => Err(wording::unstable_body(path, fault.env_step).into()),
            (None, ..) => unreachable!("any behavior of a body is right"),
        }
    }
}

fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "expected a number from 0 to 1, such as 0.01 for one per cent".to_owned())
}

fn write(folder: &Path, robot: &Robot) -> Result<(), Failure> {
    let path = folder.join(format!("{}.yaml", robot.name));
    let text = store::print_robot(robot);
    let written = store::create_folder(folder).and_then(|()| store::write_result(&path, text.as_bytes()));
    written.map_err(|error| Failure::unwritable(&path, &error))
}
