//! Holds: patterns kept for whole cycles one after another, and the robot's motion in each.

use std::ops::RangeInclusive;

use rand::{Rng, RngExt};

use nbc_base::model::{Behavior, CYCLE_STEPS, Direction, Pattern, Schedule, Spell, Trajectory};

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct HoldPlan(pub Vec<(Pattern, u32)>);

impl HoldPlan {
    /// Each pattern differs from the previous one, and is held for a random number of cycles.
    pub(crate) fn random<R: Rng>(stimuli: usize, count: usize, cycles: RangeInclusive<u32>, rng: &mut R) -> Self {
        let patterns: Vec<Pattern> = Pattern::all(stimuli).collect();
        let many = patterns.len() as u32;
        let mut pattern = rng.random_range(0..many);
        let mut plan = Vec::with_capacity(count);
        for _ in 0..count {
            plan.push((patterns[pattern as usize], rng.random_range(cycles.clone())));
            pattern = (pattern + rng.random_range(1..many)) % many;
        }
        Self(plan)
    }

    pub(crate) fn schedule(&self) -> Schedule {
        let spell = |&(pattern, cycles): &_| Spell::of(pattern, cycles * CYCLE_STEPS);
        Schedule { spells: self.0.iter().map(spell).collect() }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PatternHold {
    /// The pattern before; `None` at a fresh start.
    pub before: Option<Pattern>,
    pub pattern: Pattern,
    /// Displacement in each cycle, in voxels.
    pub cycles: Vec<f64>,
    /// Mean height of the center of mass over the last cycle, in voxels.
    pub height: f64,
}

impl PatternHold {
    /// Displacement of each cycle in the correct direction for a behavior; negative if the output is wrong.
    pub(crate) fn rightward(&self, behavior: Behavior) -> impl Iterator<Item = f64> + '_ {
        let sign = if behavior.direction(self.pattern) == Direction::Right { 1.0 } else { -1.0 };
        self.cycles.iter().map(move |displacement| sign * displacement)
    }
}

pub(crate) fn holds(plan: &HoldPlan, trajectory: &Trajectory) -> Vec<PatternHold> {
    let cycle = CYCLE_STEPS as usize;
    let mut at = 0;
    let mut before = None;
    let mut holds = Vec::with_capacity(plan.0.len());
    for &(pattern, count) in &plan.0 {
        let ends = (0..count as usize).map(|c| at + c * cycle);
        let cycles = ends.map(|start| trajectory.com_x[start + cycle] - trajectory.com_x[start]).collect();
        at += count as usize * cycle;
        let last = &trajectory.com_y[at + 1 - cycle..=at];
        holds.push(PatternHold { before, pattern, cycles, height: last.iter().sum::<f64>() / cycle as f64 });
        before = Some(pattern);
    }
    holds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycles_are_cut_where_the_patterns_change() {
        let plan = HoldPlan(vec![(Pattern::PAIRS[1], 2), (Pattern::PAIRS[3], 1)]);
        assert_eq!(plan.schedule().steps(), 3 * 84);
        let com_x: Vec<f64> = (0..=3 * 84)
            .map(|step| if step <= 84 { f64::from(step) } else { 84.0 - 2.0 * f64::from(step - 84) })
            .collect();
        let trajectory = Trajectory { com_y: com_x.iter().map(|_| 2.0).collect(), com_x, fault: None };
        let holds = holds(&plan, &trajectory);
        assert_eq!(
            holds[0],
            PatternHold { before: None, pattern: Pattern::PAIRS[1], cycles: vec![84.0, -168.0], height: 2.0 }
        );
        assert_eq!((holds[1].before, holds[1].cycles.as_slice()), (Some(Pattern::PAIRS[1]), [-168.0].as_slice()));
        let behavior: Behavior = "RLRR".parse().unwrap();
        assert_eq!(holds[0].rightward(behavior).collect::<Vec<_>>(), [-84.0, 168.0]);
    }
}
