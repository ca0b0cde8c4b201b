//! A run of an evolution in its folder: its checkpoint, its progress, its summary.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::cli::Failure;
use crate::cli::context;
use crate::cli::evolution_folder::{CHECKPOINT, PROGRESS, read_checkpoint, read_progress};
use crate::cli::evolve::arguments::EvolveArguments;
use crate::cli::evolve::wording;
use crate::cli::options::timings::{TimedStage, Timer};
use nbc_base::diag::{Diagnostic, counted};
use nbc_base::model::Evolution;
use nbc_session::EvolutionRun;
use nbc_session::report::{EvolutionLine, History, evolution_table};
use nbc_session::store::{self, FolderLock, LockFault};
use nbc_swarm::evolve::Candidate;
use nbc_swarm::{Task, TaskResult, Work};

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Ended {
    run: String,
    seed: u64,
    folder: String,
    finished: bool,
    seconds: f64,
    #[serde(flatten)]
    line: EvolutionLine,
}

pub(super) struct RunFolder<'a> {
    run: EvolutionRun,
    /// Being evaluated.
    candidates: Vec<Candidate>,
    timer: &'a Timer,
    folder: PathBuf,
    checkpoint_every: Duration,
    started: Instant,
    saved: Instant,
    /// Made before this program took over.
    evaluations_before: u64,
    work_before: Work,
    /// Seconds spent on parents, mutation, development and the archive.
    searching: f64,
    _lock: FolderLock,
}

impl<'a> RunFolder<'a> {
    /// A new run, or one that continues from its checkpoint. `warn` shows what is wrong with its history.
    pub(super) fn open(
        arguments: &EvolveArguments,
        evolution: &Evolution,
        seed: u64,
        timer: &'a Timer,
        warn: &dyn Fn(Diagnostic),
    ) -> Result<Self, Failure> {
        let folder = arguments.folder(Path::new(&evolution.name).join(format!("seed-{seed}")));
        let folder = folder.create().map_err(|error| Failure::unwritable(&folder.path(), &error))?;
        let _lock = store::lock_folder(&folder).map_err(|fault| not_ours(&folder, fault))?;
        let path = folder.join(CHECKPOINT);
        let run = match read_checkpoint(&path)? {
            None => EvolutionRun::new(evolution, seed),
            Some(_) if !arguments.resume => return Err(wording::has_run(&path).into()),
            Some(checkpoint) => {
                let (done, before) = (checkpoint.state.generation, checkpoint.declared.generations);
                context::log(&wording::resumed_until(&folder, done, before, evolution.generations));
                EvolutionRun::resume(checkpoint, &path.display().to_string(), evolution, seed)?
            }
        };
        let opened = Self {
            evaluations_before: run.search().counts().evaluations,
            work_before: run.work(),
            run,
            candidates: Vec::new(),
            timer,
            folder,
            checkpoint_every: Duration::from_secs(arguments.checkpoint_every),
            started: Instant::now(),
            saved: Instant::now(),
            searching: 0.0,
            _lock,
        };
        opened.trim_progress(warn)?;
        Ok(opened)
    }

    pub(super) fn run(&self) -> &EvolutionRun {
        &self.run
    }

    pub(super) fn is_done(&self) -> bool {
        self.run.search().is_done()
    }

    pub(super) fn ask(&mut self) -> Vec<Task> {
        let started = Instant::now();
        self.candidates = self.timer.time(TimedStage::Development, || self.run.search().ask());
        let tasks = self.timer.time(TimedStage::Archive, || self.run.tasks(&self.candidates));
        self.searching += started.elapsed().as_secs_f64();
        tasks
    }

    /// Takes the results in order of the candidates, and writes a checkpoint if one is due. Returns a note for the
    /// progress display.
    pub(super) fn tell(&mut self, results: Vec<TaskResult>) -> Result<String, Failure> {
        let (candidates, started) = (std::mem::take(&mut self.candidates), Instant::now());
        let line = self.timer.time(TimedStage::Archive, || self.run.tell(&candidates, results));
        self.searching += started.elapsed().as_secs_f64();
        self.timer.time(TimedStage::Output, || self.append(&line))?;
        if self.saved.elapsed() >= self.checkpoint_every {
            self.save_timed()?;
            self.saved = Instant::now();
        }
        Ok(self.message(&line))
    }

    pub(super) fn save_timed(&self) -> Result<(), Failure> {
        self.timer.time(TimedStage::Output, || self.save())
    }

    fn save(&self) -> Result<(), Failure> {
        let path = self.folder.join(CHECKPOINT);
        store::write_result(&path, &self.run.checkpoint()).map_err(|error| Failure::unwritable(&path, &error))
    }

    fn append(&self, line: &EvolutionLine) -> Result<(), Failure> {
        let path = self.folder.join(PROGRESS);
        let text = serde_json::to_string(line).expect("a line can be written as JSON") + "\n";
        let open = fs::OpenOptions::new().create(true).append(true).open(&path);
        open.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| Failure::unwritable(&path, &error))
    }

    /// Drops the lines of generations after the checkpoint, which will be made again. A damaged file is set aside and
    /// reported.
    fn trim_progress(&self, warn: &dyn Fn(Diagnostic)) -> Result<(), Failure> {
        let write = |path: &Path, bytes: &[u8]| {
            store::write_result(path, bytes).map_err(|error| Failure::unwritable(path, &error))
        };
        let path = self.folder.join(PROGRESS);
        let bytes = read_progress(&path)?;
        let text = String::from_utf8_lossy(&bytes);
        let history = History::read(&text, self.run.search().generation());
        if let Some(damage) = history.damage() {
            let aside = path.with_extension("jsonl.damaged");
            let kept = (!bytes.is_empty()).then_some(aside.as_path());
            kept.map_or(Ok(()), |aside| write(aside, &bytes))?;
            warn(wording::gaps_in_run(&path, &damage, kept));
        }
        write(&path, history.print().as_bytes())
    }

    fn message(&self, line: &EvolutionLine) -> String {
        let made = (line.counts.evaluations - self.evaluations_before) as f64;
        let rate = made / self.started.elapsed().as_secs_f64().max(1e-9);
        let behaviors = counted(line.behaviors, "behavior");
        format!("{rate:.1} evaluations/s, {behaviors}, {:.1} % of niches", 100.0 * line.coverage)
    }

    pub(super) fn ended(&self, finished: bool) -> Ended {
        Ended {
            run: self.run.search().evolution().name.clone(),
            seed: self.run.search().seed(),
            folder: self.folder.display().to_string(),
            finished,
            seconds: self.started.elapsed().as_secs_f64(),
            line: self.run.line(),
        }
    }

    pub(super) fn summary(&self, finished: bool) -> String {
        let Ended { run, seed, folder, .. } = self.ended(finished);
        let table = evolution_table(self.run.search(), self.run.work());
        let left = if finished { "" } else { "interrupted; `--resume` continues the run\n" };
        let speed = self.speed();
        format!("{run}, seed {seed}\n{table}{speed}results in {folder}\n{left}\n")
    }

    /// Since this program took over; empty if there was nothing left to do.
    fn speed(&self) -> String {
        let seconds = self.started.elapsed().as_secs_f64().max(1e-9);
        let rate = (self.run.search().counts().evaluations - self.evaluations_before) as f64 / seconds;
        let work = self.run.work();
        let simulated = (work.env_steps - self.work_before.env_steps) as f64;
        let left_out = (work.left_out - self.work_before.left_out) as f64;
        if simulated == 0.0 {
            return String::new();
        }
        let in_full = rate * simulated / (simulated + left_out);
        let search = 100.0 * self.searching / seconds;
        format!(
            "{seconds:.1} s, {rate:.1} evaluations/s, {in_full:.1} full evaluations/s; {search:.2} \
             % of the time for archive, development and mutation\n"
        )
    }
}

fn not_ours(folder: &Path, fault: LockFault) -> Failure {
    match fault {
        LockFault::Held { process } => wording::held_folder(folder, process).into(),
        LockFault::Io(error) => Failure::unwritable(&folder.join("lock"), &error),
    }
}
