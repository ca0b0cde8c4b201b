//! The distance objective: a fixed simulation under each pattern, then the long one, each only for bodies that can
//! still enter the archive (docs/evolution.md, What is left out).
//!
//! What a body does under a pattern depends on the protocol and the body alone. So the result of a task is found by
//! reading what its body is known to do, in the task's own order, until something is missing; that is then simulated.
//! Results and counts are the same whatever was known before, or is simulated together.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use crate::Work;
use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask, setting};
use crate::evolve::{CandidateOutcome, Scores};
use crate::noise::RobotNoise;
use crate::walks::{LongWalk, WalkMemory, Walks};
use nbc_base::model::{Body, Direction, Displacements, Fault, MaterialKind, Pattern, Schedule, Setting, Spell};
use nbc_sim::{Simulator, Snapshot};

/// The most robots at once, so that many bodies need no more memory.
const MOST_AT_ONCE: usize = 4096;

/// The result of each task.
pub(crate) fn evaluate(
    simulator: &Simulator,
    memory: &WalkMemory,
    protocol: &EvaluationProtocol,
    tasks: &[EvaluationTask],
) -> Vec<Evaluated> {
    let course = Course::new(protocol);
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
        let wanted = wanted(&course, &tasks, &walkers, simulator.at_once());
        if wanted.is_empty() {
            break;
        }
        course.walk(simulator, &mut walkers, &wanted);
    }
    for walker in &mut walkers {
        walker.walks.long = walker.walks.long.or_else(|| course.ended(walker));
    }
    memory.keep(protocol, bodies.into_iter().zip(walkers.iter().map(|walker| &walker.walks)));
    let result = |(task, walker): (&EvaluationTask, usize)| match course.next(task, &walkers[walker]) {
        Next::Done(evaluated) => evaluated,
        next => panic!("all that an evaluation needs was simulated, except {next:?}"),
    };
    tasks.into_iter().map(result).collect()
}

/// The displacement of each body under each constant pattern, in voxels, or the first fault of its simulations. A
/// stimulus that a body does not sense changes nothing, so patterns that differ in such a one alone are simulated once.
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

/// The simulations that are made next, of those that are needed now: one of each body that is not decided. First come
/// those of the bodies that will probably need most, and only as many as fill the robots that are simulated at once,
/// for the others can wait for those that follow. If all leave room, it is for those that will probably be needed
/// soonest.
fn wanted(
    course: &Course,
    tasks: &[(&EvaluationTask, usize)],
    walkers: &[Walker],
    at_once: usize,
) -> Vec<(usize, Walk)> {
    let (mut needed, mut likely, mut unlikely) = (BTreeMap::new(), Vec::new(), Vec::new());
    for &(task, walker) in tasks {
        let (walk, legs) = match course.next(task, &walkers[walker]) {
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

/// Simulates each leg.
fn advance(simulator: &Simulator, setting: &Setting, legs: &[Leg]) -> Vec<LegEnd> {
    let mut ends = Vec::with_capacity(legs.len());
    for legs in legs.chunks(MOST_AT_ONCE) {
        let bodies: Vec<Body> = legs.iter().map(|leg| leg.body.clone()).collect();
        let mut flock = simulator.flock(setting, &bodies);
        for (place, leg) in legs.iter().enumerate() {
            if let Some(from) = leg.from {
                flock.restore(place, from);
            }
        }
        let starts: Vec<f64> = (0..legs.len()).map(|place| flock.center(place)[0]).collect();
        flock.advance_under(&legs.iter().map(|leg| leg.spell.clone()).collect::<Vec<_>>());
        ends.extend((0..).zip(starts).map(|(place, start)| LegEnd {
            start,
            end: flock.center(place)[0],
            fault: flock.fault(place),
            state: flock.snapshot(place),
        }));
    }
    ends
}

/// The place of the pattern under which a body should be simulated next. If its parent is known, that is one after
/// which it would be dropped if it walked half as far as its parent; of several the one under which its parent walked
/// least.
fn most_telling(task: &EvaluationTask, walker: &Walker, known: &[Option<f64>], left: &[Pattern]) -> usize {
    let key = |&pattern: &Pattern| {
        let expected = walker.expected(task, pattern)?;
        Some((task.rivals.admit_any(&walker.with(known, pattern, expected / 2.0)), expected.abs()))
    };
    let keys: Vec<(bool, f64)> = left.iter().map_while(key).collect();
    let order = |&a: &usize, &b: &usize| keys[a].0.cmp(&keys[b].0).then(keys[a].1.total_cmp(&keys[b].1));
    (0..keys.len()).min_by(order).unwrap_or(0)
}

/// A simulation of a body under one pattern.
struct Leg<'a> {
    body: &'a Body,
    /// The state from which it goes on; if there is none, it starts afresh.
    from: Option<&'a Snapshot>,
    spell: Spell,
}

impl<'a> Leg<'a> {
    fn fixed(body: &'a Body, pattern: Pattern, env_steps: u32) -> Self {
        Self { body, from: None, spell: Spell::of(pattern, env_steps) }
    }
}

/// How a leg went.
struct LegEnd {
    /// Where the body was before it, in voxels.
    start: f64,
    /// Where it was after it.
    end: f64,
    fault: Option<Fault>,
    state: Snapshot,
}

impl LegEnd {
    /// The displacement in voxels.
    fn moved(&self) -> Result<f64, Fault> {
        self.fault.map_or_else(|| Ok(self.end - self.start), Err)
    }
}

/// A simulation that a body may need.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Walk {
    /// Under one pattern, from a fresh start.
    Fixed(Pattern),
    /// The next stretch of the long simulation.
    Long,
}

/// How far a body has come in the long simulation.
struct Trail {
    /// Where it was at the start and after each stretch, in voxels.
    places: Vec<f64>,
    fault: Option<Fault>,
    state: Snapshot,
}

/// A body with what is known of it.
struct Walker {
    body: Body,
    /// What it senses of each pattern.
    sensed: Vec<Pattern>,
    walks: Walks,
    /// The long simulation so far, if it was begun here.
    trail: Option<Trail>,
}

impl Walker {
    fn new(body: Body) -> Self {
        Self { sensed: sensed_patterns(&body), body, walks: Walks::default(), trail: None }
    }

    /// What it senses of a pattern.
    fn senses(&self, pattern: Pattern) -> Pattern {
        self.sensed[pattern.number(self.sensed.len().ilog2() as usize)]
    }

    /// The stretches of the long simulation that were simulated here.
    fn stretches_done(&self) -> usize {
        self.trail.as_ref().map_or(0, |trail| trail.places.len() - 1)
    }

    /// The patterns that it tells apart, in their order.
    fn different(&self) -> Vec<Pattern> {
        let mut different = self.sensed.clone();
        different.sort_unstable();
        different.dedup();
        different
    }

    /// The displacement of its parent under a pattern that it tells apart: the smallest, if the parent tells more
    /// apart.
    fn expected(&self, task: &EvaluationTask, pattern: Pattern) -> Option<f64> {
        let same = self.sensed.iter().zip(task.expected.as_deref()?).filter(|(own, _)| **own == pattern);
        same.map(|(_, &moved)| moved).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// What is known of its displacements, with that under a pattern that it tells apart.
    fn with(&self, known: &[Option<f64>], pattern: Pattern, moved: f64) -> Vec<Option<f64>> {
        let each = self.sensed.iter().zip(known);
        each.map(|(&own, &known)| if own == pattern { Some(moved) } else { known }).collect()
    }
}

/// What an evaluation needs next.
#[derive(Debug)]
enum Next {
    /// Simulations under these constant patterns, in this order, until the body is decided. If it walks as its parent
    /// does, it needs `likely` of them, and `legs` simulations in all, each stretch of the long one counted.
    Fixed { missing: Vec<Pattern>, likely: usize, legs: usize },
    /// The long simulation, of which so many stretches are left.
    Long { legs: usize },
    /// Nothing.
    Done(Evaluated),
}

/// The simulations of a protocol.
struct Course<'a> {
    protocol: &'a EvaluationProtocol,
    setting: Setting,
    /// The long simulation as a robot senses it: patterns, and the env steps of each.
    stretches: Vec<(Pattern, u32)>,
    /// Where the spells of the long simulation begin and end, as numbers of stretches done.
    spells: Vec<(Pattern, usize, usize)>,
    /// Whether the first stretch is a whole fixed simulation.
    is_continued: bool,
}

impl<'a> Course<'a> {
    fn new(protocol: &'a EvaluationProtocol) -> Self {
        // Under a constant pattern there is nothing to miss.
        let sensed = RobotNoise::new(&protocol.world.noise, 0).sensed(&protocol.variable);
        let ends = |schedule: &Schedule| {
            let end = |at: &mut u32, steps: u32| {
                *at += steps;
                Some(*at)
            };
            schedule.spells.iter().map(|spell| spell.steps).scan(0, end).collect::<Vec<u32>>()
        };
        let is_long = |spell: &Spell| spell.steps >= protocol.fixed_steps && protocol.fixed_steps > 0;
        let is_continued = sensed.spells.first().is_some_and(is_long);
        let start = is_continued.then_some(protocol.fixed_steps);
        let cuts: BTreeSet<u32> = ends(&sensed).into_iter().chain(ends(&protocol.variable)).chain(start).collect();
        let cuts: Vec<u32> = std::iter::once(0).chain(cuts.into_iter().filter(|&cut| cut > 0)).collect();
        let of_cut = |cut: u32| cuts.binary_search(&cut).expect("each end is a cut");
        let pattern_at = |step: u32| {
            let spell = ends(&sensed).into_iter().position(|end| step < end).expect("a stretch is in a spell");
            sensed.spells[spell].pattern
        };
        let stretches = cuts.windows(2).map(|two| (pattern_at(two[0]), two[1] - two[0])).collect();
        let mut at = 0;
        let spell = |(spell, end): (&Spell, u32)| {
            let begin = std::mem::replace(&mut at, end);
            (spell.pattern, of_cut(begin), of_cut(end))
        };
        let spells = protocol.variable.spells.iter().zip(ends(&protocol.variable)).map(spell).collect();
        Self { protocol, setting: setting(&protocol.world), stretches, spells, is_continued }
    }

    /// What a task needs next, or its result.
    fn next(&self, task: &EvaluationTask, walker: &Walker) -> Next {
        let mut known = vec![None; walker.sensed.len()];
        let (mut env_steps, mut left) = (0, walker.different());
        let (mut missing, mut likely) = (Vec::new(), None);
        while !left.is_empty() {
            let pattern = left.remove(most_telling(task, walker, &known, &left));
            let walked = walker.walks.fixed.get(&pattern).copied();
            if let (Some(walked), []) = (walked, &missing[..]) {
                env_steps += u64::from(self.protocol.fixed_steps);
                match walked {
                    Err(fault) => return self.done(CandidateOutcome::Faulty(fault), env_steps),
                    Ok(moved) => known = walker.with(&known, pattern, moved),
                }
                if !task.rivals.admit_any(&known) {
                    return self.done(CandidateOutcome::Surpassed, env_steps);
                }
                continue;
            }
            missing.extend(walked.is_none().then_some(pattern));
            let moved = walked.and_then(Result::ok).or_else(|| walker.expected(task, pattern));
            known = moved.map_or(known.clone(), |moved| walker.with(&known, pattern, moved));
            if likely.is_none() && !task.rivals.admit_any(&known) {
                likely = Some(missing.len());
            }
        }
        if !missing.is_empty() {
            let legs = likely.unwrap_or(missing.len() + self.stretches.len());
            return Next::Fixed { likely: likely.unwrap_or(missing.len()), missing, legs };
        }
        let Some(LongWalk { walked, env_steps: long }) = walker.walks.long.or_else(|| self.ended(walker)) else {
            return Next::Long { legs: self.stretches.len() - walker.stretches_done() };
        };
        let outcome = walked.map_or_else(
            |outcome| outcome,
            |sum| {
                let displacement = Displacements::try_from(known.into_iter().flatten().collect::<Vec<f64>>());
                let displacement = displacement.expect("there is one for each pattern");
                let least = displacement.iter().map(|d| d.abs()).fold(f64::INFINITY, f64::min);
                CandidateOutcome::Measured(Scores {
                    fitness: [sum, least],
                    behavior: displacement.behavior(),
                    displacement,
                })
            },
        );
        self.done(outcome, env_steps + u64::from(long))
    }

    fn done(&self, outcome: CandidateOutcome, env_steps: u64) -> Next {
        let left_out = self.protocol.distance_steps() - env_steps;
        Next::Done(Evaluated { outcome, work: Work { env_steps, left_out } })
    }

    /// Makes these simulations of walkers.
    fn walk(&self, simulator: &Simulator, walkers: &mut [Walker], wanted: &[(usize, Walk)]) {
        let leg = |&(walker, walk): &(usize, Walk)| {
            let walker = &walkers[walker];
            match walk {
                Walk::Fixed(pattern) => Leg::fixed(&walker.body, pattern, self.protocol.fixed_steps),
                Walk::Long => {
                    let (pattern, env_steps) = self.stretches[walker.stretches_done()];
                    let from = walker.trail.as_ref().map(|trail| &trail.state);
                    Leg { body: &walker.body, from, spell: Spell::of(pattern, env_steps) }
                }
            }
        };
        let ends = advance(simulator, &self.setting, &wanted.iter().map(leg).collect::<Vec<_>>());
        let first = self.stretches.first().filter(|_| self.is_continued).map(|&(pattern, _)| pattern);
        for (&(walker, walk), leg) in wanted.iter().zip(ends) {
            let walker = &mut walkers[walker];
            if let Walk::Fixed(pattern) = walk {
                walker.walks.fixed.insert(pattern, leg.moved());
            }
            if walk == Walk::Long || first.is_some_and(|first| walk == Walk::Fixed(walker.senses(first))) {
                let before = walker.trail.take().map_or_else(|| vec![leg.start], |trail| trail.places);
                let places = before.into_iter().chain([leg.end]).collect();
                walker.trail = Some(Trail { places, fault: leg.fault, state: leg.state });
            }
        }
    }

    /// The long simulation, as far as it is known that it needs no further stretch.
    fn ended(&self, walker: &Walker) -> Option<LongWalk> {
        let places = walker.trail.as_ref().map_or(&[][..], |trail| &trail.places);
        let walked = match walker.trail.as_ref().and_then(|trail| trail.fault) {
            Some(fault) => Err(CandidateOutcome::Faulty(fault)),
            None => self.walked(walker, places)?,
        };
        let own = self.stretches[..walker.stretches_done()].iter().skip(usize::from(self.is_continued));
        Some(LongWalk { walked, env_steps: own.map(|&(_, steps)| steps).sum() })
    }

    /// The sum of distances in the long simulation with these places at the start and after each stretch so far; `None`
    /// if it has not ended. In each spell the direction must be that of the fixed simulations.
    fn walked(&self, walker: &Walker, trail: &[f64]) -> Option<Result<f64, CandidateOutcome>> {
        let mut sum = 0.0;
        for &(pattern, begin, end) in &self.spells {
            let moved = trail.get(end)? - trail[begin];
            let fixed = walker.walks.fixed.get(&walker.senses(pattern))?.ok()?;
            if Direction::of(moved) != Direction::of(fixed) {
                return Some(Err(CandidateOutcome::Inconsistent));
            }
            sum += moved.abs();
        }
        Some(Ok(sum))
    }
}

/// What a body senses of each pattern: the stimuli of its sensors.
fn sensed_patterns(body: &Body) -> Vec<Pattern> {
    let palette = body.palette();
    let mut sensed = vec![false; palette.inputs()];
    for &code in body.codes() {
        // A fourth stimulus is always absent.
        if let Some(MaterialKind::Sensor(response)) = palette.kind(code)
            && response.image.is_none()
            && let Some(sensed) = sensed.get_mut(response.stimulus)
        {
            *sensed = true;
        }
    }
    let of_pattern = |pattern: Pattern| Pattern::of(sensed.iter().enumerate().map(|(i, &on)| on && pattern.has(i)));
    Pattern::all(palette.inputs()).map(of_pattern).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::evolve::{Candidate, Rivals, Search};
    use crate::{Executor, LocalExecutor, Task, TaskResult};
    use nbc_base::model::{Evolution, Palette, PhysicsWorld, Trajectory, Trial, WorldNoise};
    use nbc_sim::{Kernel, LaneBackend, Monitor};

    /// A search in which many bodies are dropped, with a long simulation of these spells.
    fn evolution(spells: &[(usize, u32)]) -> Evolution {
        let spell = |&(pattern, steps): &(usize, u32)| Spell::of(Pattern::PAIRS[pattern], steps);
        let variable = Schedule { spells: spells.iter().map(spell).collect() };
        let whole = crate::evolve::tests::evolution();
        Evolution { width: 3, height: 2, fixed_steps: 84, batch: 8, variable, ..whole }
    }

    const PAPER: [(usize, u32); 4] = [(0, 84), (1, 84), (2, 84), (3, 84)];

    /// The results of bodies whose every simulation is made from its start to its end.
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
        let noise = WorldNoise { missed: 0.3, start: 0.4, weak: 0.1, dead: 0.1, seed: 2 };
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

    /// Each search by itself, without a memory, on one lane; then all together.
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
        let course = Course::new(&protocol);
        let task =
            |candidate: Candidate| EvaluationTask { body: candidate.body, rivals: Rivals::none(2), expected: None };
        let tasks: Vec<EvaluationTask> = search.ask().into_iter().map(task).collect();
        let walkers: Vec<Walker> = tasks.iter().map(|task| Walker::new(task.body.clone())).collect();
        let tasks: Vec<(&EvaluationTask, usize)> = tasks.iter().zip(0..).collect();
        let needs = |walker: &Walker| walker.different().len();
        let all: usize = walkers.iter().map(needs).sum();
        for (at_once, expected) in [(3, 6), (8, 8), (10, 10), (all + 10, all)] {
            let found = wanted(&course, &tasks, &walkers, at_once);
            assert_eq!(found.len(), expected, "{at_once} at once");
            let made: BTreeSet<usize> = found.iter().map(|&(walker, _)| walker).collect();
            assert_eq!(made.len(), expected.min(walkers.len()));
            let left = walkers.iter().enumerate().filter(|(n, _)| !made.contains(n)).map(|(_, walker)| needs(walker));
            let least = made.iter().map(|&n| needs(&walkers[n])).min();
            assert!(left.max() <= least);
        }
        assert!(all > 10 && wanted(&course, &[], &walkers, 8).is_empty());
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

    #[test]
    fn a_body_of_three_senses_has_eight_patterns() {
        let body = |rows: &[&str]| Body::parse(rows, &Palette::three()).unwrap();
        let patterns =
            |body: Body| sensed_patterns(&body).iter().map(|one| one.digits(3)).collect::<Vec<_>>().join(" ");
        assert_eq!(patterns(body(&["3a4", "373"])), "000 001 000 001 100 101 100 101");
        assert_eq!(Walker::new(body(&["3a4", "576"])).different().len(), 8);
    }
}
