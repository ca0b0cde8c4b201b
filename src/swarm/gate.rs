//! The objective of gates: being right after any switch of the inputs, soon, and without a wrong cycle where the output ought not
//! to change (docs/evolution.md, The gate objective).

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::evolve::{Candidate, Outcome, Scores, Search};
use crate::model::{Behavior, Pattern, Schedule, Trajectory, Trial};
use crate::sim::run_trials;
use crate::swarm::evaluate::{self, Work};
use crate::swarm::holds::{Hold, HoldPlan, holds};

/// Cycles of each hold in the first two stages.
const HOLD: u32 = 4;
/// The cycles of a hold from which on the output is asked to be right; each is scored by itself.
const CLOCKS: [usize; 3] = [2, 3, 4];
/// Four walks from four fresh starts that make each of the twelve switches once.
const WALKS: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 2, 1], [3, 1, 3, 0]];
/// Random sequences of the third stage, and the holds of each.
const RANDOM_LANES: usize = 4;
const RANDOM_HOLDS: usize = 12;
/// The seed of the third stage's sequences: the same for every candidate, other than those of `characterise`.
const RANDOM_SEED: u64 = 0x6761_7465;
/// The margin, in voxels a cycle, that is worth half of what an endless one is.
const HALF_MARGIN: f64 = 0.05;

/// A stage: the plans of a candidate's trials.
type Stage = Vec<HoldPlan>;

/// The three stages: fresh starts under constant patterns; all switches; random sequences. Each is run only by candidates which a
/// niche could still take.
fn stages() -> [Stage; 3] {
    let pairs = |walk: &[usize]| walk.iter().map(|&i| (Pattern::PAIRS[i], HOLD)).collect();
    let starts = WALKS.map(|walk| HoldPlan(pairs(&walk[..1])));
    let walks = WALKS.map(|walk| HoldPlan(pairs(&walk)));
    let mut rng = ChaCha8Rng::seed_from_u64(RANDOM_SEED);
    let random = (0..RANDOM_LANES).map(|_| HoldPlan::random(RANDOM_HOLDS, 2..=4, &mut rng));
    [starts.into(), walks.into(), random.collect()]
}

/// A candidate on its way through the stages.
struct Progress {
    holds: Vec<Hold>,
    outcome: Option<Outcome>,
    scores: Scores,
}

/// The outcome of each candidate by the gate objective.
pub(crate) fn evaluate(search: &Search, candidates: &[Candidate]) -> (Vec<Outcome>, Work) {
    let setting = evaluate::setting(search.evolution());
    let nothing = Scores { fitness: [1.0; 2], behavior: Behavior::of(&[0.0; 4]), displacement: [0.0; 4] };
    let mut progress: Vec<Progress> =
        candidates.iter().map(|_| Progress { holds: Vec::new(), outcome: None, scores: nothing }).collect();
    let mut work = Work::default();
    for stage in stages() {
        let open: Vec<usize> = (0..candidates.len()).filter(|&i| progress[i].outcome.is_none()).collect();
        let trial = |i: usize, plan: &HoldPlan| Trial { body: candidates[i].body.clone(), schedule: plan.schedule() };
        let trials: Vec<Trial> = open
            .iter()
            .flat_map(|&i| stage.iter().map(move |plan| (i, plan)))
            .map(|(i, plan)| trial(i, plan))
            .collect();
        let steps: u64 = stage.iter().map(|plan| u64::from(Schedule::steps(&plan.schedule()))).sum();
        work.env_steps += steps * open.len() as u64;
        work.left_out += steps * (candidates.len() - open.len()) as u64;
        let trajectories = run_trials(&setting, &trials);
        for (&i, group) in open.iter().zip(trajectories.chunks_exact(stage.len())) {
            progress[i].add(&stage, group);
            if progress[i].outcome.is_none() && !search.could_take(&candidates[i].body, &progress[i].scores) {
                progress[i].outcome = Some(Outcome::Surpassed);
            }
        }
    }
    (progress.into_iter().map(|done| done.outcome.unwrap_or(Outcome::Measured(done.scores))).collect(), work)
}

impl Progress {
    /// Takes the trajectories of one more stage. The scores can only fall.
    fn add(&mut self, stage: &Stage, trajectories: &[Trajectory]) {
        if let Some(fault) = trajectories.iter().find_map(|trajectory| trajectory.fault) {
            self.outcome = Some(Outcome::Faulty(fault));
            return;
        }
        let is_first = self.holds.is_empty();
        for (plan, trajectory) in stage.iter().zip(trajectories) {
            self.holds.extend(holds(plan, trajectory));
        }
        if is_first {
            self.scores.displacement = settled_displacement(&self.holds);
            self.scores.behavior = Behavior::of(&self.scores.displacement);
        }
        self.scores.fitness = fitness(self.scores.behavior, &self.holds);
    }
}

/// Displacement under each pattern without the first cycle, in which the body finds its shape.
fn settled_displacement(holds: &[Hold]) -> [f64; 4] {
    let mut displacement = [0.0; 4];
    for hold in holds {
        displacement[hold.pattern.pair_index()] = hold.cycles[1..].iter().sum();
    }
    displacement
}

/// Two fitnesses between 0 and 1, one half where the worst cycle stands still: how right the output is from the second, third and
/// fourth cycle of a hold on, and how right it is in every cycle of holds that ought not to change it.
pub(crate) fn fitness(behavior: Behavior, holds: &[Hold]) -> [f64; 2] {
    let settled =
        CLOCKS.map(|clock| worth(least(holds.iter().flat_map(|hold| hold.rightward(behavior).skip(clock - 1)))));
    let stays =
        |hold: &&Hold| hold.before.is_none_or(|before| behavior.direction(before) == behavior.direction(hold.pattern));
    // A fresh start is no switch: its first cycle counts for nothing.
    let unchanged =
        holds.iter().filter(stays).flat_map(|hold| hold.rightward(behavior).skip(usize::from(hold.before.is_none())));
    [settled.iter().sum::<f64>() / CLOCKS.len() as f64, worth(least(unchanged))]
}

fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

/// A margin as a number between 0 and 1.
fn worth(margin: f64) -> f64 {
    if margin.is_infinite() { 1.0 } else { 0.5 + 0.5 * margin / (margin.abs() + HALF_MARGIN) }
}
