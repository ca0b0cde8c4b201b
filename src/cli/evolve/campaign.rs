//! All runs of a command: one at a time on this machine, or many at once if workers do the tasks.

use std::sync::Arc;

use crate::cli::evolve::arguments::EvolveArguments;
use crate::cli::evolve::open_runs::OpenRuns;
use crate::cli::evolve::run::{Ended, EvolutionRun};
use crate::cli::evolve::wording::ProgressGaps;
use crate::cli::in_order::in_order;
use crate::cli::options::timings::Timer;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::{Context, Failure, Interrupt, context};
use nbc_base::model::Evolution;
use nbc_base::source::Sources;
use nbc_swarm::evolve::Champion;

/// The runs of a command, and what does their tasks.
pub(super) struct Campaign<'a> {
    pub(super) arguments: &'a EvolveArguments,
    pub(super) timer: &'a Timer,
    pub(super) interrupt: &'a Interrupt,
    pub(super) executor: TaskExecutor,
    pub(super) open: Arc<OpenRuns>,
}

/// A run that ended, with its results.
pub(super) struct MadeRun<'a> {
    pub(super) evolution: &'a Evolution,
    pub(super) seed: u64,
    pub(super) finished: bool,
    /// Whether its archive has a robot.
    pub(super) has_robots: bool,
    pub(super) ended: Ended,
    pub(super) summary: String,
    pub(super) champions: Vec<Champion>,
}

impl<'a> Campaign<'a> {
    /// Makes the runs of the declarations and passes them to `hand_on` in their order. Returns whether all were
    /// finished; after an interruption, those that were begun are passed on.
    ///
    /// # Errors
    /// When a run cannot be opened, evaluated or saved; the other runs are saved first. Errors of `hand_on`.
    pub(super) fn make(
        self,
        evolutions: &'a [Evolution],
        context: &mut Context,
        hand_on: &mut dyn FnMut(MadeRun<'a>, &mut Context) -> Result<(), Failure>,
    ) -> Result<bool, Failure> {
        let seeds = |evolution: &'a Evolution| evolution.seeds.iter().map(move |&seed| (evolution, seed));
        let plan: Vec<(&Evolution, u64)> = evolutions.iter().flat_map(seeds).collect();
        let color = context.color;
        let work = |place: usize, &(evolution, seed): &(&'a Evolution, u64)| {
            // The first run is begun in any case, so that an interruption leaves a checkpoint.
            let is_begun = place == 0 || !self.interrupt.is_raised();
            is_begun.then(|| self.make_run(place, evolution, seed, color)).transpose()
        };
        // The first run that was not finished, and those after it.
        let mut rest = Vec::new();
        let mut keep = |made: Option<MadeRun<'a>>| match made {
            Some(run) if run.finished && rest.is_empty() => hand_on(run, context),
            made => {
                rest.push(made);
                Ok(())
            }
        };
        let keep_or_stop = |made: Result<Option<MadeRun<'a>>, Failure>| {
            made.and_then(&mut keep).inspect_err(|_| self.interrupt.raise())
        };
        let made = in_order(self.executor.threads_for_runs(), &plan, work, keep_or_stop);
        let ended = self.executor.end(context);
        made.and(ended)?;
        let finished = rest.is_empty();
        rest.into_iter().flatten().try_for_each(|run| hand_on(run, context))?;
        Ok(finished)
    }

    /// Makes a run until it is finished or stopped. After an error, the other runs are stopped.
    fn make_run(&self, place: usize, evolution: &'a Evolution, seed: u64, color: bool) -> Result<MadeRun<'a>, Failure> {
        let warn = |warning: ProgressGaps| context::tell(&[warning.into()], &Sources::default(), color);
        let made = EvolutionRun::open(self.arguments, evolution, seed, self.timer, &warn).and_then(|mut run| {
            self.open.begin(run.generation(), evolution.generations);
            let evolved = self.evolve(&mut run, place);
            self.open.end();
            run.save_timed()?;
            evolved.map(|()| made_run(evolution, seed, &run))
        });
        made.inspect_err(|_| self.interrupt.raise())
    }

    /// Makes generations until all are made, or a signal arrives.
    fn evolve(&self, run: &mut EvolutionRun<'a>, place: usize) -> Result<(), Failure> {
        while !run.is_done() && !self.interrupt.is_raised() {
            let tasks = run.ask();
            let results = self.executor.executor().perform(place, &tasks, &|| ());
            self.executor.check()?;
            let Some(results) = results else {
                // Without workers, no other run can be made either.
                self.interrupt.raise();
                break;
            };
            let note = run.tell(results)?;
            self.open.advance((!self.executor.is_elsewhere()).then_some(note));
        }
        Ok(())
    }
}

fn made_run<'a>(evolution: &'a Evolution, seed: u64, run: &EvolutionRun) -> MadeRun<'a> {
    let (finished, champions) = (run.is_done(), run.archive_stats().champions);
    let (ended, summary) = (run.ended(finished), run.summary(finished));
    MadeRun { evolution, seed, finished, has_robots: run.has_robots(), ended, summary, champions }
}
