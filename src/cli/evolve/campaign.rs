//! All runs of a command: as many at once as the place of their evaluations can work on.

use std::collections::BTreeMap;

use crate::cli::evolve::arguments::EvolveArguments;
use crate::cli::evolve::run::{Ended, EvolutionRun};
use crate::cli::place::TaskPlace;
use crate::cli::timings::Timer;
use crate::cli::{Context, Failure, Interrupt, Progress};
use nbc_base::model::Evolution;
use nbc_swarm::evolve::Champion;

/// Makes runs.
pub(super) struct Campaign<'a> {
    pub(super) arguments: &'a EvolveArguments,
    pub(super) timer: &'a Timer,
    pub(super) interrupt: &'a Interrupt,
    pub(super) place: &'a mut dyn TaskPlace,
}

/// A run that was made.
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

/// The runs that are open, by their places in the list of all runs, and those that ended before an earlier one.
#[derive(Default)]
struct Desk<'a> {
    open: BTreeMap<usize, EvolutionRun<'a>>,
    early: BTreeMap<usize, MadeRun<'a>>,
    /// The place of the next run to open, and of the next to be passed on.
    next: usize,
    due: usize,
    /// Generations that the open runs have, and those they will have.
    generations: (u64, u64),
    bar: Option<Progress>,
}

impl Desk<'_> {
    /// Shows the progress.
    fn show(&self, note: Option<String>) {
        if let (Some(bar), Some(note)) = (&self.bar, note) {
            bar.set_with_note(self.generations.0, note);
        }
    }
}

impl<'a> Campaign<'a> {
    /// Makes the runs of the declarations and passes them to `hand_on` in their order. Returns whether all were
    /// finished; after an interruption, those that were begun are passed on.
    ///
    /// # Errors
    /// When a run cannot be opened, evaluated or saved; the other runs are saved first. Errors of `hand_on`.
    pub(super) fn make(
        &mut self,
        evolutions: &'a [Evolution],
        context: &mut Context,
        hand_on: &mut dyn FnMut(MadeRun<'a>, &mut Context) -> Result<(), Failure>,
    ) -> Result<bool, Failure> {
        let plan: Vec<(&Evolution, u64)> = evolutions
            .iter()
            .flat_map(|evolution| evolution.seeds.iter().map(move |&seed| (evolution, seed)))
            .collect();
        let mut desk = Desk::default();
        let made = self.work(&plan, &mut desk, context, hand_on);
        self.place.close();
        desk.bar = None;
        for (at, run) in std::mem::take(&mut desk.open) {
            run.save_timed()?;
            desk.early.insert(at, made_run(plan[at], &run, false));
        }
        made?;
        let finished = desk.early.is_empty();
        for (_, run) in std::mem::take(&mut desk.early) {
            hand_on(run, context)?;
        }
        Ok(finished)
    }

    /// Works until all runs are finished, or a signal arrives.
    fn work(
        &mut self,
        plan: &[(&'a Evolution, u64)],
        desk: &mut Desk<'a>,
        context: &mut Context,
        hand_on: &mut dyn FnMut(MadeRun<'a>, &mut Context) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        loop {
            self.open_runs(plan, desk, context)?;
            while let Some(run) = desk.early.remove(&desk.due) {
                hand_on(run, context)?;
                desk.due += 1;
            }
            if desk.due == plan.len() || (self.interrupt.is_raised() && !desk.open.is_empty()) {
                return Ok(());
            }
            let Some((at, results)) = self.place.next()? else {
                desk.show(self.place.note());
                continue;
            };
            let Some(run) = desk.open.get_mut(&at) else { continue };
            let message = run.tell(results)?;
            desk.generations.0 += 1;
            desk.show(self.place.note().or(Some(message)));
            self.proceed(plan, at, desk)?;
        }
    }

    /// Opens as many runs as can be worked on.
    fn open_runs(
        &mut self,
        plan: &[(&'a Evolution, u64)],
        desk: &mut Desk<'a>,
        context: &Context,
    ) -> Result<(), Failure> {
        while desk.open.len() < self.place.most_runs() && desk.next < plan.len() && !desk.early.contains_key(&desk.due)
        {
            let (evolution, seed) = plan[desk.next];
            let run = EvolutionRun::open(self.arguments, evolution, seed, self.timer, context)?;
            if desk.open.is_empty() {
                desk.generations = (0, 0);
            }
            desk.generations.0 += u64::from(run.generation());
            desk.generations.1 += u64::from(evolution.generations);
            desk.bar = None;
            desk.bar = Some(Progress::resumed("generations", desk.generations.0, desk.generations.1));
            desk.open.insert(desk.next, run);
            desk.next += 1;
            self.proceed(plan, desk.next - 1, desk)?;
        }
        Ok(())
    }

    /// Submits the next generation of a run, or closes it.
    fn proceed(&mut self, plan: &[(&'a Evolution, u64)], at: usize, desk: &mut Desk<'a>) -> Result<(), Failure> {
        let Some(run) = desk.open.get_mut(&at) else { return Ok(()) };
        if !run.is_done() {
            if !self.interrupt.is_raised() {
                self.place.submit(run.ask(at));
            }
            return Ok(());
        }
        run.save_timed()?;
        desk.early.insert(at, made_run(plan[at], run, true));
        desk.open.remove(&at);
        if desk.open.is_empty() {
            desk.bar = None;
        }
        Ok(())
    }
}

fn made_run<'a>((evolution, seed): (&'a Evolution, u64), run: &EvolutionRun, finished: bool) -> MadeRun<'a> {
    let champions = run.archive_stats().champions;
    let (ended, summary) = (run.ended(finished), run.summary(finished));
    MadeRun { evolution, seed, finished, has_robots: run.has_robots(), ended, summary, champions }
}
