//! The two fitnesses of gates: numbers between 0 and 1 in which one half means that the worst cycle stands still.

use crate::holds::PatternHold;
use nbc_base::model::{Behavior, SearchObjective};

/// The cycles of a hold from which on the output must be correct; each is scored separately.
const CLOCKS: [usize; 3] = [2, 3, 4];
/// The margin, in voxels per cycle, that scores halfway between zero and infinite margin.
const HALF_MARGIN: f64 = 0.05;

/// The fitnesses for these holds. More holds and longer ones never raise them.
pub(super) fn fitness<'a>(
    objective: SearchObjective,
    behavior: Behavior,
    holds: impl Iterator<Item = &'a PatternHold> + Clone,
) -> [f64; 2] {
    match objective {
        SearchObjective::Wave => wave(behavior, holds),
        SearchObjective::Distance | SearchObjective::Gate => gate(behavior, holds),
    }
}

/// The output from the second, third and fourth cycle of a hold on, and the output in every cycle of holds that should
/// not change it.
fn gate<'a>(behavior: Behavior, holds: impl Iterator<Item = &'a PatternHold> + Clone) -> [f64; 2] {
    let from = |clock: usize| holds.clone().flat_map(move |hold| hold.rightward(behavior).skip(clock - 1));
    let settled = CLOCKS.map(|clock| worth(least(from(clock))));
    let is_static = |hold: &&PatternHold| {
        hold.before.is_none_or(|before| behavior.direction(before) == behavior.direction(hold.pattern))
    };
    // A fresh start is not a switch, so its first cycle is not counted.
    let cycles = |hold: &'a PatternHold| hold.rightward(behavior).skip(usize::from(hold.before.is_none()));
    [settled.iter().sum::<f64>() / CLOCKS.len() as f64, worth(least(holds.clone().filter(is_static).flat_map(cycles)))]
}

/// The mean over the steps from a pattern to the next one, 16 of two stimuli and 64 of three, of the score of the
/// smallest displacement in such a cycle, and the score of the smallest displacement of all.
fn wave<'a>(behavior: Behavior, holds: impl Iterator<Item = &'a PatternHold>) -> [f64; 2] {
    let stimuli = behavior.stimuli();
    let mut margins = vec![f64::INFINITY; 1 << (2 * stimuli)];
    for hold in holds {
        let own = hold.pattern.number(stimuli);
        for (cycle, margin) in hold.rightward(behavior).enumerate() {
            let before = if cycle == 0 { hold.before.map(|before| before.number(stimuli)) } else { Some(own) };
            if let Some(before) = before {
                let step = &mut margins[before << stimuli | own];
                *step = step.min(margin);
            }
        }
    }
    let mean = margins.iter().map(|&margin| worth(margin)).sum::<f64>() / margins.len() as f64;
    [mean, worth(least(margins.iter().copied()))]
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
    use nbc_base::model::Pattern;

    const OBJECTIVES: [SearchObjective; 2] = [SearchObjective::Gate, SearchObjective::Wave];

    fn nand() -> Behavior {
        "RRRL".parse().unwrap()
    }

    fn hold(before: Option<usize>, pattern: usize, cycles: &[f64]) -> PatternHold {
        let pairs = Pattern::PAIRS;
        PatternHold { before: before.map(|i| pairs[i]), pattern: pairs[pattern], cycles: cycles.to_vec(), height: 0.0 }
    }

    #[test]
    fn a_wrong_first_cycle_counts_only_where_the_output_should_not_change() {
        let start = hold(None, 0, &[-9.0, 0.05, 0.05, 0.05]);
        let switch = hold(Some(0), 3, &[9.0, -0.05, -0.05, -0.05]);
        let quiet = hold(Some(0), 1, &[-0.05, 0.05, 0.05, 0.05]);
        assert_eq!(gate(nand(), [start.clone(), switch.clone()].iter()), [0.75, 0.75]);
        assert_eq!(gate(nand(), [start, switch, quiet].iter()), [0.75, 0.25]);
    }

    #[test]
    fn of_a_wave_every_cycle_counts_but_that_of_a_fresh_start() {
        let start = hold(None, 0, &[-9.0, 0.05]);
        assert_eq!(wave(nand(), [start.clone()].iter()), [(0.75 + 15.0) / 16.0, 0.75]);
        let wrong = hold(Some(0), 3, &[0.05]);
        assert_eq!(wave(nand(), [start, wrong].iter()), [(0.75 + 0.25 + 14.0) / 16.0, 0.25]);
    }

    #[test]
    fn more_holds_never_raise_the_fitness() {
        let holds: Vec<PatternHold> =
            (0..40).map(|i| hold((i > 0).then_some((i + 1) % 4), i % 4, &[0.3, 0.1 - 0.01 * i as f64, 0.2])).collect();
        for objective in OBJECTIVES {
            let fitnesses: Vec<[f64; 2]> = (1..40).map(|n| fitness(objective, nand(), holds[..n].iter())).collect();
            assert!(fitnesses.windows(2).all(|two| two[1][0] <= two[0][0] && two[1][1] <= two[0][1]), "{objective:?}");
        }
    }
}
