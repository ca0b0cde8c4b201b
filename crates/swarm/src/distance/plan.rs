//! The simulations of a protocol: which a task needs next, and its result.

use std::collections::BTreeSet;

use crate::Work;
use crate::distance::leg::{Leg, advance};
use crate::distance::walker::{Trail, Walker};
use crate::distance::walks::LongWalk;
use crate::evaluation::{Evaluated, EvaluationProtocol, EvaluationTask, setting};
use crate::evolve::{CandidateOutcome, Scores};
use crate::noise::RobotNoise;
use nbc_base::model::{Direction, Displacements, Pattern, Schedule, Setting, Spell};
use nbc_sim::Simulator;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Walk {
    Fixed(Pattern),
    Long,
}

/// What to simulate next: the missing patterns in this order, until the body is decided, or the rest of the long
/// simulation. A body that walks as its parent does needs `likely` patterns, and `legs` simulations in all, where each
/// stretch counts as one.
#[derive(Debug)]
pub(super) enum Next {
    Fixed { missing: Vec<Pattern>, likely: usize, legs: usize },
    Long { legs: usize },
    Done(Evaluated),
}

pub(super) struct SimulationPlan<'a> {
    protocol: &'a EvaluationProtocol,
    setting: Setting,
    /// The long simulation as a robot senses it: patterns, and the env steps of each.
    stretches: Vec<(Pattern, u32)>,
    /// Where the spells of the long simulation begin and end, as numbers of stretches done.
    spells: Vec<(Pattern, usize, usize)>,
    /// Whether the first stretch is a whole fixed simulation.
    is_continued: bool,
}

impl<'a> SimulationPlan<'a> {
    pub fn new(protocol: &'a EvaluationProtocol) -> Self {
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

    pub fn next(&self, task: &EvaluationTask, walker: &Walker) -> Next {
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
        let Some(LongWalk { walked, env_steps: long }) = self.long(walker) else {
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

    pub fn walk(&self, simulator: &Simulator, walkers: &mut [Walker], wanted: &[(usize, Walk)]) {
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

    pub fn long(&self, walker: &Walker) -> Option<LongWalk> {
        walker.walks.long.or_else(|| self.ended(walker))
    }

    fn ended(&self, walker: &Walker) -> Option<LongWalk> {
        let places = walker.trail.as_ref().map_or(&[][..], |trail| &trail.places);
        let walked = match walker.trail.as_ref().and_then(|trail| trail.fault) {
            Some(fault) => Err(CandidateOutcome::Faulty(fault)),
            None => self.walked(walker, places)?,
        };
        let own = self.stretches[..walker.stretches_done()].iter().skip(usize::from(self.is_continued));
        Some(LongWalk { walked, env_steps: own.map(|&(_, steps)| steps).sum() })
    }

    /// `None` if it has not ended. In each spell the direction must be that of the fixed simulations.
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

/// If its parent is known, one after which the body would be dropped if it walked half as far; of several the one
/// under which its parent walked least.
fn most_telling(task: &EvaluationTask, walker: &Walker, known: &[Option<f64>], left: &[Pattern]) -> usize {
    let key = |&pattern: &Pattern| {
        let expected = walker.expected(task, pattern)?;
        Some((task.rivals.admit_any(&walker.with(known, pattern, expected / 2.0)), expected.abs()))
    };
    let keys: Vec<(bool, f64)> = left.iter().map_while(key).collect();
    let order = |&a: &usize, &b: &usize| keys[a].0.cmp(&keys[b].0).then(keys[a].1.total_cmp(&keys[b].1));
    (0..keys.len()).min_by(order).unwrap_or(0)
}
