//! Changes of a body voxel by voxel, for searches from a body that no network was developed into.

use rand::{Rng, RngExt};

use crate::evolve::validate;
use nbc_base::model::Body;

/// The most voxels that change at once.
const MOST_CHANGES: u32 = 3;
/// Draws after which a body stays as it is.
const TRIES: u32 = 100;

/// A valid body that differs from this one in one to three voxels; the same body if none is found.
pub fn neighbor<R: Rng>(body: &Body, rng: &mut R) -> Body {
    for _ in 0..TRIES {
        let mut codes = body.codes().to_vec();
        for _ in 0..rng.random_range(1..=MOST_CHANGES) {
            let place = rng.random_range(0..codes.len());
            codes[place] = rng.random_range(0..=body.palette().materials().len() as u8);
        }
        let changed = Body::new(body.width(), body.height(), codes, body.palette().clone());
        if changed != *body && validate(&changed).is_ok() {
            return changed;
        }
    }
    body.clone()
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use nbc_base::model::Palette;

    #[test]
    fn neighbors_are_valid_and_differ_in_few_voxels() {
        let body = Body::parse(&["343", "303"], &Palette::paper()).unwrap();
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..200 {
            let other = neighbor(&body, &mut rng);
            let changes = body.codes().iter().zip(other.codes()).filter(|(a, b)| a != b).count();
            assert!((1..=3).contains(&changes) && validate(&other).is_ok(), "{:?}", other.rows());
        }
    }
}
