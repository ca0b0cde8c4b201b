//! The objective of images: a body walks one way before the images of some sets and the other way before those of the
//! others, and the least of all distances counts (Mertan and Cheney 2025).

use crate::Work;
use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask, setting};
use crate::evolve::{CandidateOutcome, Scores};
use crate::noise::RobotNoise;
use nbc_base::model::{
    Behavior, Body, Displacements, Fault, ImageOrder, Pattern, PhysicsWorld, Schedule, Spell, Trajectory, Trial,
};
use nbc_sim::Simulator;

const STIMULI: usize = 2;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageDistance {
    /// The way in which the body walks before each set; a pattern is the number of a set. Of the behaviors that tell
    /// sets apart, it is the one with the greatest least distance.
    pub behavior: Behavior,
    /// The least distance in the direction of the behavior, in voxels; negative if the body walked the other way.
    pub least: f64,
    /// For each pattern the displacement before the image of its set for which the distance is least.
    pub displacement: Displacements,
}

impl ImageDistance {
    pub fn of(sets: &ImageSets, walked: &[(Pattern, f64)]) -> Self {
        let all = sets.behaviors().map(|behavior| (behavior, least(behavior, walked.iter().copied())));
        let best = all.fold(None, |best: Option<(Behavior, f64)>, one| match best {
            Some(best) if best.1 >= one.1 => Some(best),
            _ => Some(one),
        });
        let (behavior, distance) = best.expect("two sets can be told apart");
        let displacement = Displacements::under(STIMULI, |pattern| {
            let set = sets.of_pattern(pattern);
            let own = walked.iter().copied().filter(|(of, _)| *of == set);
            least(behavior, own) * behavior.direction(set).sign()
        });
        Self { behavior, least: distance, displacement }
    }
}

fn least(behavior: Behavior, walked: impl Iterator<Item = (Pattern, f64)>) -> f64 {
    walked.map(|(set, moved)| moved * behavior.direction(set).sign()).fold(f64::INFINITY, f64::min)
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageSets(Vec<Pattern>);

impl ImageSets {
    pub const MOST: usize = 1 << STIMULI;

    pub fn of(schedule: &Schedule) -> Self {
        let mut sets: Vec<Pattern> = schedule.spells.iter().map(|spell| spell.pattern).collect();
        sets.sort_unstable();
        sets.dedup();
        Self(sets)
    }

    pub fn count(&self) -> usize {
        self.0.len()
    }

    pub fn can_be_told(&self) -> bool {
        let first = [Pattern::new(&[false]), Pattern::new(&[true])];
        let all: Vec<Pattern> = Pattern::all(STIMULI).collect();
        first.iter().all(|set| self.0.contains(set)) && self.0.iter().all(|set| all.contains(set))
    }

    /// The set of a pattern: that of its number, or of its first stimulus alone if there are not so many sets.
    fn of_pattern(&self, pattern: Pattern) -> Pattern {
        if self.0.contains(&pattern) { pattern } else { Pattern::new(&[pattern.has(0)]) }
    }

    fn behaviors(&self) -> impl Iterator<Item = Behavior> + '_ {
        let depends = move |b: &Behavior| {
            b.patterns().all(|pattern| b.direction(pattern) == b.direction(self.of_pattern(pattern)))
        };
        let differs = move |b: &Behavior| self.0.iter().any(|&set| b.direction(set) != b.direction(self.0[0]));
        Behavior::all(STIMULI).filter(depends).filter(differs)
    }
}

/// For each body its displacement before each image of a schedule, in voxels, or the fault of the simulation.
pub fn image_displacements(
    simulator: &Simulator,
    world: &PhysicsWorld,
    order: ImageOrder,
    schedule: &Schedule,
    bodies: &[Body],
) -> Vec<Vec<Result<f64, Fault>>> {
    let noise = RobotNoise::new(&world.noise, 0);
    let parts: Vec<Schedule> = match order {
        ImageOrder::Apart => schedule.spells.iter().map(|spell| Schedule { spells: vec![spell.clone()] }).collect(),
        ImageOrder::InTurn => vec![schedule.clone()],
    };
    let trial = |body: &Body, part: &Schedule| Trial { body: body.clone(), schedule: noise.sensed(part) };
    let worn: Vec<Body> = bodies.iter().map(|body| noise.worn(body)).collect();
    let trials: Vec<Trial> = worn.iter().flat_map(|body| parts.iter().map(|part| trial(body, part))).collect();
    let trajectories = simulator.run_trials(&setting(world), &trials);
    let moved = |(trajectory, part): (&Trajectory, &Schedule)| {
        let ended = || trajectory.fault.expect("a simulation without a fault goes to its end");
        trajectory.displacements(part).into_iter().map(|moved| moved.ok_or_else(ended)).collect::<Vec<_>>()
    };
    let of_body = |own: &[Trajectory]| own.iter().zip(&parts).flat_map(moved).collect();
    trajectories.chunks(parts.len().max(1)).map(of_body).collect()
}

struct Viewer<'a> {
    task: &'a EvaluationTask,
    walked: Vec<(Pattern, f64)>,
    env_steps: u64,
    outcome: Option<CandidateOutcome>,
}

impl Viewer<'_> {
    fn is_admitted(&self, sets: &ImageSets) -> bool {
        let bound = |behavior| [least(behavior, self.walked.iter().copied()); 2];
        sets.behaviors().any(|behavior| self.task.rivals.admit(behavior, &bound(behavior)))
    }

    fn measured(&self, sets: &ImageSets) -> CandidateOutcome {
        let ImageDistance { behavior, least, displacement } = ImageDistance::of(sets, &self.walked);
        let fitness = [least; 2];
        match self.task.rivals.admit(behavior, &fitness) {
            true => CandidateOutcome::Measured(Scores { fitness, behavior, displacement }),
            false => CandidateOutcome::Surpassed,
        }
    }
}

/// Images with fresh starts come in rounds, one of each set, so that a hopeless body is dropped after some of them.
pub(crate) fn evaluate(
    simulator: &Simulator,
    protocol: &EvaluationProtocol,
    tasks: &[EvaluationTask],
) -> Vec<Evaluated> {
    let sets = ImageSets::of(&protocol.variable);
    let viewer = |task| Viewer { task, walked: Vec::new(), env_steps: 0, outcome: None };
    let mut viewers: Vec<Viewer<'_>> = tasks.iter().map(viewer).collect();
    for round in rounds(protocol) {
        let mut open: Vec<&mut Viewer<'_>> = viewers.iter_mut().filter(|viewer| viewer.outcome.is_none()).collect();
        let bodies: Vec<Body> = open.iter().map(|viewer| viewer.task.body.clone()).collect();
        let walked = image_displacements(simulator, &protocol.world, protocol.shown, &round, &bodies);
        for (viewer, walked) in open.iter_mut().zip(walked) {
            viewer.env_steps += u64::from(round.steps());
            match walked.into_iter().collect::<Result<Vec<f64>, Fault>>() {
                Err(fault) => viewer.outcome = Some(CandidateOutcome::Faulty(fault)),
                Ok(moved) => viewer.walked.extend(round.spells.iter().map(|spell| spell.pattern).zip(moved)),
            }
            if viewer.outcome.is_none() && !viewer.is_admitted(&sets) {
                viewer.outcome = Some(CandidateOutcome::Surpassed);
            }
        }
    }
    let whole = u64::from(protocol.variable.steps());
    let result = |viewer: Viewer<'_>| Evaluated {
        outcome: viewer.outcome.unwrap_or_else(|| viewer.measured(&sets)),
        work: Work { env_steps: viewer.env_steps, left_out: whole - viewer.env_steps },
    };
    viewers.into_iter().map(result).collect()
}

fn rounds(protocol: &EvaluationProtocol) -> Vec<Schedule> {
    let spells = &protocol.variable.spells;
    if protocol.shown == ImageOrder::InTurn {
        return vec![protocol.variable.clone()];
    }
    let place = |at: usize| spells[..at].iter().filter(|spell| spell.pattern == spells[at].pattern).count();
    let mut rounds: Vec<Schedule> = Vec::new();
    for (at, spell) in spells.iter().enumerate() {
        let round = place(at);
        rounds.resize(rounds.len().max(round + 1), Schedule::default());
        rounds[round].spells.push(Spell::clone(spell));
    }
    rounds
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::evolve::{Rivals, Search};
    use nbc_base::model::{
        Axis, Count, Evolution, Genome, Image, ImageSize, Material, MaterialKind, Palette, Response, SearchObjective,
    };

    const A: usize = 0;
    const B: usize = 1;

    fn number(set: usize) -> Pattern {
        Schedule::of_set(set)
    }

    fn schedule(images: &[(usize, [u8; 9])]) -> Schedule {
        let spell = |&(set, pixels): &(usize, [u8; 9])| {
            let image = Image::new(ImageSize::new(3, 3), pixels.map(|pixel| f64::from(pixel) / 4.0).to_vec()).unwrap();
            Spell { image: Some(Arc::new(image)), ..Spell::of(number(set), 40) }
        };
        Schedule { spells: images.iter().map(spell).collect() }
    }

    fn evolution(shown: ImageOrder) -> Evolution {
        let mut materials = Palette::paper().materials()[..4].to_vec();
        let sensor = |name: &str, absent, present| {
            let response = Response { image: Some(ImageSize::new(3, 3)), ..Response::of(0, absent, present) };
            Material { name: name.to_owned(), kind: MaterialKind::Sensor(response) }
        };
        materials.extend([sensor("dark", 1.6, 0.6), sensor("light", 0.6, 1.6)]);
        let images = [
            (A, [4, 3, 4, 0, 0, 0, 1, 0, 0]),
            (A, [4, 4, 4, 0, 0, 0, 0, 0, 0]),
            (B, [0, 0, 0, 0, 1, 0, 4, 4, 4]),
            (B, [0, 0, 1, 0, 0, 0, 4, 4, 3]),
        ];
        let count = |of| Axis::Count { of, bins: 2 };
        Evolution {
            width: 3,
            height: 3,
            palette: Arc::new(Palette::new(materials)),
            genome: Genome::Voxels { crossover: 0.0 },
            objective: SearchObjective::Images,
            variable: schedule(&images),
            shown,
            descriptors: vec![count(Count::Voxels), count(Count::Sensory)],
            ..crate::evolve::tests::evolution()
        }
    }

    #[test]
    fn the_least_distance_counts_for_the_better_of_both_directions() {
        let check = |walked: &[(usize, f64)], behavior: &str, least: f64, displacement: [f64; 4]| {
            let walked: Vec<(Pattern, f64)> = walked.iter().map(|&(set, moved)| (number(set), moved)).collect();
            let sets = ImageSets(vec![number(0), number(1)]);
            let found = ImageDistance::of(&sets, &walked);
            assert_eq!((found.behavior.to_string().as_str(), found.least), (behavior, least), "{walked:?}");
            assert_eq!(*found.displacement, displacement, "{walked:?}");
        };
        check(&[(A, 3.0), (B, -2.0)], "RRLL", 2.0, [3.0, 3.0, -2.0, -2.0]);
        check(&[(A, -3.0), (A, -1.0), (B, 2.0), (B, 5.0)], "LLRR", 1.0, [-1.0, -1.0, 2.0, 2.0]);
        // A body that always walks to the right is wrong by its least distance before one set.
        check(&[(A, 3.0), (B, 1.0)], "RRLL", -1.0, [3.0, 3.0, 1.0, 1.0]);
    }

    #[test]
    fn four_sets_have_fourteen_behaviors_and_two_sets_two() {
        let sets = |count: usize| ImageSets::of(&schedule(&(0..count).map(|set| (set, [0; 9])).collect::<Vec<_>>()));
        assert_eq!([2, 3, 4].map(|count| sets(count).behaviors().count()), [2, 6, 14]);
    }

    #[test]
    fn what_is_left_out_changes_no_result_that_enters() {
        for shown in [ImageOrder::Apart, ImageOrder::InTurn] {
            let evolution = evolution(shown);
            let (protocol, mut search) = (EvaluationProtocol::of(&evolution), Search::new(&evolution, 2));
            let mut left_out = 0;
            for _ in 0..5 {
                let candidates = search.ask();
                let tasks: Vec<_> = candidates.iter().map(|candidate| EvaluationTask::of(&search, candidate)).collect();
                let found = crate::evaluate_tasks(&Simulator::default(), &protocol, &tasks);
                for (found, task) in found.iter().zip(&tasks) {
                    let free = EvaluationTask { rivals: Rivals::none(2), ..task.clone() };
                    let whole = crate::evaluate_tasks(&Simulator::default(), &protocol, &[free])[0];
                    assert_eq!(found.work.env_steps + found.work.left_out, 160);
                    left_out += found.work.left_out;
                    match (found.outcome, whole.outcome) {
                        (CandidateOutcome::Surpassed, CandidateOutcome::Measured(scores)) => {
                            assert!(!task.rivals.admit(scores.behavior, &scores.fitness));
                        }
                        (one, other) => assert_eq!(one, other),
                    }
                }
                let outcomes: Vec<_> = found.iter().map(|found| found.outcome).collect();
                search.tell(&candidates, &outcomes);
            }
            assert_eq!(left_out > 0, shown == ImageOrder::Apart);
        }
    }

    #[test]
    fn images_apart_begin_afresh_and_images_in_turn_go_on() {
        let evolution = evolution(ImageOrder::Apart);
        let body = Body::parse(&["353", "343", "663"], &evolution.palette).unwrap();
        let moved = |order, schedule: &Schedule| {
            let world = PhysicsWorld::default();
            let bodies = std::slice::from_ref(&body);
            let walked = image_displacements(&Simulator::default(), &world, order, schedule, bodies).remove(0);
            walked.into_iter().collect::<Result<Vec<f64>, Fault>>().unwrap()
        };
        let [apart, in_turn] = [ImageOrder::Apart, ImageOrder::InTurn].map(|order| moved(order, &evolution.variable));
        assert_eq!((apart.len(), in_turn.len()), (4, 4));
        assert_eq!(apart[0], in_turn[0]);
        assert!((1..4).all(|at| apart[at] != in_turn[at]));
        let last = Schedule { spells: vec![evolution.variable.spells[3].clone()] };
        assert_eq!(moved(ImageOrder::InTurn, &last), [apart[3]]);
    }
}
