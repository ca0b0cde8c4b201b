//! One declaration with one seed, in its folder: its checkpoint, its progress, its summary.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::cli::evolve::Arguments;
use crate::cli::timings::{self, Stage};
use crate::cli::{Failure, Interrupt, Progress};
use crate::diag::{Code, Diagnostic};
use crate::evolve::{ArchiveStats, Search};
use crate::model::Evolution;
use crate::report::{EvolutionLine, evolution_table};
use crate::sim::Simulator;
use crate::store::{self, Checkpoint};
use crate::swarm::{self, Work};

/// The file in a run's folder that it is resumed from.
pub(in crate::cli) const CHECKPOINT: &str = "checkpoint.nbc";
/// The file in a run's folder with a line for each generation.
pub(in crate::cli) const PROGRESS: &str = "progress.jsonl";

/// How one run ended.
#[derive(Serialize)]
pub(super) struct Ended {
    run: String,
    seed: u64,
    folder: PathBuf,
    finished: bool,
    seconds: f64,
    #[serde(flatten)]
    line: EvolutionLine,
}

/// One declaration with one seed, in its folder.
pub(super) struct Run {
    search: Search,
    simulator: Simulator,
    work: Work,
    folder: PathBuf,
    checkpoint_every: Duration,
    started: Instant,
    /// Evaluations and work made before this program took over.
    evaluations_before: u64,
    work_before: Work,
    /// What [`searching`] said then.
    searching_before: f64,
}

impl Run {
    /// A run that has done nothing yet, or goes on from its checkpoint.
    ///
    /// # Errors
    /// When its folder holds a run that is not to be resumed, or cannot be used.
    pub(super) fn open(arguments: &Arguments, evolution: &Evolution, seed: u64) -> Result<Self, Failure> {
        let folder = arguments.out.join(&evolution.name).join(format!("seed-{seed}"));
        store::create_folder(&folder).map_err(|error| Failure::unwritable(&folder, &error))?;
        let path = folder.join(CHECKPOINT);
        let (search, work) = match read_checkpoint(&path)? {
            None => (Search::new(evolution, seed), Work::default()),
            Some(_) if !arguments.resume => return Err(would_overwrite(&path)),
            Some(checkpoint) => {
                let work = Work { env_steps: checkpoint.env_steps, left_out: checkpoint.left_out };
                let resumed = checkpoint.resume(&path.display().to_string(), evolution, seed);
                (resumed.map_err(Failure::plain)?, work)
            }
        };
        let evaluations_before = search.counts().evaluations;
        let run = Self {
            search,
            simulator: arguments.timings.simulator(),
            work,
            folder,
            checkpoint_every: Duration::from_secs(arguments.checkpoint_every),
            started: Instant::now(),
            evaluations_before,
            work_before: work,
            searching_before: searching(),
        };
        run.trim_progress()?;
        Ok(run)
    }

    /// Makes the generations that are left; whether it got to the end.
    pub(super) fn make(&mut self, interrupt: &Interrupt) -> Result<bool, Failure> {
        let generations = u64::from(self.search.evolution().generations);
        let bar = Progress::with_template(generations, "{bar:24} {pos}/{len} generations, {msg}, {eta} left");
        let mut saved = Instant::now();
        while !self.search.is_done() && !interrupt.is_raised() {
            self.advance();
            let line = EvolutionLine::of(&self.search, self.work);
            timings::time(Stage::Output, || self.append(&line))?;
            bar.set(u64::from(line.generation));
            bar.set_message(self.message(&line));
            if saved.elapsed() >= self.checkpoint_every {
                timings::time(Stage::Output, || self.save())?;
                saved = Instant::now();
            }
        }
        timings::time(Stage::Output, || self.save())?;
        Ok(self.search.is_done())
    }

    /// One generation, with a clock on what is not simulation.
    fn advance(&mut self) {
        let candidates = timings::time(Stage::Development, || self.search.ask());
        let (outcomes, work) = swarm::evaluate(&self.simulator, &self.search, &candidates);
        timings::time(Stage::Archive, || self.search.tell(&candidates, &outcomes));
        self.work = self.work.plus(work);
    }

    fn save(&self) -> Result<(), Failure> {
        let path = self.folder.join(CHECKPOINT);
        let bytes = Checkpoint::print(&self.search, self.work.env_steps, self.work.left_out);
        store::write(&path, &bytes).map_err(|error| Failure::unwritable(&path, &error))
    }

    fn append(&self, line: &EvolutionLine) -> Result<(), Failure> {
        let path = self.folder.join(PROGRESS);
        let text = serde_json::to_string(line).expect("a line has nothing that JSON cannot say") + "\n";
        let open = fs::OpenOptions::new().create(true).append(true).open(&path);
        open.and_then(|mut file| file.write_all(text.as_bytes())).map_err(|error| Failure::unwritable(&path, &error))
    }

    /// Drops the lines of generations that come after the checkpoint and will be made again.
    fn trim_progress(&self) -> Result<(), Failure> {
        let path = self.folder.join(PROGRESS);
        let text = fs::read_to_string(&path).unwrap_or_default();
        let kept = text.lines().take(self.search.generation() as usize);
        let kept: String = kept.flat_map(|line| [line, "\n"]).collect();
        store::write(&path, kept.as_bytes()).map_err(|error| Failure::unwritable(&path, &error))
    }

    fn message(&self, line: &EvolutionLine) -> String {
        let made = (line.counts.evaluations - self.evaluations_before) as f64;
        let rate = made / self.started.elapsed().as_secs_f64().max(1e-9);
        let behaviors = line.behaviors;
        format!("{rate:.1} evaluations/s, {behaviors} behaviors, {:.1} % of niches", 100.0 * line.coverage)
    }

    pub(super) fn archive_stats(&self) -> ArchiveStats {
        self.search.archive().stats()
    }

    pub(super) fn ended(&self, finished: bool) -> Ended {
        Ended {
            run: self.search.evolution().name.clone(),
            seed: self.search.seed(),
            folder: self.folder.clone(),
            finished,
            seconds: self.started.elapsed().as_secs_f64(),
            line: EvolutionLine::of(&self.search, self.work),
        }
    }

    pub(super) fn summary(&self, finished: bool) -> String {
        let Ended { run, seed, folder, .. } = self.ended(finished);
        let table = evolution_table(&self.search, self.work);
        let left = if finished { "" } else { "interrupted; `--resume` goes on\n" };
        let (speed, folder) = (self.speed(), folder.display());
        format!("{run}, seed {seed}\n{table}{speed}results in {folder}\n{left}\n")
    }

    /// How fast it went since this program took over; nothing when there was nothing left to do.
    fn speed(&self) -> String {
        let seconds = self.started.elapsed().as_secs_f64().max(1e-9);
        let rate = (self.search.counts().evaluations - self.evaluations_before) as f64 / seconds;
        let simulated = (self.work.env_steps - self.work_before.env_steps) as f64;
        let left_out = (self.work.left_out - self.work_before.left_out) as f64;
        if simulated == 0.0 {
            return String::new();
        }
        let in_full = rate * simulated / (simulated + left_out);
        let search = 100.0 * (searching() - self.searching_before) / seconds;
        format!(
            "{seconds:.1} s, {rate:.1} evaluations/s, what was simulated making {in_full:.1} full ones/s; {search:.2} % of the time for archive, development and mutation\n"
        )
    }
}

/// Seconds that this program has spent so far on asking and telling: parents, mutation, development, the archive.
fn searching() -> f64 {
    let seconds = timings::seconds();
    seconds[Stage::Development as usize] + seconds[Stage::Archive as usize]
}

/// The checkpoint at a path, if there is one.
pub(in crate::cli) fn read_checkpoint(path: &Path) -> Result<Option<Checkpoint>, Failure> {
    match fs::read(path) {
        Ok(bytes) => Checkpoint::read(&path.display().to_string(), &bytes).map(Some).map_err(Failure::plain),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => {
            let message = format!("cannot read `{}`: {}", path.display(), error.to_string().to_lowercase());
            Err(Failure::plain(Diagnostic::without_place(Code::Unreadable, message)))
        }
    }
}

fn would_overwrite(path: &Path) -> Failure {
    let message = format!("`{}` holds a run already", path.display());
    let help = "`--resume` goes on with it; another `--out` starts afresh";
    Failure::plain(Diagnostic::without_place(Code::Checkpoint, message).with_help(help))
}
