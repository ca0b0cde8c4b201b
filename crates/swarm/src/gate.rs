//! The objective of gates: the correct output soon after any switch of the inputs, and no wrong cycle while the output
//! should not change (docs/evolution.md, The gate objective).

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::Work;
use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask, setting};
use crate::evolve::{CandidateOutcome, Scores};
use crate::holds::{HoldPlan, PatternHold};
use crate::noise::RobotNoise;
use nbc_base::model::{Behavior, Body, CYCLE_STEPS, Pattern, PhysicsWorld};
use nbc_sim::Simulator;

/// Cycles of each hold of the walks.
const HOLD: usize = 4;
/// The cycles of a hold from which on the output must be correct; each is scored separately.
const CLOCKS: [usize; 3] = [2, 3, 4];
/// Four walks from four fresh starts, which together contain each of the twelve switches once.
const WALKS: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 2, 1], [3, 1, 3, 0]];
/// Random sequences that follow the walks, and the cycles of each.
const RANDOM_LANES: usize = 4;
const RANDOM_CYCLES: usize = 36;
/// Env steps of a full evaluation in one world.
const STEPS: u64 = ((WALKS.len() * WALKS[0].len() * HOLD + RANDOM_LANES * RANDOM_CYCLES) * CYCLE_STEPS as usize) as u64;
/// The seed of the random sequences: the same for every candidate, and different from that of `characterize`.
const RANDOM_SEED: u64 = 0x6761_7465;
/// The margin, in voxels per cycle, that scores halfway between zero and infinite margin.
const HALF_MARGIN: f64 = 0.05;
/// A candidate with a first fitness below this is dropped at once, even if its niche is empty.
const HOPELESS: f64 = 0.25;
/// Cycles after a fresh start until bodies that walk both ways can be recognized.
const FIRST_LOOK: usize = 3;

/// The patterns of one simulation, cycle by cycle.
type Lane = Vec<Pattern>;

/// The walks: every switch once.
fn walks() -> Vec<Lane> {
    WALKS.map(|walk| walk.iter().flat_map(|&i| [Pattern::PAIRS[i]; HOLD]).collect()).into()
}

/// The random sequences, with holds of two to four cycles.
fn random_sequences() -> Vec<Lane> {
    let mut rng = ChaCha8Rng::seed_from_u64(RANDOM_SEED);
    let mut lane = || {
        let HoldPlan(holds) = HoldPlan::random(RANDOM_CYCLES / 2, 2..=4, &mut rng);
        let cycles = holds.into_iter().flat_map(|(pattern, cycles)| std::iter::repeat_n(pattern, cycles as usize));
        cycles.take(RANDOM_CYCLES).collect()
    };
    (0..RANDOM_LANES).map(|_| lane()).collect()
}

/// Env steps of a full evaluation.
pub(super) fn steps(protocol: &EvaluationProtocol) -> u64 {
    STEPS * (1 + protocol.others.len() as u64)
}

/// The result of each task for the gate objective: the walks, then the random sequences, then both in each of the other
/// worlds. After each cycle, bodies that can no longer enter a niche are dropped; their scores can only decrease.
pub(crate) fn evaluate(
    simulator: &Simulator,
    protocol: &EvaluationProtocol,
    tasks: &[EvaluationTask],
) -> Vec<Evaluated> {
    let mut attempts: Vec<Attempt> = tasks.iter().map(Attempt::new).collect();
    for world in std::iter::once(&protocol.world).chain(&protocol.others) {
        for (stage, lanes) in [walks(), random_sequences()].iter().enumerate() {
            for attempt in &mut attempts {
                attempt.holds.resize(attempt.holds.len() + lanes.len(), Vec::new());
            }
            try_lanes(simulator, world, &mut attempts, lanes, stage * WALKS.len());
        }
    }
    let all = steps(protocol);
    attempts.into_iter().map(|attempt| attempt.end(all)).collect()
}

/// Simulates the remaining attempts in some lanes, the first of which is lane `first` of its world. Their holds are the
/// last ones of each attempt.
fn try_lanes(simulator: &Simulator, world: &PhysicsWorld, attempts: &mut [Attempt], lanes: &[Lane], first: usize) {
    let noise = RobotNoise::new(&world.noise, 0);
    let sensed: Vec<Lane> = (first..).zip(lanes).map(|(lane, cycles)| sensed(world, lane, cycles)).collect();
    let mut open: Vec<&mut Attempt> = attempts.iter_mut().filter(|attempt| attempt.outcome.is_none()).collect();
    let bodies: Vec<Body> = open.iter().flat_map(|attempt| vec![noise.worn(&attempt.task.body); lanes.len()]).collect();
    let mut flock = simulator.flock(&setting(world), &bodies);
    for cycle in 0..lanes[0].len() {
        let before: Vec<f64> = (0..flock.len()).map(|i| flock.center(i)[0]).collect();
        let patterns: Vec<Pattern> = open.iter().flat_map(|_| sensed.iter().map(|lane| lane[cycle])).collect();
        flock.advance(&patterns, CYCLE_STEPS);
        for (i, attempt) in open.iter_mut().enumerate() {
            attempt.env_steps += lanes.len() as u64 * u64::from(CYCLE_STEPS);
            for (lane, place) in (i * lanes.len()..).take(lanes.len()).enumerate() {
                let moved = flock.center(place)[0] - before[place];
                let holds = attempt.holds.len() - lanes.len() + lane;
                attempt.push(holds, lanes[lane][cycle], moved);
                attempt.fail(flock.fault(place));
            }
            attempt.look();
        }
        let keep: Vec<bool> = open.iter().flat_map(|attempt| vec![attempt.outcome.is_none(); lanes.len()]).collect();
        flock.retain(&keep);
        open.retain(|attempt| attempt.outcome.is_none());
    }
}

/// The patterns of lane `lane` as a body senses them.
fn sensed(world: &PhysicsWorld, lane: usize, cycles: &Lane) -> Lane {
    let noise = RobotNoise::new(&world.noise, lane);
    let mut sensed = cycles.clone();
    for cycle in (1..sensed.len()).filter(|&cycle| noise.misses(cycle)) {
        sensed[cycle] = sensed[cycle - 1];
    }
    sensed
}

/// A body during its evaluation.
struct Attempt<'a> {
    task: &'a EvaluationTask,
    /// The holds of each lane so far.
    holds: Vec<Vec<PatternHold>>,
    scores: Scores,
    /// Env steps simulated so far.
    env_steps: u64,
    outcome: Option<CandidateOutcome>,
}

impl<'a> Attempt<'a> {
    fn new(task: &'a EvaluationTask) -> Self {
        let scores = Scores { fitness: [1.0; 2], behavior: Behavior::of(&[0.0; 4]), displacement: [0.0; 4] };
        Self { task, holds: Vec::new(), scores, env_steps: 0, outcome: None }
    }

    /// Records one more cycle of a lane.
    fn push(&mut self, lane: usize, pattern: Pattern, displacement: f64) {
        let holds = &mut self.holds[lane];
        let before = holds.last().map(|hold| hold.pattern);
        match holds.last_mut() {
            Some(hold) if hold.pattern == pattern => hold.cycles.push(displacement),
            _ => holds.push(PatternHold { before, pattern, cycles: vec![displacement], height: 0.0 }),
        }
    }

    fn fail(&mut self, fault: Option<nbc_base::model::Fault>) {
        if self.outcome.is_none() {
            self.outcome = fault.map(CandidateOutcome::Faulty);
        }
    }

    /// Computes the scores so far, and decides whether to continue.
    fn look(&mut self) {
        let cycles = self.holds[0][0].cycles.len();
        if self.outcome.is_some() || cycles < FIRST_LOOK {
            return;
        }
        if self.holds[0].len() == 1 {
            self.scores.displacement = settled_displacement(&self.holds[..WALKS.len()]);
            self.scores.behavior = Behavior::of(&self.scores.displacement);
        }
        self.scores.fitness = fitness(self.scores.behavior, self.holds.iter().flatten());
        if self.scores.fitness[0] < HOPELESS {
            self.outcome = Some(CandidateOutcome::Inconsistent);
        } else if cycles >= HOLD && !self.task.rivals.admit(self.scores.behavior, &self.scores.fitness) {
            self.outcome = Some(CandidateOutcome::Surpassed);
        }
    }

    /// Its result; a full evaluation has `all` env steps.
    fn end(self, all: u64) -> Evaluated {
        let outcome = self.outcome.unwrap_or(CandidateOutcome::Measured(self.scores));
        Evaluated { outcome, work: Work { env_steps: self.env_steps, left_out: all - self.env_steps } }
    }
}

/// Displacement under each pattern at the fresh starts of the walks, without the first cycle, in which the body finds
/// its shape.
fn settled_displacement(walks: &[Vec<PatternHold>]) -> [f64; 4] {
    let mut displacement = [0.0; 4];
    for hold in walks.iter().filter_map(|holds| holds.first()) {
        displacement[hold.pattern.pair_index()] = hold.cycles[1..].iter().sum();
    }
    displacement
}

/// Two fitnesses between 0 and 1, where one half means that the worst cycle stands still: the output from the second,
/// third and fourth cycle of a hold on, and the output in every cycle of holds that should not change it.
fn fitness<'a>(behavior: Behavior, holds: impl Iterator<Item = &'a PatternHold> + Clone) -> [f64; 2] {
    let from = |clock: usize| holds.clone().flat_map(move |hold| hold.rightward(behavior).skip(clock - 1));
    let settled = CLOCKS.map(|clock| worth(least(from(clock))));
    let is_static = |hold: &&PatternHold| {
        hold.before.is_none_or(|before| behavior.direction(before) == behavior.direction(hold.pattern))
    };
    // A fresh start is not a switch, so its first cycle is not counted.
    let cycles = |hold: &'a PatternHold| hold.rightward(behavior).skip(usize::from(hold.before.is_none()));
    [settled.iter().sum::<f64>() / CLOCKS.len() as f64, worth(least(holds.clone().filter(is_static).flat_map(cycles)))]
}

fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

/// A margin as a number between 0 and 1.
fn worth(margin: f64) -> f64 {
    if margin.is_infinite() { 1.0 } else { 0.5 + 0.5 * margin / (margin.abs() + HALF_MARGIN) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::{Candidate, Rivals, Search};
    use nbc_base::model::{Evolution, SearchObjective, WorldFactors};

    #[test]
    fn the_walks_make_every_switch_once() {
        let mut switches: Vec<(usize, usize)> =
            WALKS.iter().flat_map(|walk| walk.windows(2).map(|w| (w[0], w[1]))).collect();
        switches.sort_unstable();
        switches.dedup();
        assert_eq!(switches.len(), 12);
        assert!(switches.iter().all(|(from, to)| from != to));
        assert!(random_sequences().iter().all(|lane| lane.len() == RANDOM_CYCLES));
        let cycles = walks().iter().chain(&random_sequences()).map(Vec::len).sum::<usize>();
        assert_eq!(cycles as u64 * u64::from(CYCLE_STEPS), STEPS);
    }

    #[test]
    fn the_score_is_the_least_of_all_worlds() {
        let factors = WorldFactors { friction: 0.5, gravity: 1.4, ..WorldFactors::default() };
        let world = PhysicsWorld { factors, ..PhysicsWorld::default() };
        let evolution = Evolution { objective: SearchObjective::Gate, ..crate::evolve::tests::evolution() };
        let search = Search::new(&evolution, 5);
        let task = |candidate: &Candidate| EvaluationTask { body: candidate.body.clone(), rivals: Rivals::none() };
        let tasks: Vec<EvaluationTask> = search.ask().iter().take(4).map(task).collect();
        let scores = |others, tasks| {
            let protocol = EvaluationProtocol { others, ..EvaluationProtocol::of(&evolution) };
            let done = evaluate(&Simulator::default(), &protocol, tasks);
            assert!(done.iter().all(|one| one.work.env_steps + one.work.left_out == steps(&protocol)));
            done.into_iter().map(|one| one.outcome).collect::<Vec<_>>()
        };
        let [alone, both] = [vec![], vec![world]].map(|others| scores(others, &tasks));
        assert_eq!(scores(vec![PhysicsWorld::default()], &tasks[..2]), alone[..2], "the same world again");
        let mut lower = 0;
        for pair in alone.iter().zip(&both) {
            match pair {
                (CandidateOutcome::Measured(one), CandidateOutcome::Measured(two)) => {
                    assert!(two.fitness[0] <= one.fitness[0] && two.fitness[1] <= one.fitness[1]);
                    assert_eq!(two.behavior, one.behavior, "the behavior is that of the first world");
                    lower += usize::from(two.fitness != one.fitness);
                }
                (CandidateOutcome::Measured(_), two) => assert_eq!(two, &CandidateOutcome::Inconsistent),
                (one, two) => assert_eq!(one, two),
            }
        }
        assert!(lower > 0, "{alone:?}");
    }

    fn hold(before: Option<usize>, pattern: usize, cycles: &[f64]) -> PatternHold {
        let pairs = Pattern::PAIRS;
        PatternHold { before: before.map(|i| pairs[i]), pattern: pairs[pattern], cycles: cycles.to_vec(), height: 0.0 }
    }

    #[test]
    fn a_wrong_first_cycle_counts_only_where_the_output_should_not_change() {
        let nand: Behavior = "RRRL".parse().unwrap();
        let start = hold(None, 0, &[-9.0, 0.05, 0.05, 0.05]);
        let switch = hold(Some(0), 3, &[9.0, -0.05, -0.05, -0.05]);
        let quiet = hold(Some(0), 1, &[-0.05, 0.05, 0.05, 0.05]);
        assert_eq!(fitness(nand, [start.clone(), switch.clone()].iter()), [0.75, 0.75]);
        assert_eq!(fitness(nand, [start, switch, quiet].iter()), [0.75, 0.25]);
    }

    #[test]
    fn more_holds_never_raise_the_fitness() {
        let nand: Behavior = "RRRL".parse().unwrap();
        let holds: Vec<PatternHold> =
            (0..40).map(|i| hold((i > 0).then_some((i + 1) % 4), i % 4, &[0.3, 0.1 - 0.01 * i as f64, 0.2])).collect();
        let fitnesses: Vec<[f64; 2]> = (1..40).map(|n| fitness(nand, holds[..n].iter())).collect();
        assert!(fitnesses.windows(2).all(|two| two[1][0] <= two[0][0] && two[1][1] <= two[0][1]));
    }
}
