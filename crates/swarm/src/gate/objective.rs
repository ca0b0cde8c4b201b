//! The objectives of gates: what is simulated, and how it is scored.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::gate::lanes::Lane;
use crate::gate::{settled, wave};
use crate::holds::PatternHold;
use nbc_base::model::Behavior;

/// The seed of the random sequences: the same for every candidate, and different from that of `characterize`.
const RANDOM_SEED: u64 = 0x6761_7465;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GateObjective {
    /// The correct output soon after a switch: the objective `gate`.
    Settled,
    /// The correct output in every cycle: the objective `wave`.
    Wave,
}

/// The simulations of a candidate with that many stimuli in each world: those from each pattern, one hold each, and
/// then random ones.
pub(super) fn stages(objective: GateObjective, stimuli: usize) -> [Vec<Lane>; 2] {
    let rng = &mut ChaCha8Rng::seed_from_u64(RANDOM_SEED);
    match objective {
        GateObjective::Settled => settled::stages(stimuli, rng),
        GateObjective::Wave => wave::stages(stimuli, rng),
    }
}

/// The fitnesses for these holds. More holds and longer ones never raise them.
pub(super) fn fitness<'a>(
    objective: GateObjective,
    behavior: Behavior,
    holds: impl Iterator<Item = &'a PatternHold> + Clone,
) -> [f64; 2] {
    match objective {
        GateObjective::Settled => settled::fitness(behavior, holds),
        GateObjective::Wave => wave::fitness(behavior, holds),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gate::worth::tests::{hold, nand};

    #[test]
    fn more_holds_never_raise_the_fitness() {
        let holds: Vec<PatternHold> =
            (0..40).map(|i| hold((i > 0).then_some((i + 1) % 4), i % 4, &[0.3, 0.1 - 0.01 * i as f64, 0.2])).collect();
        for objective in [GateObjective::Settled, GateObjective::Wave] {
            let fitnesses: Vec<[f64; 2]> = (1..40).map(|n| fitness(objective, nand(), holds[..n].iter())).collect();
            assert!(fitnesses.windows(2).all(|two| two[1][0] <= two[0][0] && two[1][1] <= two[0][1]), "{objective:?}");
        }
    }
}
