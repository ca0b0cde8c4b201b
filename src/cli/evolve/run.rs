//! One declaration with one seed, in its folder: its checkpoint, its progress, its summary.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::cli::Failure;
use crate::cli::context;
use crate::cli::evolution_folder::{CHECKPOINT, PROGRESS, read_checkpoint, read_progress};
use crate::cli::evolve::arguments::EvolveArguments;
use crate::cli::evolve::wording::{EvolveError, ProgressGaps, ResumedUntil};
use crate::cli::options::timings::{TimedStage, Timer};
use nbc_base::diag::counted;
use nbc_base::model::Evolution;
use nbc_session::report::{EvolutionLine, History, evolution_table};
use nbc_session::store::{self, Checkpoint, FolderLock, LockFault};
use nbc_swarm::evolve::{ArchiveStats, Candidate, CandidateOutcome, Search};
use nbc_swarm::{Evaluated, EvaluationProtocol, EvaluationTask, Task, TaskResult, Work};

/// How one run ended.
#[derive(Serialize)]
pub(super) struct Ended {
    run: String,
    seed: u64,
    folder: String,
    finished: bool,
    seconds: f64,
    #[serde(flatten)]
    line: EvolutionLine,
}

/// One declaration with one seed, in its folder.
pub(super) struct EvolutionRun<'a> {
    search: Search,
    /// The candidates that are being evaluated.
    candidates: Vec<Candidate>,
    timer: &'a Timer,
    work: Work,
    folder: PathBuf,
    checkpoint_every: Duration,
    started: Instant,
    saved: Instant,
    /// Evaluations and work made before this program took over.
    evaluations_before: u64,
    work_before: Work,
    /// Seconds spent on asking and telling: parents, mutation, development, the archive.
    searching: f64,
    _lock: FolderLock,
}

impl<'a> EvolutionRun<'a> {
    /// A new run, or one that continues from its checkpoint. `warn` shows what is wrong with its history.
    ///
    /// # Errors
    /// When its folder is in use by another process, contains a run without `--resume`, or cannot be used.
    pub(super) fn open(
        arguments: &EvolveArguments,
        evolution: &Evolution,
        seed: u64,
        timer: &'a Timer,
        warn: &dyn Fn(ProgressGaps),
    ) -> Result<Self, Failure> {
        let folder = arguments.folder(Path::new(&evolution.name).join(format!("seed-{seed}")));
        let folder = folder.create().map_err(|error| Failure::unwritable(&folder.path(), &error))?;
        let _lock = store::lock_folder(&folder).map_err(|fault| not_ours(&folder, fault))?;
        let path = folder.join(CHECKPOINT);
        let (search, work) = match read_checkpoint(&path)? {
            None => (Search::new(evolution, seed), Work::default()),
            Some(_) if !arguments.resume => return Err(would_overwrite(&path)),
            Some(checkpoint) => {
                let until = ResumedUntil {
                    folder: folder.display().to_string(),
                    done: checkpoint.state.generation,
                    before: checkpoint.declared.generations(),
                    now: evolution.generations,
                };
                context::log(&until.text());
                let work = Work { env_steps: checkpoint.env_steps, left_out: checkpoint.left_out };
                let resumed = checkpoint.resume(&path.display().to_string(), evolution, seed);
                (resumed.map_err(Failure::plain)?, work)
            }
        };
        let evaluations_before = search.counts().evaluations;
        let run = Self {
            search,
            candidates: Vec::new(),
            timer,
            work,
            folder,
            checkpoint_every: Duration::from_secs(arguments.checkpoint_every),
            started: Instant::now(),
            saved: Instant::now(),
            evaluations_before,
            work_before: work,
            searching: 0.0,
            _lock,
        };
        run.trim_progress(warn)?;
        Ok(run)
    }

    /// Whether the archive has a robot.
    pub(super) fn has_robots(&self) -> bool {
        self.search.archive().elites().next().is_some()
    }

    /// Generations done.
    pub(super) fn generation(&self) -> u32 {
        self.search.generation()
    }

    /// Whether all generations are done.
    pub(super) fn is_done(&self) -> bool {
        self.search.is_done()
    }

    /// The tasks of the next generation. The time of everything except simulation is counted.
    pub(super) fn ask(&mut self) -> Vec<Task> {
        let started = Instant::now();
        self.candidates = self.timer.time(TimedStage::Development, || self.search.ask());
        let protocol = Arc::new(EvaluationProtocol::of(self.search.evolution()));
        let task = |candidate: &Candidate| {
            Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(&self.search, candidate))
        };
        let tasks = self.timer.time(TimedStage::Archive, || self.candidates.iter().map(task).collect());
        self.searching += started.elapsed().as_secs_f64();
        tasks
    }

    /// Takes the results of a generation, in order of its candidates, and writes a checkpoint if one is due. Returns a
    /// note for the progress display.
    pub(super) fn tell(&mut self, results: Vec<TaskResult>) -> Result<String, Failure> {
        let results: Vec<Evaluated> = results.into_iter().map(TaskResult::evaluated).collect();
        let outcomes: Vec<CandidateOutcome> = results.iter().map(|evaluated| evaluated.outcome).collect();
        let (candidates, started) = (std::mem::take(&mut self.candidates), Instant::now());
        self.timer.time(TimedStage::Archive, || self.search.tell(&candidates, &outcomes));
        self.searching += started.elapsed().as_secs_f64();
        self.work = results.iter().fold(self.work, |sum, evaluated| sum.plus(evaluated.work));
        let line = EvolutionLine::of(&self.search, self.work);
        self.timer.time(TimedStage::Output, || self.append(&line))?;
        if self.saved.elapsed() >= self.checkpoint_every {
            self.save_timed()?;
            self.saved = Instant::now();
        }
        Ok(self.message(&line))
    }

    /// Writes a checkpoint.
    pub(super) fn save_timed(&self) -> Result<(), Failure> {
        self.timer.time(TimedStage::Output, || self.save())
    }

    fn save(&self) -> Result<(), Failure> {
        let path = self.folder.join(CHECKPOINT);
        let bytes = Checkpoint::print(&self.search, self.work.env_steps, self.work.left_out);
        store::write_result(&path, &bytes).map_err(|error| Failure::unwritable(&path, &error))
    }

    fn append(&self, line: &EvolutionLine) -> Result<(), Failure> {
        let path = self.folder.join(PROGRESS);
        let text = serde_json::to_string(line).expect("a line can be written as JSON") + "\n";
        let open = fs::OpenOptions::new().create(true).append(true).open(&path);
        open.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| Failure::unwritable(&path, &error))
    }

    /// Drops the lines of generations after the checkpoint, which will be made again. A damaged file is set aside and
    /// reported.
    fn trim_progress(&self, warn: &dyn Fn(ProgressGaps)) -> Result<(), Failure> {
        let write = |path: &Path, bytes: &[u8]| {
            store::write_result(path, bytes).map_err(|error| Failure::unwritable(path, &error))
        };
        let path = self.folder.join(PROGRESS);
        let bytes = read_progress(&path)?;
        let text = String::from_utf8_lossy(&bytes);
        let history = History::read(&text, self.search.generation());
        if let Some(damage) = history.damage() {
            let aside = path.with_extension("jsonl.damaged");
            let mut kept = None;
            if !bytes.is_empty() {
                write(&aside, &bytes)?;
                kept = Some(aside.display().to_string());
            }
            warn(ProgressGaps::InRun { path: path.display().to_string(), damage, aside: kept });
        }
        write(&path, history.print().as_bytes())
    }

    fn message(&self, line: &EvolutionLine) -> String {
        let made = (line.counts.evaluations - self.evaluations_before) as f64;
        let rate = made / self.started.elapsed().as_secs_f64().max(1e-9);
        let behaviors = counted(line.behaviors, "behavior");
        format!("{rate:.1} evaluations/s, {behaviors}, {:.1} % of niches", 100.0 * line.coverage)
    }

    pub(super) fn archive_stats(&self) -> ArchiveStats {
        self.search.archive().stats()
    }

    pub(super) fn ended(&self, finished: bool) -> Ended {
        Ended {
            run: self.search.evolution().name.clone(),
            seed: self.search.seed(),
            folder: self.folder.display().to_string(),
            finished,
            seconds: self.started.elapsed().as_secs_f64(),
            line: EvolutionLine::of(&self.search, self.work),
        }
    }

    pub(super) fn summary(&self, finished: bool) -> String {
        let Ended { run, seed, folder, .. } = self.ended(finished);
        let table = evolution_table(&self.search, self.work);
        let left = if finished { "" } else { "interrupted; `--resume` continues the run\n" };
        let speed = self.speed();
        format!("{run}, seed {seed}\n{table}{speed}results in {folder}\n{left}\n")
    }

    /// The speed since this program took over; empty if there was nothing left to do.
    fn speed(&self) -> String {
        let seconds = self.started.elapsed().as_secs_f64().max(1e-9);
        let rate = (self.search.counts().evaluations - self.evaluations_before) as f64 / seconds;
        let simulated = (self.work.env_steps - self.work_before.env_steps) as f64;
        let left_out = (self.work.left_out - self.work_before.left_out) as f64;
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
        LockFault::Held { process } => EvolveError::Held { folder: folder.display().to_string(), process }.into(),
        LockFault::Io(error) => Failure::unwritable(&folder.join("lock"), &error),
    }
}

fn would_overwrite(path: &Path) -> Failure {
    EvolveError::HasRun { folder: path.display().to_string() }.into()
}
