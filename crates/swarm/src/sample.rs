//! Samples of worlds: some physics of a world vary, each uniformly, and by a seed.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use nbc_base::model::{PhysicsWorld, Variation};

/// Those drawn before the seed of the noise. Quantities that were added are drawn after it, so that samples stay.
const FIRST_DRAWS: usize = 10;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldSample {
    pub variation: Variation,
    pub seed: u64,
}

impl WorldSample {
    /// World `number` draws the same numbers for any variation, so worlds of one seed differ in the same directions.
    pub fn world(&self, around: &PhysicsWorld, number: usize) -> PhysicsWorld {
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        rng.set_stream(number as u64);
        let mut draws = [0.0; Variation::DRAWS];
        let (first, added) = draws.split_at_mut(FIRST_DRAWS);
        fill(first, &mut rng);
        // A seed that the language can write.
        let seed = rng.random::<u32>().into();
        fill(added, &mut rng);
        self.variation.world(around, draws, seed)
    }
}

fn fill(draws: &mut [f64], rng: &mut ChaCha8Rng) {
    draws.fill_with(|| 2.0 * rng.random::<f64>() - 1.0);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn worlds_of_a_number_differ_in_the_same_direction() {
        let wide = "friction=50%,gravity=50%".parse::<Variation>().unwrap();
        let worlds = |variation| {
            let sample = WorldSample { variation, seed: 3 };
            (0..200).map(move |number| sample.world(&PhysicsWorld::default(), number).factors)
        };
        for (far, near) in worlds(wide).zip(worlds(wide.times(0.1))) {
            assert!((far.friction - 1.0 - 10.0 * (near.friction - 1.0)).abs() < 1e-12);
        }
        let alone = "gravity=50%".parse().unwrap();
        assert!(worlds(wide).zip(worlds(alone)).all(|(both, one)| both.gravity == one.gravity && one.friction == 1.0));
        let (below, above) =
            (worlds(wide).filter(|w| w.friction < 0.8).count(), worlds(wide).filter(|w| w.friction > 1.2));
        assert!((40..80).contains(&below) && (40..80).contains(&above.count()), "uniform to both sides");
    }
}
