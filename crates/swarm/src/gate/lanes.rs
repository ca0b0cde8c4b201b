//! The patterns of the simulations of gates, cycle by cycle, and the worth of margins: numbers between 0 and 1 in which
//! one half means that the worst cycle stands still.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use rand_chacha::ChaCha8Rng;

use crate::holds::HoldPlan;
use crate::noise::RobotNoise;
use nbc_base::model::{CYCLE_STEPS, Pattern, PhysicsWorld};

pub(super) const HOLD: usize = 4;

/// The patterns of one simulation, cycle by cycle.
pub(super) type Lane = Vec<Pattern>;

pub(super) fn starts(stimuli: usize) -> usize {
    1 << stimuli
}

pub(super) fn random_holds(stimuli: usize, length: usize, cycles: RangeInclusive<u32>, rng: &mut ChaCha8Rng) -> Lane {
    let HoldPlan(holds) = HoldPlan::random(stimuli, length / *cycles.start() as usize, cycles, rng);
    let cycles = holds.into_iter().flat_map(|(pattern, cycles)| std::iter::repeat_n(pattern, cycles as usize));
    cycles.take(length).collect()
}

pub(super) fn sensed(world: &PhysicsWorld, lane: usize, cycles: &Lane) -> Lane {
    let noise = RobotNoise::new(&world.noise, lane);
    let mut sensed = cycles.clone();
    for cycle in (1..sensed.len()).filter(|&cycle| noise.misses(cycle)) {
        sensed[cycle] = sensed[cycle - 1];
    }
    sensed
}

/// The parts of a cycle, in env steps, with what each lane senses in them.
pub(super) fn stretches(world: &PhysicsWorld, first: usize, lanes: &[Lane], cycle: usize) -> Vec<(u32, Vec<Pattern>)> {
    let late = |lane| RobotNoise::new(&world.noise, first + lane).delay(cycle);
    let late: Vec<u32> = (0..lanes.len()).map(late).collect();
    let starts: BTreeSet<u32> = late.iter().copied().chain([0]).collect();
    let ends = starts.iter().copied().skip(1).chain([CYCLE_STEPS]);
    let sensed = |start: u32| {
        let at = |(lane, late): (&Lane, &u32)| lane[if start < *late { cycle - 1 } else { cycle }];
        lanes.iter().zip(&late).map(at).collect()
    };
    starts.iter().zip(ends).map(|(&start, end)| (end - start, sensed(start))).collect()
}

/// The margin, in voxels per cycle, that scores halfway between zero and infinite margin.
const HALF_MARGIN: f64 = 0.05;

pub(super) fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(f64::INFINITY, f64::min)
}

pub(super) fn worth(margin: f64) -> f64 {
    if margin.is_infinite() { 1.0 } else { 0.5 + 0.5 * margin / (margin.abs() + HALF_MARGIN) }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::holds::PatternHold;
    use nbc_base::model::Behavior;

    pub(crate) fn steps<'a>(stimuli: usize, lanes: impl IntoIterator<Item = &'a [Pattern]>) -> Vec<Vec<u32>> {
        let many = starts(stimuli);
        let mut steps = vec![vec![0; many]; many];
        for two in lanes.into_iter().flat_map(|lane| lane.windows(2)) {
            steps[two[0].number(stimuli)][two[1].number(stimuli)] += 1;
        }
        steps
    }

    pub(crate) fn nand() -> Behavior {
        "RRRL".parse().unwrap()
    }

    pub(crate) fn hold(before: Option<usize>, pattern: usize, cycles: &[f64]) -> PatternHold {
        let pairs = Pattern::PAIRS;
        PatternHold { before: before.map(|i| pairs[i]), pattern: pairs[pattern], cycles: cycles.to_vec(), height: 0.0 }
    }
}
