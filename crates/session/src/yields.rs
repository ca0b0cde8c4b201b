//! Tests in samples of worlds: in how many each passes, and which robots fail first.

use crate::{Observer, RunEnd, Session, TestCase};
use nbc_base::model::Variation;
use nbc_swarm::{Robustness, TestVerdict, WorldSample, WorldTrial};

/// A test in a sample of worlds.
#[derive(Clone, Debug)]
pub struct Experiment<'c> {
    pub case: &'c TestCase,
    pub variation: Variation,
    pub scale: f64,
}

/// Experiments in the same number of worlds. Runs are independent; [`YieldTally::tell`] takes results in order.
#[derive(Clone, Debug)]
pub struct Yields<'c> {
    pub experiments: Vec<Experiment<'c>>,
    pub worlds: usize,
    pub seed: u64,
}

/// The numbers of an experiment and of a world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorldRun {
    experiment: usize,
    world: usize,
}

/// The result of a run.
#[derive(Clone, Debug)]
pub struct WorldResult {
    verdict: TestVerdict,
    trial: WorldTrial,
}

impl<'c> Yields<'c> {
    /// Each case under each variation times each number. Cases without robots are the same in every world: left out.
    pub fn of(cases: &'c [TestCase], vary: &[Variation], times: &[f64], worlds: usize, seed: u64) -> Self {
        let mut experiments = Vec::new();
        for case in cases.iter().filter(|case| case.world_name().is_some()) {
            for variation in vary {
                let scaled = |&scale: &f64| Experiment { case, variation: variation.times(scale), scale };
                experiments.extend(times.iter().map(scaled));
            }
        }
        Self { experiments, worlds, seed }
    }

    /// In the order of their experiments and worlds.
    pub fn runs(&self) -> Vec<WorldRun> {
        let worlds = |experiment: usize| (0..self.worlds).map(move |world| WorldRun { experiment, world });
        (0..self.experiments.len()).flat_map(worlds).collect()
    }

    /// The amount of work of all runs, as [`TestCase::work`].
    pub fn work(&self) -> u64 {
        let work: u64 = self.experiments.iter().map(|experiment| experiment.case.work()).sum();
        work * self.worlds as u64
    }

    pub fn tally(&self) -> YieldTally<'_> {
        YieldTally { yields: self, trials: Vec::new(), done: 0 }
    }
}

/// The results of runs, summed up as they come.
#[derive(Debug)]
pub struct YieldTally<'y> {
    yields: &'y Yields<'y>,
    trials: Vec<WorldTrial>,
    done: usize,
}

impl YieldTally<'_> {
    /// Takes the result of the next run. Returns the sum after the last result of an experiment.
    pub fn tell(&mut self, WorldResult { verdict, trial }: WorldResult) -> Option<Robustness> {
        self.trials.push(trial);
        if self.trials.len() < self.yields.worlds {
            return None;
        }
        let Experiment { case, variation, scale } = &self.yields.experiments[self.done];
        self.done += 1;
        let trials = std::mem::take(&mut self.trials);
        Some(Robustness::of(&verdict, case.robots(), (*variation, *scale), &trials))
    }
}

impl Session {
    /// `None` if the observer cancelled it.
    pub fn run_in_world(&self, yields: &Yields<'_>, run: WorldRun, observer: &mut dyn Observer) -> Option<WorldResult> {
        let Experiment { case, variation, .. } = &yields.experiments[run.experiment];
        let world = WorldSample { variation: *variation, seed: yields.seed }.world(&case.world(), run.world);
        let run = self.run_case(case.trial_in(world), observer);
        let trial = (run.end == RunEnd::Complete).then(|| run.world_trial()).flatten()?;
        Some(WorldResult { verdict: run.verdict, trial })
    }
}
