//! All runs of a command: the seeds of a declaration advance together on this machine, and each run by itself if
//! workers do the tasks.

use std::sync::Arc;

use crate::cli::evolve::arguments::EvolveArguments;
use crate::cli::evolve::open_runs::OpenRuns;
use crate::cli::evolve::run::{Ended, RunFolder};
use crate::cli::in_order::in_order;
use crate::cli::options::timings::Timer;
use crate::cli::task_executor::TaskExecutor;
use crate::cli::{Context, Failure, Interrupt, context};
use nbc_base::diag::Diagnostic;
use nbc_base::model::Evolution;
use nbc_base::source::Sources;
use nbc_swarm::Task;
use nbc_swarm::evolve::Champion;

type RunSet<'a> = (&'a Evolution, &'a [u64]);

pub(super) struct Campaign<'a> {
    pub(super) arguments: &'a EvolveArguments,
    pub(super) timer: &'a Timer,
    pub(super) interrupt: &'a Interrupt,
    pub(super) executor: TaskExecutor,
    pub(super) open: Arc<OpenRuns>,
}

pub(super) struct MadeRun<'a> {
    pub(super) evolution: &'a Evolution,
    pub(super) seed: u64,
    pub(super) finished: bool,
    pub(super) has_robots: bool,
    pub(super) ended: Ended,
    pub(super) summary: String,
    pub(super) champions: Vec<Champion>,
}

impl<'a> Campaign<'a> {
    /// Passes the runs to `hand_on` in their order. Returns whether all were finished; after an interruption, those
    /// that were begun are passed on.
    pub(super) fn make(
        self,
        evolutions: &'a [Evolution],
        context: &mut Context,
        hand_on: &mut dyn FnMut(MadeRun<'a>, &mut Context) -> Result<(), Failure>,
    ) -> Result<bool, Failure> {
        let sets: Vec<RunSet> = evolutions
            .iter()
            .flat_map(|evolution| {
                evolution.seeds.chunks(self.executor.most_together()).map(move |seeds| (evolution, seeds))
            })
            .collect();
        let threads = self.executor.threads_for_sets(sets.iter().map(|(_, seeds)| seeds.len()).max().unwrap_or(0));
        let color = context.color;
        let work = |place: usize, &set: &RunSet<'a>| {
            // The first runs are begun in any case, so that an interruption leaves a checkpoint.
            let is_begun = place == 0 || !self.interrupt.is_raised();
            is_begun.then(|| self.make_set(place, set, color)).transpose()
        };
        // The first run that was not finished, and those after it.
        let (mut rest, mut finished) = (Vec::new(), true);
        let mut keep = |made: Option<Vec<MadeRun<'a>>>| {
            finished &= made.is_some();
            made.into_iter().flatten().try_for_each(|run| {
                finished &= run.finished;
                if finished {
                    return hand_on(run, context);
                }
                rest.push(run);
                Ok(())
            })
        };
        let keep_or_stop = |made: Result<Option<Vec<MadeRun<'a>>>, Failure>| {
            made.and_then(&mut keep).inspect_err(|_| self.interrupt.raise())
        };
        let made = in_order(threads, &sets, work, keep_or_stop);
        let ended = self.executor.end(context);
        made.and(ended)?;
        rest.into_iter().try_for_each(|run| hand_on(run, context))?;
        Ok(finished)
    }

    /// Makes runs until they are finished or stopped. After an error, the other runs are stopped.
    fn make_set(&self, place: usize, (evolution, seeds): RunSet<'a>, color: bool) -> Result<Vec<MadeRun<'a>>, Failure> {
        let warn = |warning: Diagnostic| context::tell(&[warning], &Sources::default(), color);
        let open = |&seed: &u64| RunFolder::open(self.arguments, evolution, seed, self.timer, &warn);
        let opened: Result<Vec<RunFolder>, Failure> = seeds.iter().map(open).collect();
        let made = opened.and_then(|mut runs| {
            runs.iter().for_each(|run| self.open.begin(run.run().search().generation(), evolution.generations));
            let evolved = self.evolve(&mut runs, place);
            runs.iter().for_each(|_| self.open.end());
            // Each is saved, whatever becomes of the others.
            let saved: Vec<Result<(), Failure>> = runs.iter().map(RunFolder::save_timed).collect();
            saved.into_iter().collect::<Result<(), Failure>>()?;
            evolved.map(|()| runs.iter().zip(seeds).map(|(run, &seed)| made_run(evolution, seed, run)).collect())
        });
        made.inspect_err(|_| self.interrupt.raise())
    }

    /// Makes generations of all runs together until all are made, or a signal arrives.
    fn evolve(&self, runs: &mut [RunFolder<'a>], place: usize) -> Result<(), Failure> {
        while !self.interrupt.is_raised() {
            let mut open: Vec<&mut RunFolder> = runs.iter_mut().filter(|run| !run.is_done()).collect();
            if open.is_empty() {
                break;
            }
            let asked: Vec<Vec<Task>> = open.iter_mut().map(|run| run.ask()).collect();
            let results = self.executor.executor().perform(place, &asked.concat(), &|| ());
            self.executor.check()?;
            let Some(results) = results else {
                // Without workers, no other run can be made either.
                self.interrupt.raise();
                break;
            };
            let mut results = results.into_iter();
            for (run, asked) in open.into_iter().zip(asked) {
                let note = run.tell(results.by_ref().take(asked.len()).collect())?;
                if run.is_done() {
                    run.save_timed()?;
                }
                self.open.advance((!self.executor.is_elsewhere()).then_some(note));
            }
        }
        Ok(())
    }
}

fn made_run<'a>(evolution: &'a Evolution, seed: u64, run: &RunFolder) -> MadeRun<'a> {
    let archive = run.run().search().archive();
    let (finished, champions) = (run.is_done(), archive.stats().champions);
    let (ended, summary) = (run.ended(finished), run.summary(finished));
    MadeRun { evolution, seed, finished, has_robots: archive.elites().next().is_some(), ended, summary, champions }
}
