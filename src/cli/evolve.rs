//! `nbc evolve`: evolution runs, resumable.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Args;
use serde::Serialize;

use crate::cli::{Context, Failure, Format, Interrupt, Progress, Status};
use crate::diag::{Code, Diagnostic};
use crate::evolve::{ArchiveStats, Search};
use crate::model::{Evolution, Objective};
use crate::pipeline;
use crate::report::{EvolutionLine, behavior_groups, compare_groups, describe_groups, evolution_table};
use crate::store::{self, Checkpoint, DiskWorld};
use crate::swarm::{self, Work};

/// The file in a run's folder that it is resumed from.
pub(super) const CHECKPOINT: &str = "checkpoint.nbc";
/// The file in a run's folder with a line for each generation.
const PROGRESS: &str = "progress.jsonl";

/// A run with `--quick`.
const QUICK_SEEDS: usize = 3;
const QUICK_GENERATIONS: u32 = 200;
/// Evaluations from which on it is told how long they will take, and those that are timed for it.
const LONG: u64 = 20_000;
const SAMPLE: usize = 8;

/// Evolve robots by the evolution declarations of a file
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc evolve                                the prelude's `gates`, into out/gates
  nbc evolve library/evolve.nb --run gates5 one run of a file
  nbc evolve library/evolve.nb --resume     go on after an interruption

Ctrl-C, SIGTERM and SIGUSR1 write a checkpoint and end with status 4.")]
pub struct Arguments {
    /// The file with the declarations; the prelude's `gates` without it
    file: Option<PathBuf>,
    /// Only the declaration of this name
    #[arg(long, value_name = "NAME")]
    run: Option<String>,
    /// This seed instead of the declared ones
    #[arg(long)]
    seed: Option<u64>,
    /// That many generations instead of the declared ones
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    generations: Option<u32>,
    /// The folder for results
    #[arg(long, value_name = "DIR", default_value = "out")]
    out: PathBuf,
    /// Go on from the checkpoints in the folder; start what has none
    #[arg(long)]
    resume: bool,
    /// A small version of the first declaration: three seeds, 200 generations
    #[arg(long, conflicts_with_all = ["seed", "generations"])]
    quick: bool,
    /// Seconds between checkpoints, 0 for one each generation
    #[arg(long, value_name = "SECONDS", default_value_t = 10)]
    checkpoint_every: u64,
}

/// How one run ended.
#[derive(Serialize)]
struct Ended {
    run: String,
    seed: u64,
    folder: PathBuf,
    finished: bool,
    seconds: f64,
    #[serde(flatten)]
    line: EvolutionLine,
}

impl Arguments {
    /// Makes the runs, one after another.
    ///
    /// # Errors
    /// When the file has errors, a checkpoint is refused, or results cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let mut ended = Vec::new();
        let declared = self.declared()?;
        self.tell_duration(&declared, context);
        for evolution in declared {
            let mut archives = Vec::new();
            for &seed in &evolution.seeds {
                let mut run = Run::open(&self, &evolution, seed)?;
                let finished = run.make(&interrupt)?;
                archives.push(run.search.archive().stats());
                ended.push(run.ended(finished));
                if context.format == Format::Text {
                    context.print(run.summary(finished))?;
                    context.flush()?;
                }
                if !finished {
                    return end(context, &ended, Status::Interrupted);
                }
            }
            if context.format == Format::Text && is_comparable(&evolution) {
                context.print(compare(&evolution, &archives))?;
            }
        }
        end(context, &ended, Status::Done)
    }
}

impl Arguments {
    /// The runs to make, with what the command line changes.
    fn declared(&self) -> Result<Vec<Evolution>, Failure> {
        let mut evolutions = self.chosen()?;
        if self.quick {
            evolutions.truncate(1);
        }
        for evolution in &mut evolutions {
            if let Some(seed) = self.seed {
                evolution.seeds = vec![seed];
            }
            if self.quick {
                evolution.seeds.truncate(QUICK_SEEDS);
            }
            let quick = self.quick.then_some(QUICK_GENERATIONS);
            evolution.generations = self.generations.or(quick).unwrap_or(evolution.generations);
        }
        Ok(evolutions)
    }

    /// Says on standard error how long runs of many hours will take here, by the time of a few evaluations.
    fn tell_duration(&self, evolutions: &[Evolution], context: &Context) {
        let evaluations = |evolution: &Evolution| {
            let generation = (evolution.batch + evolution.newcomers) as u64;
            generation * u64::from(evolution.generations) * evolution.seeds.len() as u64
        };
        if evolutions.iter().map(evaluations).sum::<u64>() < LONG {
            return;
        }
        let seconds: f64 =
            evolutions.iter().map(|evolution| evaluations(evolution) as f64 * seconds_each(evolution)).sum();
        let hours = seconds / 3600.0;
        let text =
            format!("at most about {hours:.1} hours on this machine; what need not be simulated makes it less\n");
        context.log(&text);
    }

    /// The file's own runs, or the prelude's, or the one that is asked for by name.
    fn chosen(&self) -> Result<Vec<Evolution>, Failure> {
        let prelude = pipeline::prelude().evolutions;
        let Some(path) = &self.file else { return self.named(prelude.clone(), prelude) };
        let loaded = pipeline::load(&DiskWorld, &path.to_string_lossy());
        if loaded.checked.has_errors() {
            return Err(Failure::input(loaded.checked.diagnostics, loaded.sources));
        }
        let all = loaded.checked.program.evolutions;
        let own: Vec<Evolution> = all.iter().filter(|evolution| !prelude.contains(evolution)).cloned().collect();
        if own.is_empty() && self.run.is_none() {
            let message = format!("`{}` declares no evolution", path.display());
            let help = "without a file, the prelude's `gates` is run";
            return Err(Failure::plain(Diagnostic::without_place(Code::Unknown, message).with_help(help)));
        }
        self.named(own, all)
    }

    fn named(&self, usual: Vec<Evolution>, all: Vec<Evolution>) -> Result<Vec<Evolution>, Failure> {
        let Some(name) = &self.run else { return Ok(usual) };
        let names: Vec<String> = all.iter().map(|evolution| format!("`{}`", evolution.name)).collect();
        let found: Vec<Evolution> = all.into_iter().filter(|evolution| evolution.name == *name).collect();
        if found.is_empty() {
            let message = format!("no evolution is called `{name}`");
            let help = format!("there are {}", names.join(", "));
            return Err(Failure::plain(Diagnostic::without_place(Code::Unknown, message).with_help(help)));
        }
        Ok(found)
    }
}

/// Seconds that one evaluation in full takes here.
fn seconds_each(evolution: &Evolution) -> f64 {
    let search = Search::new(evolution, 0);
    let candidates: Vec<_> = search.ask().into_iter().take(SAMPLE).collect();
    let started = Instant::now();
    swarm::evaluate(&search, &candidates);
    started.elapsed().as_secs_f64() / candidates.len().max(1) as f64
}

/// Whether the paper's comparison of behaviors can be made: several runs by its objective.
fn is_comparable(evolution: &Evolution) -> bool {
    evolution.seeds.len() > 1 && evolution.objective == Objective::Distance
}

fn compare(evolution: &Evolution, archives: &[ArchiveStats]) -> String {
    let groups = behavior_groups(archives);
    let comparison = describe_groups(&groups, &compare_groups(&groups));
    format!("{}, {} runs: {comparison}\n", evolution.name, archives.len())
}

fn end(context: &mut Context, ended: &[Ended], status: Status) -> Result<Status, Failure> {
    if context.format == Format::Json {
        context.print_json(&ended)?;
    }
    Ok(status)
}

/// One declaration with one seed, in its folder.
struct Run {
    search: Search,
    work: Work,
    folder: PathBuf,
    checkpoint_every: Duration,
    started: Instant,
    /// Time spent on asking and telling: parents, mutation, development, the archive.
    searching: Duration,
    /// Evaluations and work made before this program took over.
    evaluations_before: u64,
    work_before: Work,
}

impl Run {
    fn open(arguments: &Arguments, evolution: &Evolution, seed: u64) -> Result<Self, Failure> {
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
            work,
            folder,
            checkpoint_every: Duration::from_secs(arguments.checkpoint_every),
            started: Instant::now(),
            searching: Duration::ZERO,
            evaluations_before,
            work_before: work,
        };
        run.trim_progress()?;
        Ok(run)
    }

    /// Makes the generations that are left; whether it got to the end.
    fn make(&mut self, interrupt: &Interrupt) -> Result<bool, Failure> {
        let generations = u64::from(self.search.evolution().generations);
        let bar = Progress::with_template(generations, "{bar:24} {pos}/{len} generations, {msg}, {eta} left");
        let mut saved = Instant::now();
        while !self.search.is_done() && !interrupt.is_raised() {
            self.advance();
            let line = EvolutionLine::of(&self.search, self.work);
            self.append(&line)?;
            bar.set(u64::from(line.generation));
            bar.set_message(self.message(&line));
            if saved.elapsed() >= self.checkpoint_every {
                self.save()?;
                saved = Instant::now();
            }
        }
        self.save()?;
        Ok(self.search.is_done())
    }

    /// One generation, with a clock on what is not simulation.
    fn advance(&mut self) {
        let asked = Instant::now();
        let candidates = self.search.ask();
        self.searching += asked.elapsed();
        let (outcomes, work) = swarm::evaluate(&self.search, &candidates);
        let told = Instant::now();
        self.search.tell(&candidates, &outcomes);
        self.searching += told.elapsed();
        self.work = self.work.plus(work);
    }

    fn save(&self) -> Result<(), Failure> {
        let path = self.folder.join(CHECKPOINT);
        let bytes = Checkpoint::of(&self.search, self.work.env_steps, self.work.left_out).print();
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

    fn ended(&self, finished: bool) -> Ended {
        Ended {
            run: self.search.evolution().name.clone(),
            seed: self.search.seed(),
            folder: self.folder.clone(),
            finished,
            seconds: self.started.elapsed().as_secs_f64(),
            line: EvolutionLine::of(&self.search, self.work),
        }
    }

    fn summary(&self, finished: bool) -> String {
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
        let search = 100.0 * self.searching.as_secs_f64() / seconds;
        format!(
            "{seconds:.1} s, {rate:.1} evaluations/s, what was simulated making {in_full:.1} full ones/s; {search:.2} % of the time for archive, development and mutation\n"
        )
    }
}

/// The checkpoint at a path, if there is one.
pub(super) fn read_checkpoint(path: &Path) -> Result<Option<Checkpoint>, Failure> {
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
