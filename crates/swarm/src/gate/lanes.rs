//! The patterns of the simulations of gates, cycle by cycle.

use std::ops::RangeInclusive;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::holds::HoldPlan;
use crate::noise::RobotNoise;
use nbc_base::model::{Pattern, PhysicsWorld, SearchObjective};

/// Cycles of each hold of the walks.
pub(super) const HOLD: usize = 4;
/// Four walks from four fresh starts, which together contain each of the twelve switches of two stimuli once.
const WALKS: [[usize; 4]; 4] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 2, 1], [3, 1, 3, 0]];
/// The walk from the first pattern of three stimuli. It makes each difference of numbers once, so that it and the walks
/// that begin later by one to seven contain each of the 56 switches once.
const WALK_OF_THREE: [usize; 8] = [0, 1, 7, 2, 6, 3, 5, 4];
/// Cycles of each random sequence.
const RANDOM_CYCLES: usize = 36;
/// Cycles of the first hold of waves: long enough to show bodies that are right only for a while.
const WAVE_HOLD: usize = 12;
/// Cycles of each random sequence of waves.
const WAVE_CYCLES: usize = 48;
/// The seed of the random sequences: the same for every candidate, and different from that of `characterize`.
const RANDOM_SEED: u64 = 0x6761_7465;

/// The patterns of one simulation, cycle by cycle.
pub(super) type Lane = Vec<Pattern>;

/// The simulations that run side by side in the first stage, one from each pattern of that many stimuli.
pub(super) fn starts(stimuli: usize) -> usize {
    1 << stimuli
}

/// The simulations of a candidate with that many stimuli in each world: those from each pattern, one hold each, and
/// then random ones.
pub(super) fn stages(objective: SearchObjective, stimuli: usize) -> [Vec<Lane>; 2] {
    let patterns: Vec<Pattern> = Pattern::all(stimuli).collect();
    let mut rng = ChaCha8Rng::seed_from_u64(RANDOM_SEED);
    match objective {
        SearchObjective::Wave => {
            let start = |first: usize, rng: &mut ChaCha8Rng| {
                let held = [patterns[first]; WAVE_HOLD];
                held.into_iter().chain(trail(&patterns, first, rng)).collect()
            };
            let starts = (0..starts(stimuli)).map(|first| start(first, &mut rng)).collect();
            let many = patterns.len() as u32;
            let waves =
                |rng: &mut ChaCha8Rng| (0..WAVE_CYCLES).map(|_| patterns[rng.random_range(0..many) as usize]).collect();
            // As many more as there are stimuli more, for they have as many more steps to make.
            let mut random = Vec::new();
            for _ in 0..stimuli - 1 {
                random.extend([waves(&mut rng), waves(&mut rng)]);
                let holds = [1..=4, 1..=4, 3..=12, 3..=12];
                random.extend(holds.map(|cycles| random_holds(stimuli, WAVE_CYCLES, cycles, &mut rng)));
            }
            [starts, random]
        }
        SearchObjective::Distance | SearchObjective::Gate => {
            let walk = |walk: &[usize]| walk.iter().flat_map(|&i| [patterns[i % 8]; HOLD]).collect();
            let later = |first: usize| WALK_OF_THREE.map(|number| number + first);
            let walks = match stimuli {
                2 => WALKS.iter().map(|one| walk(one)).collect(),
                _ => (0..8).map(|first| walk(&later(first))).collect(),
            };
            let random = |_| random_holds(stimuli, RANDOM_CYCLES, 2..=4, &mut rng);
            [walks, (0..starts(stimuli)).map(random).collect()]
        }
    }
}

/// Random patterns, each held for a random number of cycles, until there are so many.
fn random_holds(stimuli: usize, length: usize, cycles: RangeInclusive<u32>, rng: &mut ChaCha8Rng) -> Lane {
    let HoldPlan(holds) = HoldPlan::random(stimuli, length / *cycles.start() as usize, cycles, rng);
    let cycles = holds.into_iter().flat_map(|(pattern, cycles)| std::iter::repeat_n(pattern, cycles as usize));
    cycles.take(length).collect()
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

/// The patterns of lane `lane` as a body senses them.
pub(super) fn sensed(world: &PhysicsWorld, lane: usize, cycles: &Lane) -> Lane {
    let noise = RobotNoise::new(&world.noise, lane);
    let mut sensed = cycles.clone();
    for cycle in (1..sensed.len()).filter(|&cycle| noise.misses(cycle)) {
        sensed[cycle] = sensed[cycle - 1];
    }
    sensed
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How often each pattern follows each.
    fn steps<'a>(stimuli: usize, lanes: impl IntoIterator<Item = &'a [Pattern]>) -> Vec<Vec<u32>> {
        let many = starts(stimuli);
        let mut steps = vec![vec![0; many]; many];
        for two in lanes.into_iter().flat_map(|lane| lane.windows(2)) {
            steps[two[0].number(stimuli)][two[1].number(stimuli)] += 1;
        }
        steps
    }

    #[test]
    fn the_walks_make_every_switch_once() {
        for stimuli in [2, 3] {
            let [walks, random] = stages(SearchObjective::Gate, stimuli);
            let (steps, many) = (steps(stimuli, walks.iter().map(Vec::as_slice)), starts(stimuli));
            assert!((0..many).all(|from| (0..many).all(|to| from == to || steps[from][to] == 1)), "{steps:?}");
            let firsts: Vec<usize> = walks.iter().map(|lane| lane[0].number(stimuli)).collect();
            assert_eq!(firsts, (0..many).collect::<Vec<_>>());
            assert!(random.iter().all(|lane| lane.len() == RANDOM_CYCLES));
        }
    }

    #[test]
    fn each_wave_makes_every_step_once_after_its_first_hold() {
        for stimuli in [2, 3] {
            let ([lanes, random], many) = (stages(SearchObjective::Wave, stimuli), starts(stimuli));
            for (first, lane) in Pattern::all(stimuli).zip(&lanes) {
                assert_eq!(lane[..WAVE_HOLD], [first; WAVE_HOLD]);
                assert_eq!(steps(stimuli, [&lane[WAVE_HOLD - 1..]]), vec![vec![1; many]; many]);
            }
            let random = steps(stimuli, random.iter().map(Vec::as_slice));
            assert!(random.iter().flatten().all(|&times| times > 0), "{random:?}");
        }
    }
}
