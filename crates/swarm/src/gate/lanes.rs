//! The patterns of the simulations of gates, cycle by cycle.

use std::ops::RangeInclusive;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::holds::HoldPlan;
use crate::noise::RobotNoise;
use nbc_base::model::{Pattern, PhysicsWorld, SearchObjective};

/// Simulations that run side by side, each from a fresh start.
pub(super) const LANES: usize = 4;
/// Cycles of each hold of the walks.
pub(super) const HOLD: usize = 4;
/// Four walks from four fresh starts, which together contain each of the twelve switches once.
const WALKS: [[usize; LANES]; LANES] = [[0, 1, 2, 3], [1, 0, 3, 2], [2, 0, 2, 1], [3, 1, 3, 0]];
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

/// The simulations of a candidate in each world: those from the four patterns, one hold each, and then random ones.
pub(super) fn stages(objective: SearchObjective) -> [Vec<Lane>; 2] {
    let mut rng = ChaCha8Rng::seed_from_u64(RANDOM_SEED);
    match objective {
        SearchObjective::Wave => {
            let start = |first: usize, rng: &mut ChaCha8Rng| {
                let held = [Pattern::PAIRS[first]; WAVE_HOLD];
                held.into_iter().chain(trail(first, rng)).collect()
            };
            let starts = (0..LANES).map(|first| start(first, &mut rng)).collect();
            let waves = |rng: &mut ChaCha8Rng| {
                (0..WAVE_CYCLES).map(|_| Pattern::PAIRS[rng.random_range(0..4u32) as usize]).collect()
            };
            let mut random = vec![waves(&mut rng), waves(&mut rng)];
            random.extend([1..=4, 1..=4, 3..=12, 3..=12].map(|cycles| random_holds(WAVE_CYCLES, cycles, &mut rng)));
            [starts, random]
        }
        SearchObjective::Distance | SearchObjective::Gate => {
            let walk = |walk: [usize; LANES]| walk.iter().flat_map(|&i| [Pattern::PAIRS[i]; HOLD]).collect();
            [WALKS.map(walk).into(), (0..LANES).map(|_| random_holds(RANDOM_CYCLES, 2..=4, &mut rng)).collect()]
        }
    }
}

/// Random patterns, each held for a random number of cycles, until there are so many.
fn random_holds(length: usize, cycles: RangeInclusive<u32>, rng: &mut ChaCha8Rng) -> Lane {
    let HoldPlan(holds) = HoldPlan::random(length / *cycles.start() as usize, cycles, rng);
    let cycles = holds.into_iter().flat_map(|(pattern, cycles)| std::iter::repeat_n(pattern, cycles as usize));
    cycles.take(length).collect()
}

/// Patterns that follow `first` such that each pattern follows each once, itself too.
fn trail(first: usize, rng: &mut ChaCha8Rng) -> Lane {
    loop {
        let mut unused = [[true; 4]; 4];
        let mut at = first;
        let mut trail = Vec::new();
        loop {
            let open: Vec<usize> = (0..4).filter(|&next| unused[at][next]).collect();
            if open.is_empty() {
                break;
            }
            let next = open[rng.random_range(0..open.len() as u32) as usize];
            unused[at][next] = false;
            trail.push(Pattern::PAIRS[next]);
            at = next;
        }
        // A random trail may come back to its start, where it ends, before it has made every step.
        if trail.len() == 16 {
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
    fn steps<'a>(lanes: impl IntoIterator<Item = &'a [Pattern]>) -> [[u32; 4]; 4] {
        let mut steps = [[0; 4]; 4];
        for two in lanes.into_iter().flat_map(|lane| lane.windows(2)) {
            steps[two[0].pair_index()][two[1].pair_index()] += 1;
        }
        steps
    }

    #[test]
    fn the_walks_make_every_switch_once() {
        let [walks, random] = stages(SearchObjective::Gate);
        let steps = steps(walks.iter().map(Vec::as_slice));
        assert!((0..4).all(|from| (0..4).all(|to| from == to || steps[from][to] == 1)), "{steps:?}");
        assert!(random.iter().all(|lane| lane.len() == RANDOM_CYCLES));
    }

    #[test]
    fn each_wave_makes_every_step_once_after_its_first_hold() {
        let [starts, random] = stages(SearchObjective::Wave);
        for (first, lane) in starts.iter().enumerate() {
            assert_eq!(lane[..WAVE_HOLD], [Pattern::PAIRS[first]; WAVE_HOLD]);
            assert_eq!(steps([&lane[WAVE_HOLD - 1..]]), [[1; 4]; 4]);
        }
        let random = steps(random.iter().map(Vec::as_slice));
        assert!(random.iter().flatten().all(|&times| times > 0), "{random:?}");
    }
}
