//! Tests in samples of worlds, in parallel.

use crate::cli::in_order::in_order;
use crate::cli::{Failure, Interrupt, Progress};
use nbc_base::model::Variation;
use nbc_session::{RunEnd, Session, TestCase};
use nbc_swarm::{Robustness, TestVerdict, WorldSample, WorldTrial};

/// The worlds of a sample, and what runs tests in them.
pub(super) struct WorldRuns<'a> {
    pub session: &'a Session,
    pub interrupt: &'a Interrupt,
    /// The number of worlds.
    pub worlds: usize,
    /// Their seed.
    pub seed: u64,
}

/// A test under one variation.
pub(super) struct Experiment<'c, 'a> {
    pub case: &'c TestCase<'a>,
    pub variation: Variation,
    /// The factor of the requested variation.
    pub scale: f64,
}

/// A test in one world, to be run.
struct Visit<'e, 'c, 'a> {
    experiment: &'e Experiment<'c, 'a>,
    world: usize,
}

impl WorldRuns<'_> {
    /// Runs each experiment in all worlds, and tells each result as soon as those before it are complete. Returns those
    /// that are complete; after an interruption, that is not all.
    ///
    /// # Errors
    /// The first error of `tell`.
    pub(super) fn run(
        &self,
        experiments: &[Experiment<'_, '_>],
        mut tell: impl FnMut(&Robustness) -> Result<(), Failure>,
    ) -> Result<Vec<Robustness>, Failure> {
        let visits: Vec<Visit<'_, '_, '_>> = experiments
            .iter()
            .flat_map(|experiment| (0..self.worlds).map(move |world| Visit { experiment, world }))
            .collect();
        let work: u64 = visits.iter().map(|visit| visit.experiment.case.work()).sum();
        let bar = Progress::new("testing", work);
        let visit = |_: usize, visit: &Visit<'_, '_, '_>| {
            let run = (!self.interrupt.is_raised()).then(|| self.visit(visit, &bar));
            run.flatten()
        };
        let (mut found, mut trials) = (Vec::new(), Vec::new());
        // After an interruption, which is an error without a failure, no more worlds are begun.
        let mut take = |done: Option<(TestVerdict, WorldTrial)>| {
            let (verdict, trial) = done.ok_or(None)?;
            trials.push(trial);
            if trials.len() == self.worlds {
                let Experiment { case, variation, scale } = &experiments[found.len()];
                let trials = std::mem::take(&mut trials);
                let robustness = Robustness::of(&verdict, case.robots(), (*variation, *scale), &trials);
                tell(&robustness).map_err(Some)?;
                found.push(robustness);
            }
            Ok::<(), Option<Failure>>(())
        };
        match in_order(rayon::current_num_threads(), &visits, visit, |done| bar.suspend(|| take(done))) {
            Err(Some(failure)) => Err(failure),
            Ok(()) | Err(None) => Ok(found),
        }
    }

    /// The verdict in a world; `None` if it was interrupted.
    fn visit(&self, visit: &Visit<'_, '_, '_>, bar: &Progress) -> Option<(TestVerdict, WorldTrial)> {
        let Experiment { case, variation, .. } = visit.experiment;
        let world = WorldSample { variation: *variation, seed: self.seed }.world(&case.world(), visit.world);
        let run = self.session.run_case(case.trial_in(world), &mut self.interrupt.observe(bar.part()));
        let trial = (run.end == RunEnd::Complete).then(|| run.world_trial()).flatten()?;
        Some((run.verdict, trial))
    }
}
