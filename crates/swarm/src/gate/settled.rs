//! The objective `gate`: the correct output soon after any switch of the inputs, and no wrong cycle while the output
//! should not change.

use rand_chacha::ChaCha8Rng;

use crate::gate::lanes::{HOLD, Lane, least, random_holds, starts, worth};
use crate::holds::PatternHold;
use nbc_base::model::{Behavior, Pattern};

/// Four walks from four fresh starts, which together contain each of the twelve switches of two stimuli once.
const WALKS: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 2, 1], [3, 1, 3, 0]];
/// The walk from the first pattern of three stimuli. It makes each difference of numbers once, so that it and the walks
/// that begin later by one to seven contain each of the 56 switches once.
const WALK_OF_THREE: [usize; 8] = [0, 1, 7, 2, 6, 3, 5, 4];
const RANDOM_CYCLES: usize = 36;
/// The cycles of a hold from which on the output must be correct; each is scored separately.
const CLOCKS: [usize; 3] = [2, 3, 4];

pub(super) fn stages(stimuli: usize, rng: &mut ChaCha8Rng) -> [Vec<Lane>; 2] {
    let patterns: Vec<Pattern> = Pattern::all(stimuli).collect();
    let walk = |walk: &[usize]| walk.iter().flat_map(|&i| [patterns[i % 8]; HOLD]).collect();
    let later = |first: usize| WALK_OF_THREE.map(|number| number + first);
    let walks = match stimuli {
        2 => WALKS.iter().map(|one| walk(one)).collect(),
        _ => (0..8).map(|first| walk(&later(first))).collect(),
    };
    let random = |_| random_holds(stimuli, RANDOM_CYCLES, 2..=4, rng);
    [walks, (0..starts(stimuli)).map(random).collect()]
}

/// The output from the second, third and fourth cycle of a hold on, and the output in every cycle of holds that should
/// not change it.
pub(super) fn fitness<'a>(behavior: Behavior, holds: impl Iterator<Item = &'a PatternHold> + Clone) -> [f64; 2] {
    let from = |clock: usize| holds.clone().flat_map(move |hold| hold.rightward(behavior).skip(clock - 1));
    let settled = CLOCKS.map(|clock| worth(least(from(clock))));
    let is_static = |hold: &&PatternHold| {
        hold.before.is_none_or(|before| behavior.direction(before) == behavior.direction(hold.pattern))
    };
    // A fresh start is not a switch, so its first cycle is not counted.
    let cycles = |hold: &'a PatternHold| hold.rightward(behavior).skip(usize::from(hold.before.is_none()));
    [settled.iter().sum::<f64>() / CLOCKS.len() as f64, worth(least(holds.clone().filter(is_static).flat_map(cycles)))]
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;
    use crate::gate::lanes::tests::{hold, nand, steps};

    #[test]
    fn the_walks_make_every_switch_once() {
        for stimuli in [2, 3] {
            let [walks, random] = stages(stimuli, &mut ChaCha8Rng::seed_from_u64(1));
            let (steps, many) = (steps(stimuli, walks.iter().map(Vec::as_slice)), starts(stimuli));
            assert!((0..many).all(|from| (0..many).all(|to| from == to || steps[from][to] == 1)), "{steps:?}");
            let firsts: Vec<usize> = walks.iter().map(|lane| lane[0].number(stimuli)).collect();
            assert_eq!(firsts, (0..many).collect::<Vec<_>>());
            assert!(random.iter().all(|lane| lane.len() == RANDOM_CYCLES));
        }
    }

    #[test]
    fn a_wrong_first_cycle_counts_only_where_the_output_should_not_change() {
        let start = hold(None, 0, &[-9.0, 0.05, 0.05, 0.05]);
        let switch = hold(Some(0), 3, &[9.0, -0.05, -0.05, -0.05]);
        let quiet = hold(Some(0), 1, &[-0.05, 0.05, 0.05, 0.05]);
        assert_eq!(fitness(nand(), [start.clone(), switch.clone()].iter()), [0.75, 0.75]);
        assert_eq!(fitness(nand(), [start, switch, quiet].iter()), [0.75, 0.25]);
    }
}
