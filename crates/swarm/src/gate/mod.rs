//! The objectives of gates: the correct output soon after any switch of the inputs, and no wrong cycle while the output
//! should not change; or, for waves, the correct output in every cycle (docs/evolution.md, The gate objective).

mod lanes;
mod settled;
mod wave;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::Work;
use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask, setting};
use crate::evolve::{CandidateOutcome, Scores};
use crate::gate::lanes::{HOLD, Lane, sensed, starts, stretches};
use crate::holds::PatternHold;
use crate::noise::RobotNoise;
use nbc_base::model::{Behavior, Body, CYCLE_STEPS, Displacements, Pattern, PhysicsWorld, SearchObjective};
use nbc_sim::Simulator;

/// A candidate with a first fitness below this is dropped at once, even if its niche is empty.
const HOPELESS: f64 = 0.25;
/// Cycles after a fresh start until bodies that walk both ways can be recognized.
const FIRST_LOOK: usize = 3;

/// The seed of the random sequences: the same for every candidate, and different from that of `characterize`.
const RANDOM_SEED: u64 = 0x6761_7465;

/// Those from each pattern, one hold each, and then random ones.
fn stages(objective: SearchObjective, stimuli: usize) -> [Vec<Lane>; 2] {
    let rng = &mut ChaCha8Rng::seed_from_u64(RANDOM_SEED);
    if objective == SearchObjective::Wave { wave::stages(stimuli, rng) } else { settled::stages(stimuli, rng) }
}

/// More holds and longer ones never raise the fitnesses.
fn fitness<'a>(
    objective: SearchObjective,
    behavior: Behavior,
    holds: impl Iterator<Item = &'a PatternHold> + Clone,
) -> [f64; 2] {
    if objective == SearchObjective::Wave { wave::fitness(behavior, holds) } else { settled::fitness(behavior, holds) }
}

pub(super) fn steps(protocol: &EvaluationProtocol) -> u64 {
    let cycles: usize = stages(protocol.objective, protocol.stimuli).iter().flatten().map(Vec::len).sum();
    cycles as u64 * u64::from(CYCLE_STEPS) * (1 + protocol.others.len() as u64)
}

/// The simulations from each pattern, then the random ones, then both in each other world while the body is right.
/// Bodies that can no longer enter a niche are dropped after each cycle; their scores can only decrease.
pub(crate) fn evaluate(
    simulator: &Simulator,
    protocol: &EvaluationProtocol,
    tasks: &[EvaluationTask],
) -> Vec<Evaluated> {
    let mut attempts: Vec<Attempt> = tasks.iter().map(|task| Attempt::new(protocol, task)).collect();
    let stages = stages(protocol.objective, protocol.stimuli);
    for world in std::iter::once(&protocol.world).chain(&protocol.others) {
        for (stage, lanes) in stages.iter().enumerate() {
            for attempt in &mut attempts {
                attempt.holds.resize(attempt.holds.len() + lanes.len(), Vec::new());
            }
            try_lanes(simulator, world, &mut attempts, lanes, stage * starts(protocol.stimuli));
        }
        attempts.iter_mut().for_each(Attempt::leave_world);
    }
    let all = steps(protocol);
    attempts.into_iter().map(|attempt| attempt.end(all)).collect()
}

/// The first lane is lane `first` of its world. The holds are the last ones of each attempt.
fn try_lanes(simulator: &Simulator, world: &PhysicsWorld, attempts: &mut [Attempt], lanes: &[Lane], first: usize) {
    let noise = RobotNoise::new(&world.noise, 0);
    let sensed: Vec<Lane> = (first..).zip(lanes).map(|(lane, cycles)| sensed(world, lane, cycles)).collect();
    let mut open: Vec<&mut Attempt> = attempts.iter_mut().filter(|attempt| attempt.is_open()).collect();
    let bodies: Vec<Body> = open.iter().flat_map(|attempt| vec![noise.worn(&attempt.task.body); lanes.len()]).collect();
    let mut flock = simulator.flock(&setting(world), &bodies);
    for cycle in 0..lanes[0].len() {
        let before: Vec<f64> = (0..flock.len()).map(|i| flock.center(i)[0]).collect();
        for (steps, patterns) in stretches(world, first, &sensed, cycle) {
            flock.advance(&patterns.repeat(open.len()), steps);
        }
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
        let keep: Vec<bool> = open.iter().flat_map(|attempt| vec![attempt.is_open(); lanes.len()]).collect();
        flock.retain(&keep);
        open.retain(|attempt| attempt.is_open());
    }
}

struct Attempt<'a> {
    objective: SearchObjective,
    /// The behaviors that it may be scored as; if there are none, its own.
    asked: &'a [Behavior],
    own: Behavior,
    others: usize,
    passed: usize,
    is_done: bool,
    task: &'a EvaluationTask,
    holds: Vec<Vec<PatternHold>>,
    scores: Scores,
    env_steps: u64,
    outcome: Option<CandidateOutcome>,
}

impl<'a> Attempt<'a> {
    fn new(protocol: &'a EvaluationProtocol, task: &'a EvaluationTask) -> Self {
        let displacement = Displacements::zero(protocol.stimuli);
        let scores = Scores { fitness: [1.0; 2], behavior: displacement.behavior(), displacement };
        let asked = protocol.behaviors.as_slice();
        Self {
            objective: protocol.objective,
            asked,
            own: scores.behavior,
            others: protocol.others.len(),
            passed: 0,
            is_done: false,
            task,
            holds: Vec::new(),
            scores,
            env_steps: 0,
            outcome: None,
        }
    }

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

    fn look(&mut self) {
        let cycles = self.holds[0][0].cycles.len();
        if self.outcome.is_some() || cycles < FIRST_LOOK {
            return;
        }
        if self.holds[0].len() == 1 {
            self.scores.displacement = settled_displacement(&self.holds[..starts(self.own.stimuli())]);
            self.own = self.scores.displacement.behavior();
        }
        let Bound { is_open, behavior, raw } = self.bound();
        (self.scores.behavior, self.scores.fitness) = (behavior, self.over_worlds(raw));
        if self.passed == 0 && raw[0] < HOPELESS {
            self.outcome = Some(CandidateOutcome::Inconsistent);
        } else if cycles >= HOLD && !is_open {
            self.outcome = Some(CandidateOutcome::Surpassed);
        }
    }

    fn bound(&self) -> Bound {
        let asked = match (self.passed, self.asked) {
            (0, []) => &[self.own],
            (0, asked) => asked,
            // In other worlds it must be the same gate as in its own.
            _ => &[self.scores.behavior],
        };
        let bound = |&behavior: &_| {
            let raw = fitness(self.objective, behavior, self.holds.iter().flatten());
            Bound { is_open: self.task.rivals.admit(behavior, &self.over_worlds(raw)), behavior, raw }
        };
        let bounds = asked.iter().map(bound);
        // The first of equals.
        let nearer = |best: Bound, next: Bound| {
            if (next.is_open, next.raw[0]) > (best.is_open, best.raw[0]) { next } else { best }
        };
        bounds.reduce(nearer).expect("there is at least one")
    }

    /// The fitnesses over all worlds. A wrong world counts with its own fitness, and the worlds before it as one each;
    /// as long as the body is right, all other worlds count as one.
    fn over_worlds(&self, raw: [f64; 2]) -> [f64; 2] {
        let counted = if is_right(raw) { self.others } else { self.passed };
        raw.map(|own| (counted as f64 + own) / (self.others + 1) as f64)
    }

    fn leave_world(&mut self) {
        if self.is_open() {
            self.is_done = !is_right(self.bound().raw);
            self.passed += usize::from(!self.is_done);
        }
    }

    fn is_open(&self) -> bool {
        self.outcome.is_none() && !self.is_done
    }

    /// A full evaluation has `all` env steps.
    fn end(self, all: u64) -> Evaluated {
        let outcome = self.outcome.unwrap_or(CandidateOutcome::Measured(self.scores));
        Evaluated { outcome, work: Work { env_steps: self.env_steps, left_out: all - self.env_steps } }
    }
}

struct Bound {
    is_open: bool,
    behavior: Behavior,
    raw: [f64; 2],
}

fn is_right(raw: [f64; 2]) -> bool {
    raw.iter().all(|score| *score > 0.5)
}

/// At the fresh starts, without the first cycle, in which the body finds its shape. A walk from each pattern, in order.
fn settled_displacement(walks: &[Vec<PatternHold>]) -> Displacements {
    let moved: Vec<f64> = walks.iter().map(|holds| holds[0].cycles[1..].iter().sum()).collect();
    Displacements::try_from(moved).expect("there is a walk from each pattern")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::{Candidate, Rivals, Search};
    use crate::gate::lanes::tests::{hold, nand};
    use nbc_base::model::{Evolution, Palette, WorldFactors};

    #[test]
    fn a_body_is_tried_in_worlds_until_it_is_wrong_in_one() {
        let light = PhysicsWorld {
            factors: WorldFactors { gravity: 0.1, ..WorldFactors::default() },
            ..PhysicsWorld::default()
        };
        let evolution = Evolution { objective: SearchObjective::Gate, ..crate::evolve::tests::evolution() };
        let scores = |rows: [&str; 5], others: &[PhysicsWorld]| {
            let body = Body::parse(&rows, &Palette::paper()).unwrap();
            let protocol = EvaluationProtocol { others: others.to_vec(), ..EvaluationProtocol::of(&evolution) };
            let task = EvaluationTask { body, rivals: Rivals::none(2), expected: None };
            let done = evaluate(&Simulator::default(), &protocol, &[task]);
            assert_eq!(done[0].work.env_steps + done[0].work.left_out, steps(&protocol));
            let CandidateOutcome::Measured(scores) = done[0].outcome else { panic!("{:?}", done[0]) };
            (scores.fitness, done[0].work.env_steps)
        };
        let own = PhysicsWorld::default();
        // Robots of the library: a NOT, and an XOR that glitches.
        let gate = ["33388", "44886", "40086", "40086", "40066"];
        let glitching = ["33333", "30000", "88500", "48554", "44444"];
        let (alone, one) = scores(gate, &[]);
        assert!(is_right(alone));
        assert_eq!(scores(gate, &[own, own]), (alone.map(|score| (2.0 + score) / 3.0), 3 * one));
        let (wrong, taken) = scores(gate, &[own, light, own]);
        assert!(wrong.iter().any(|score| *score < 2.5 / 4.0) && wrong.iter().all(|score| *score > 2.0 / 4.0));
        assert_eq!(taken, 3 * one, "the last world is left out");
        let (alone, one) = scores(glitching, &[]);
        assert!(!is_right(alone));
        assert_eq!(scores(glitching, &[own, own]), (alone.map(|score| score / 3.0), one));
    }

    #[test]
    fn a_body_is_scored_as_the_nearest_behavior_that_is_asked_for() {
        let evolution =
            Evolution { objective: SearchObjective::Wave, width: 2, height: 3, ..crate::evolve::tests::evolution() };
        let task = |candidate: &Candidate| EvaluationTask {
            body: candidate.body.clone(),
            rivals: Rivals::none(2),
            expected: None,
        };
        let tasks: Vec<EvaluationTask> = Search::new(&evolution, 5).ask().iter().take(2).map(task).collect();
        let asked = ["LRRL", "RLLR"].map(|behavior| behavior.parse::<Behavior>().unwrap());
        let scores = |behaviors: &[Behavior]| {
            let protocol = EvaluationProtocol { behaviors: behaviors.to_vec(), ..EvaluationProtocol::of(&evolution) };
            let done = evaluate(&Simulator::default(), &protocol, &tasks);
            done.into_iter().map(|one| match one.outcome {
                CandidateOutcome::Measured(scores) => Some((scores.behavior, scores.fitness)),
                _ => None,
            })
        };
        let best = |one: (Behavior, [f64; 2]), two: (Behavior, [f64; 2])| if two.1[0] > one.1[0] { two } else { one };
        let [xor, xnor] = asked.map(|behavior| scores(&[behavior]));
        let nearest: Vec<_> = xor.zip(xnor).map(|(xor, xnor)| xor.into_iter().chain(xnor).reduce(best)).collect();
        assert!(nearest.iter().flatten().count() > 1);
        assert_eq!(scores(&asked).collect::<Vec<_>>(), nearest);
    }

    #[test]
    fn more_holds_never_raise_the_fitness() {
        let holds: Vec<PatternHold> =
            (0..40).map(|i| hold((i > 0).then_some((i + 1) % 4), i % 4, &[0.3, 0.1 - 0.01 * i as f64, 0.2])).collect();
        for objective in [SearchObjective::Gate, SearchObjective::Wave] {
            let fitnesses: Vec<[f64; 2]> = (1..40).map(|n| fitness(objective, nand(), holds[..n].iter())).collect();
            assert!(fitnesses.windows(2).all(|two| two[1][0] <= two[0][0] && two[1][1] <= two[0][1]), "{objective:?}");
        }
    }
}
