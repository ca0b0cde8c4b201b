//! `nbc evolve`: evolution runs, resumable.

mod arguments;
mod campaign;
mod open_runs;
mod run;
pub(super) mod wording;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use serde::Serialize;

use crate::cli::draw::{read_run, run_page};
use crate::cli::evolve::campaign::{Campaign, MadeRun};
use crate::cli::evolve::open_runs::OpenRuns;
use crate::cli::evolve::run::Ended;
use crate::cli::source_path::source_path;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::{Context, Failure, Interrupt, OpenDevice, OutputFormat, Status};
use nbc_base::diag::counted;
use nbc_base::model::{Evolution, SearchObjective};
use nbc_base::source::Sources;
use nbc_session::report::{
    BehaviorGroup, GroupComparison, Schema, Scheme, behavior_groups, compare_groups, describe_groups,
};
use nbc_session::store;
use nbc_session::{EvolutionRun, Session};
use nbc_swarm::evolve::Champion;
use nbc_swarm::{Executor, LocalExecutor};

pub(super) use arguments::EvolveArguments;

const QUICK_SEEDS: usize = 3;
const QUICK_GENERATIONS: u32 = 200;
/// Evaluations above which the duration is estimated, and those that are timed for the estimate.
const LONG: u64 = 20_000;
const SAMPLE: usize = 8;

#[derive(Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Results {
    runs: Vec<Ended>,
    comparisons: Vec<Comparison>,
    #[serde(skip)]
    has_robots: bool,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Comparison {
    run: String,
    seeds: usize,
    groups: Vec<BehaviorGroup>,
    pairs: Vec<GroupComparison>,
}

impl EvolveArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let (timer, interrupt) = (self.timings.start(), Interrupt::watch()?);
        let declared = match self.declared(&interrupt, context) {
            Err(_) if interrupt.is_raised() => return Ok(Status::Interrupted),
            declared => declared?,
        };
        let device = OpenDevice::open(self.device, interrupt.ending(timer.processor()), context)?;
        let open = Arc::new(OpenRuns::default());
        let executor = self.executor(device, &declared, &interrupt, &open, context)?;
        let mut results = Results::default();
        let mut champions = BTreeMap::new();
        let campaign = Campaign { arguments: &self, timer: &timer, interrupt: &interrupt, executor, open };
        let finished = campaign
            .make(&declared, context, &mut |made, context| self.end_run(made, &mut champions, &mut results, context))?;
        timer.report(context);
        results.end(context, if finished { Status::Done } else { Status::Interrupted })
    }

    /// Also logs how long the runs will take, or how many cores they can use.
    fn executor(
        &self,
        device: OpenDevice,
        declared: &[Evolution],
        interrupt: &Interrupt,
        open: &Arc<OpenRuns>,
        context: &Context,
    ) -> Result<TaskExecutor, Failure> {
        let open = Arc::clone(open);
        let executor = TaskExecutor::open(device, &self.queue, interrupt, move |note| open.note(note))?;
        if executor.is_elsewhere() {
            let cores = counted(cores(declared, executor.threads()), "core");
            context.log(&format!("keeps about {cores} busy\n"));
        } else {
            self.tell_duration(declared, context);
        }
        Ok(executor)
    }

    /// Reports a run; after the last one of a declaration, compares its runs.
    fn end_run(
        &self,
        made: MadeRun,
        champions: &mut BTreeMap<u64, Vec<Champion>>,
        results: &mut Results,
        context: &mut Context,
    ) -> Result<(), Failure> {
        let MadeRun { evolution, seed, finished, has_robots, ended, summary, champions: found } = made;
        results.has_robots |= has_robots;
        champions.insert(seed, found);
        results.runs.push(ended);
        if context.format == OutputFormat::Text {
            context.print(summary)?;
            context.flush()?;
        }
        if !finished || evolution.seeds.last() != Some(&seed) {
            return Ok(());
        }
        let champions = std::mem::take(champions);
        if is_comparable(evolution) {
            let comparison = Comparison::of(evolution, &champions);
            if context.format == OutputFormat::Text {
                context.print(comparison.describe())?;
            }
            results.comparisons.push(comparison);
        }
        if self.report {
            self.write_report(evolution, context)?;
        }
        Ok(())
    }

    fn write_report(&self, evolution: &Evolution, context: &mut Context) -> Result<(), Failure> {
        let folder = self.folder(&evolution.name).path();
        let path = folder.join("report.html");
        let (page, faults) = run_page(&read_run(&folder, context)?, Scheme::default());
        context.tell(&faults, &Sources::default());
        store::write_result(&path, page.as_bytes()).map_err(|error| Failure::unwritable(&path, &error))?;
        if context.format == OutputFormat::Text {
            context.print(format_args!("report  {}\n", path.display()))?;
        }
        Ok(())
    }
}

impl Results {
    fn end(&self, context: &mut Context, status: Status) -> Result<Status, Failure> {
        if context.format == OutputFormat::Json {
            context.print_json(Schema::Evolve, self)?;
        }
        if status == Status::Done && !self.has_robots {
            context.tell(&[wording::no_robot_found()], &Sources::default());
            return Ok(Status::TestFailed);
        }
        Ok(status)
    }
}

impl Comparison {
    fn of(evolution: &Evolution, champions: &BTreeMap<u64, Vec<Champion>>) -> Self {
        let groups = behavior_groups(champions);
        let pairs = compare_groups(&groups);
        Self { run: evolution.name.clone(), seeds: champions.len(), groups, pairs }
    }

    fn describe(&self) -> String {
        format!("{}, {}: {}\n", self.run, counted(self.seeds, "run"), describe_groups(&self.groups, &self.pairs))
    }
}

impl EvolveArguments {
    fn declared(&self, interrupt: &Interrupt, context: &Context) -> Result<Vec<Evolution>, Failure> {
        let declared = self.chosen(interrupt)?;
        let mut evolutions = declared.clone();
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
        if let (true, [declared, left_out @ ..], [used, ..]) = (self.quick, &declared[..], &evolutions[..]) {
            context.log(&wording::quick_run(declared, used, left_out));
        }
        Ok(evolutions)
    }

    /// Estimates on standard error how long runs of many hours will take, from the time of a few evaluations.
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
        let text = format!("at most about {hours:.1} hours on this machine; less if simulations can be skipped\n");
        context.log(&text);
    }

    /// Those of the file, or of the prelude without a file, or a named one, which may be in a file that the file uses.
    fn chosen(&self, interrupt: &Interrupt) -> Result<Vec<Evolution>, Failure> {
        let mut session = Session::new(interrupt.world());
        let checked = self.file.as_ref().map(|path| Ok::<_, Failure>(session.open(source_path(path)?)?)).transpose()?;
        let program = checked.as_ref().map_or_else(nbc_session::prelude, |checked| checked.program.clone());
        let started = |evolution: &Evolution| match &checked {
            None => Ok::<_, Failure>(evolution.clone()),
            // Others read no robots.
            Some(checked) if evolution.start.is_some() => Ok(checked.started(evolution, self.runs()?)?),
            Some(_) => Ok(evolution.clone()),
        };
        let known = || program.evolutions.iter().map(|evolution| evolution.name.clone()).collect::<Vec<_>>();
        if let Some(name) = &self.run {
            let found = program.evolution(name).ok_or_else(|| wording::unknown_evolution(name, &known()))?;
            return Ok(vec![started(found)?]);
        }
        let Some(path) = &self.file else { return Ok(program.evolutions) };
        if program.own_evolutions.is_empty() {
            return Err(wording::no_evolution(path, &known()).into());
        }
        let own = program.evolutions.iter().filter(|evolution| program.own_evolutions.contains(&evolution.name));
        own.map(started).collect()
    }
}

/// Bodies that are evaluated at once in the first generations after the first.
fn cores(declared: &[Evolution], most_runs: usize) -> usize {
    let bodies = |evolution: &Evolution| evolution.batch + evolution.newcomers;
    let runs = declared.iter().flat_map(|evolution| evolution.seeds.iter().map(move |_| bodies(evolution)));
    runs.take(most_runs).sum()
}

/// Seconds of one full evaluation on this machine.
fn seconds_each(evolution: &Evolution) -> f64 {
    let run = EvolutionRun::new(evolution, 0);
    let candidates: Vec<_> = run.search().ask().into_iter().take(SAMPLE).collect();
    let (tasks, started) = (run.tasks(&candidates), Instant::now());
    LocalExecutor::default().perform(0, &tasks, &|| ());
    started.elapsed().as_secs_f64() / tasks.len().max(1) as f64
}

/// The paper's comparison needs several runs with its objective.
fn is_comparable(evolution: &Evolution) -> bool {
    evolution.seeds.len() > 1 && evolution.objective == SearchObjective::Distance
}
