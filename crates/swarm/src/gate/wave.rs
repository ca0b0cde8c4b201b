//! The objective `wave`: the correct output in every cycle, while the inputs may change in each.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::gate::lanes::{Lane, least, random_holds, starts, worth};
use crate::holds::PatternHold;
use nbc_base::model::{Behavior, Pattern};

/// Cycles of the first hold: long enough to show bodies that are right only for a while.
const FIRST_HOLD: usize = 12;
const RANDOM_CYCLES: usize = 48;

/// Every step from pattern to pattern after a hold of each, and then random sequences.
pub(super) fn stages(stimuli: usize, rng: &mut ChaCha8Rng) -> [Vec<Lane>; 2] {
    let patterns: Vec<Pattern> = Pattern::all(stimuli).collect();
    let start = |first: usize, rng: &mut ChaCha8Rng| {
        let held = [patterns[first]; FIRST_HOLD];
        held.into_iter().chain(trail(&patterns, first, rng)).collect()
    };
    let starts = (0..starts(stimuli)).map(|first| start(first, rng)).collect();
    let many = patterns.len() as u32;
    let waves =
        |rng: &mut ChaCha8Rng| (0..RANDOM_CYCLES).map(|_| patterns[rng.random_range(0..many) as usize]).collect();
    // As many more as there are stimuli more, for they have as many more steps to make.
    let mut random = Vec::new();
    for _ in 0..stimuli - 1 {
        random.extend([waves(rng), waves(rng)]);
        let holds = [1..=4, 1..=4, 3..=12, 3..=12];
        random.extend(holds.map(|cycles| random_holds(stimuli, RANDOM_CYCLES, cycles, rng)));
    }
    [starts, random]
}

/// Patterns that follow `first` such that each pattern follows each once, itself too.
fn trail(patterns: &[Pattern], first: usize, rng: &mut ChaCha8Rng) -> Lane {
    let many = patterns.len();
    loop {
        let mut unused = vec![vec![true; many]; many];
        let mut at = first;
        let mut trail = Vec::new();
        loop {
            let open: Vec<usize> = (0..many).filter(|&next| unused[at][next]).collect();
            if open.is_empty() {
                break;
            }
            let next = open[rng.random_range(0..open.len() as u32) as usize];
            unused[at][next] = false;
            trail.push(patterns[next]);
            at = next;
        }
        // A random trail may come back to its start, where it ends, before it has made every step.
        if trail.len() == many * many {
            return trail;
        }
    }
}

/// The mean over the steps from a pattern to the next one, 16 of two stimuli and 64 of three, of the score of the
/// smallest displacement in such a cycle, and the score of the smallest displacement of all.
pub(super) fn fitness<'a>(behavior: Behavior, holds: impl Iterator<Item = &'a PatternHold>) -> [f64; 2] {
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

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;
    use crate::gate::lanes::tests::{hold, nand, steps};

    #[test]
    fn each_wave_makes_every_step_once_after_its_first_hold() {
        for stimuli in [2, 3] {
            let ([lanes, random], many) = (stages(stimuli, &mut ChaCha8Rng::seed_from_u64(1)), starts(stimuli));
            for (first, lane) in Pattern::all(stimuli).zip(&lanes) {
                assert_eq!(lane[..FIRST_HOLD], [first; FIRST_HOLD]);
                assert_eq!(steps(stimuli, [&lane[FIRST_HOLD - 1..]]), vec![vec![1; many]; many]);
            }
            let random = steps(stimuli, random.iter().map(Vec::as_slice));
            assert!(random.iter().flatten().all(|&times| times > 0), "{random:?}");
        }
    }

    #[test]
    fn of_a_wave_every_cycle_counts_but_that_of_a_fresh_start() {
        let start = hold(None, 0, &[-9.0, 0.05]);
        assert_eq!(fitness(nand(), [start.clone()].iter()), [(0.75 + 15.0) / 16.0, 0.75]);
        let wrong = hold(Some(0), 3, &[0.05]);
        assert_eq!(fitness(nand(), [start, wrong].iter()), [(0.75 + 0.25 + 14.0) / 16.0, 0.25]);
    }
}
