//! The distance objective: a fixed simulation under each pattern, then the long one, each only for bodies that can
//! still enter the archive (docs/evolution.md, What is left out).
//!
//! What a body does under a pattern depends on the protocol and the body alone. So the result of a task is found by
//! reading what its body is known to do, in the task's own order, until something is missing; that is then simulated.
//! Results and counts are the same whatever was known before, or is simulated together.

mod leg;
mod plan;
mod walker;
mod walks;

pub(crate) use walks::WalkMemory;

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use crate::distance::leg::{Leg, LegEnd, advance};
use crate::distance::plan::{Next, SimulationPlan, Walk};
use crate::distance::walker::Walker;
use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask};
use crate::noise::RobotNoise;
use nbc_base::model::{Body, Displacements, Fault, Pattern, Setting};
use nbc_sim::Simulator;

pub(crate) fn evaluate(
    simulator: &Simulator,
    memory: &WalkMemory,
    protocol: &EvaluationProtocol,
    tasks: &[EvaluationTask],
) -> Vec<Evaluated> {
    let plan = SimulationPlan::new(protocol);
    let noise = RobotNoise::new(&protocol.world.noise, 0);
    let mut numbers: BTreeMap<&Body, usize> = BTreeMap::new();
    let (mut bodies, mut walkers) = (Vec::new(), Vec::new());
    for task in tasks {
        numbers.entry(&task.body).or_insert_with(|| {
            bodies.push(&task.body);
            walkers.push(Walker::new(noise.worn(&task.body)));
            walkers.len() - 1
        });
    }
    memory.recall(protocol, bodies.iter().copied().zip(walkers.iter_mut().map(|walker| &mut walker.walks)));
    let tasks: Vec<(&EvaluationTask, usize)> = tasks.iter().map(|task| (task, numbers[&task.body])).collect();
    loop {
        let wanted = wanted(&plan, &tasks, &walkers, simulator.at_once());
        if wanted.is_empty() {
            break;
        }
        plan.walk(simulator, &mut walkers, &wanted);
    }
    for walker in &mut walkers {
        walker.walks.long = plan.long(walker);
    }
    memory.keep(protocol, bodies.into_iter().zip(walkers.iter().map(|walker| &walker.walks)));
    let result = |(task, walker): (&EvaluationTask, usize)| match plan.next(task, &walkers[walker]) {
        Next::Done(evaluated) => evaluated,
        next => panic!("all that an evaluation needs was simulated, except {next:?}"),
    };
    tasks.into_iter().map(result).collect()
}

/// In voxels, or the first fault. Patterns that differ only in stimuli that a body does not sense are simulated once.
pub fn fixed_displacements(
    simulator: &Simulator,
    setting: &Setting,
    bodies: &[Body],
    steps: u32,
) -> Vec<Result<Displacements, Fault>> {
    let walkers: Vec<Walker> = bodies.iter().map(|body| Walker::new(body.clone())).collect();
    let pairs = |(n, walker): (usize, &Walker)| walker.different().into_iter().map(move |pattern| (n, pattern));
    let different: Vec<(usize, Pattern)> = (0..).zip(&walkers).flat_map(pairs).collect();
    let leg = |&(n, pattern): &(usize, Pattern)| Leg::fixed(&walkers[n].body, pattern, steps);
    let ends = advance(simulator, setting, &different.iter().map(leg).collect::<Vec<_>>());
    let moved: BTreeMap<(usize, Pattern), Result<f64, Fault>> =
        different.into_iter().zip(ends.iter().map(LegEnd::moved)).collect();
    let walked = |(n, walker): (usize, &Walker)| {
        let each = walker.sensed.iter().map(|&pattern| moved[&(n, pattern)]);
        let each = each.collect::<Result<Vec<f64>, Fault>>()?;
        Ok(Displacements::try_from(each).expect("one for each pattern of two or three stimuli"))
    };
    walkers.iter().enumerate().map(walked).collect()
}

/// One of each undecided body, first of those that will probably need most, and only as many as are simulated at once,
/// because the others can wait. Room that is left goes to those that will probably be needed soonest.
fn wanted(
    plan: &SimulationPlan,
    tasks: &[(&EvaluationTask, usize)],
    walkers: &[Walker],
    at_once: usize,
) -> Vec<(usize, Walk)> {
    let (mut needed, mut likely, mut unlikely) = (BTreeMap::new(), Vec::new(), Vec::new());
    for &(task, walker) in tasks {
        let (walk, legs) = match plan.next(task, &walkers[walker]) {
            Next::Done(_) => continue,
            Next::Long { legs } => (Walk::Long, legs),
            Next::Fixed { missing, likely: many, legs } => {
                let later = (1..).zip(&missing[1..]).map(|(place, &pattern)| (place, walker, Walk::Fixed(pattern)));
                let (soon, late): (Vec<_>, Vec<_>) = later.partition(|(place, ..)| *place < many);
                likely.extend(soon);
                unlikely.extend(late);
                (Walk::Fixed(missing[0]), legs)
            }
        };
        let most = needed.entry((walker, walk)).or_insert(legs);
        *most = legs.max(*most);
    }
    let mut needed: Vec<((usize, Walk), usize)> = needed.into_iter().collect();
    needed.sort_by_key(|&(_, legs)| Reverse(legs));
    let room = (needed.len() / at_once).max(usize::from(!needed.is_empty())) * at_once;
    likely.sort_unstable();
    unlikely.sort_unstable();
    let perhaps = likely.into_iter().chain(unlikely).map(|(_, walker, walk)| (walker, walk));
    let mut wanted = BTreeSet::new();
    for walk in needed.into_iter().map(|(walk, _)| walk).chain(perhaps) {
        if wanted.len() == room {
            break;
        }
        wanted.insert(walk);
    }
    wanted.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::evaluation::setting;
    use crate::evolve::{Candidate, CandidateOutcome, Rivals, Scores, Search};
    use crate::{Executor, LocalExecutor, Task, TaskResult};
    use nbc_base::model::{
        Direction, Evolution, Palette, PhysicsWorld, Schedule, Spell, Trajectory, Trial, WorldNoise,
    };
    use nbc_sim::{Kernel, LaneBackend, Monitor};

    fn evolution(spells: &[(usize, u32)]) -> Evolution {
        let spell = |&(pattern, steps): &(usize, u32)| Spell::of(Pattern::PAIRS[pattern], steps);
        let variable = Schedule { spells: spells.iter().map(spell).collect() };
        let whole = crate::evolve::tests::evolution();
        Evolution { width: 3, height: 2, fixed_steps: 84, batch: 8, variable, ..whole }
    }

    const PAPER: [(usize, u32); 4] = [(0, 84), (1, 84), (2, 84), (3, 84)];

    fn straight(evolution: &Evolution, candidates: &[Candidate]) -> Vec<CandidateOutcome> {
        let noise = RobotNoise::new(&evolution.world.noise, 0);
        let fixed = Pattern::all(2).map(|pattern| Schedule::constant(pattern, evolution.fixed_steps));
        let schedules: Vec<Schedule> = fixed.chain([noise.sensed(&evolution.variable)]).collect();
        let trial = |candidate: &Candidate, schedule: &Schedule| Trial {
            body: noise.worn(&candidate.body),
            schedule: schedule.clone(),
        };
        let trials: Vec<Trial> =
            candidates.iter().flat_map(|body| schedules.iter().map(|schedule| trial(body, schedule))).collect();
        let trajectories = Simulator::default().run_trials(&setting(&evolution.world), &trials);
        let outcome = |of_body: &[Trajectory]| {
            if let Some(fault) = of_body.iter().find_map(|one| one.fault) {
                return CandidateOutcome::Faulty(fault);
            }
            let moved = |at: &[f64]| at[at.len() - 1] - at[0];
            let fixed: Vec<f64> = of_body[..4].iter().map(|one| moved(&one.com_x)).collect();
            let (displacement, at) = (Displacements::try_from(fixed).unwrap(), &of_body[4].com_x);
            let (mut start, mut sum) = (0, 0.0);
            for spell in &evolution.variable.spells {
                let end = start + spell.steps as usize;
                let moved = at[end] - at[start];
                if Direction::of(moved) != displacement.behavior().direction(spell.pattern) {
                    return CandidateOutcome::Inconsistent;
                }
                (start, sum) = (end, sum + moved.abs());
            }
            let least = displacement.iter().map(|d| d.abs()).fold(f64::INFINITY, f64::min);
            let behavior = displacement.behavior();
            CandidateOutcome::Measured(Scores { fitness: [sum, least], behavior, displacement })
        };
        trajectories.chunks(5).map(outcome).collect()
    }

    fn tasks(search: &Search, candidates: &[Candidate]) -> Vec<Task> {
        let protocol = Arc::new(EvaluationProtocol::of(search.evolution()));
        let task = |candidate| Task::Evaluation(Arc::clone(&protocol), EvaluationTask::of(search, candidate));
        candidates.iter().map(task).collect()
    }

    fn outcomes(results: &[Evaluated]) -> Vec<CandidateOutcome> {
        results.iter().map(|evaluated| evaluated.outcome).collect()
    }

    #[test]
    fn what_is_left_out_changes_no_archive() {
        let noise = WorldNoise { missed: 0.3, start: 0.4, weak: 0.1, dead: 0.1, seed: 2, ..WorldNoise::default() };
        let noisy = PhysicsWorld { noise, ..PhysicsWorld::default() };
        let longer = [(0, 200), (3, 50), (1, 84), (2, 130)];
        let shorter = [(0, 42), (1, 84), (0, 84)];
        let other_first = [(2, 84), (2, 21), (0, 84)];
        let declared = [&PAPER[..], &longer, &shorter, &other_first].map(evolution);
        let noisy = declared.clone().map(|one| Evolution { world: noisy, ..one });
        let mut surpassed = 0;
        for evolution in declared.into_iter().chain(noisy) {
            let (executor, mut search) = (LocalExecutor::default(), Search::new(&evolution, 4));
            for _ in 0..8 {
                let candidates = search.ask();
                let found = executor.perform(0, &tasks(&search, &candidates), &|| ()).unwrap();
                let found: Vec<Evaluated> = found.into_iter().map(TaskResult::evaluated).collect();
                let straight = straight(&evolution, &candidates);
                for (found, straight) in found.iter().zip(&straight) {
                    assert_eq!(found.work.env_steps + found.work.left_out, full_steps(&evolution));
                    match found.outcome {
                        CandidateOutcome::Surpassed => surpassed += 1,
                        // One that is found to have no result in time is not simulated until it is unstable.
                        CandidateOutcome::Inconsistent => {
                            assert!(matches!(straight, CandidateOutcome::Inconsistent | CandidateOutcome::Faulty(_)))
                        }
                        found => assert_eq!(found, *straight),
                    }
                }
                let mut with_all = search.clone();
                with_all.tell(&candidates, &straight);
                search.tell(&candidates, &outcomes(&found));
                assert_eq!(search.archive(), with_all.archive());
            }
        }
        assert!(surpassed > 50, "{surpassed} dropped");
    }

    fn full_steps(evolution: &Evolution) -> u64 {
        EvaluationProtocol::of(evolution).distance_steps()
    }

    #[test]
    fn results_and_counts_are_the_same_together_and_with_a_memory() {
        let evolution = evolution(&PAPER);
        let mut searches = [1, 2, 3].map(|seed| Search::new(&evolution, seed));
        let together = LocalExecutor::default();
        let scalar = Simulator::new(LaneBackend { kernel: Kernel::SCALAR, ..LaneBackend::default() });
        for _ in 0..10 {
            let asked = searches.each_ref().map(|search| (search.ask(), tasks(search, &search.ask())));
            let all: Vec<Task> = asked.iter().flat_map(|(_, tasks)| tasks.clone()).collect();
            let mut found = together.perform(0, &all, &|| ()).unwrap().into_iter();
            for (search, (candidates, tasks)) in searches.iter_mut().zip(&asked) {
                let own: Vec<TaskResult> = found.by_ref().take(tasks.len()).collect();
                let each = tasks.iter().flat_map(|task| crate::perform(&scalar, std::slice::from_ref(task), &|| ()));
                assert_eq!(own, each.collect::<Vec<_>>());
                let own: Vec<Evaluated> = own.into_iter().map(TaskResult::evaluated).collect();
                search.tell(candidates, &outcomes(&own));
            }
        }
        assert!(searches.iter().all(|search| search.counts().surpassed > 0));
    }

    #[test]
    fn the_order_of_simulations_changes_no_result_that_enters() {
        let evolution = evolution(&PAPER);
        let (protocol, mut search) = (EvaluationProtocol::of(&evolution), Search::new(&evolution, 6));
        for _ in 0..6 {
            let candidates = search.ask();
            let task = |candidate| EvaluationTask::of(&search, candidate);
            let tasks: Vec<EvaluationTask> = candidates.iter().map(task).collect();
            let evaluate = |expected: [f64; 4]| {
                let expected = Displacements::try_from(expected.to_vec()).ok();
                let tasks: Vec<_> = tasks.iter().map(|task| EvaluationTask { expected, ..task.clone() }).collect();
                let found = crate::evaluate_tasks(&Simulator::default(), &protocol, &tasks);
                // Which fault a body is dropped before depends on the order.
                let dropped = |outcome| {
                    if let CandidateOutcome::Faulty(_) = outcome { CandidateOutcome::Surpassed } else { outcome }
                };
                outcomes(&found).into_iter().map(dropped).collect::<Vec<_>>()
            };
            let one = evaluate([1.0, 2.0, 3.0, 4.0]);
            for order in [[4.0, 3.0, 2.0, 1.0], [2.0, -1.0, 4.0, 3.0], [0.0; 4], [f64::NAN, 1.0, -2.0, 0.0]] {
                assert_eq!(evaluate(order), one);
            }
            search.tell(&candidates, &one);
        }
    }

    #[test]
    fn a_body_that_was_simulated_before_is_not_simulated_again() {
        let evolution = evolution(&PAPER);
        let monitor = Arc::new(Monitor::default());
        let executor = LocalExecutor::new(Simulator::monitored(Arc::clone(&monitor)));
        let search = Search::new(&evolution, 1);
        let tasks = tasks(&search, &search.ask());
        let first = executor.perform(0, &tasks, &|| ()).unwrap();
        let once = monitor.env_steps();
        assert_eq!((executor.perform(0, &tasks, &|| ()), monitor.env_steps()), (Some(first), once));
        // Those that are ended from outside are not remembered.
        let stopped = LocalExecutor::new(Simulator::monitored(Arc::clone(&monitor)));
        monitor.stop();
        let is_faulty = |result: TaskResult| matches!(result.evaluated().outcome, CandidateOutcome::Faulty(_));
        assert!(stopped.perform(0, &tasks, &|| ()).unwrap().into_iter().all(is_faulty));
        assert_eq!(stopped.remembered(), 0);
        assert!(executor.remembered() > 0);
    }

    #[test]
    fn the_long_simulation_continues_a_fixed_one() {
        let protocol = EvaluationProtocol::of(&evolution(&PAPER));
        let mut measured = 0;
        for candidate in Search::new(&evolution(&PAPER), 1).ask() {
            let monitor = Arc::new(Monitor::default());
            let different = Walker::new(candidate.body.clone()).different().len() as u64;
            let task = EvaluationTask { body: candidate.body, rivals: Rivals::none(2), expected: None };
            let found = crate::evaluate_tasks(&Simulator::monitored(Arc::clone(&monitor)), &protocol, &[task]);
            assert_eq!(found[0].work.env_steps, monitor.env_steps());
            if let CandidateOutcome::Measured(_) = found[0].outcome {
                assert_eq!(monitor.env_steps(), (different + 3) * 84);
                measured += 1;
            }
        }
        assert!(measured > 0);
    }

    #[test]
    fn as_many_are_simulated_as_fill_the_lanes_those_first_that_need_most() {
        let search = Search::new(&evolution(&PAPER), 1);
        let protocol = EvaluationProtocol::of(search.evolution());
        let plan = SimulationPlan::new(&protocol);
        let task =
            |candidate: Candidate| EvaluationTask { body: candidate.body, rivals: Rivals::none(2), expected: None };
        let tasks: Vec<EvaluationTask> = search.ask().into_iter().map(task).collect();
        let walkers: Vec<Walker> = tasks.iter().map(|task| Walker::new(task.body.clone())).collect();
        let tasks: Vec<(&EvaluationTask, usize)> = tasks.iter().zip(0..).collect();
        let needs = |walker: &Walker| walker.different().len();
        let all: usize = walkers.iter().map(needs).sum();
        for (at_once, expected) in [(3, 6), (8, 8), (10, 10), (all + 10, all)] {
            let found = wanted(&plan, &tasks, &walkers, at_once);
            assert_eq!(found.len(), expected, "{at_once} at once");
            let made: BTreeSet<usize> = found.iter().map(|&(walker, _)| walker).collect();
            assert_eq!(made.len(), expected.min(walkers.len()));
            let left = walkers.iter().enumerate().filter(|(n, _)| !made.contains(n)).map(|(_, walker)| needs(walker));
            let least = made.iter().map(|&n| needs(&walkers[n])).min();
            assert!(left.max() <= least);
        }
        assert!(all > 10 && wanted(&plan, &[], &walkers, 8).is_empty());
    }

    #[test]
    fn a_stimulus_that_a_body_does_not_sense_is_not_simulated_and_changes_no_distance() {
        let simulator = Simulator::default();
        let rows = [["343", "353"], ["343", "383"], ["563", "343"], ["343", "333"], ["353", "378"]];
        let bodies = rows.map(|rows| Body::parse(&rows, &Palette::paper()).unwrap());
        let simulations = |body: &Body| Walker::new(body.clone()).different().len();
        assert_eq!(bodies.each_ref().map(simulations), [2, 2, 4, 1, 4]);
        let found = fixed_displacements(&simulator, &Setting::default(), &bodies, 84);
        for (body, found) in bodies.iter().zip(found) {
            let trial = |pattern| Trial { body: body.clone(), schedule: Schedule::constant(pattern, 84) };
            let trials: Vec<Trial> = Pattern::all(2).map(trial).collect();
            let walked = simulator.run_trials(&Setting::default(), &trials);
            let each: Vec<f64> = walked.iter().map(|one| one.com_x[84] - one.com_x[0]).collect();
            assert_eq!(found.unwrap(), Displacements::try_from(each).unwrap());
        }
    }
}
