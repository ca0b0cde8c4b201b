//! Changes of a body voxel by voxel, for bodies that no network was developed into.

use std::sync::Arc;

use rand::{Rng, RngExt};

use crate::evolve::validate;
use nbc_base::model::{Body, Palette};

const MOST_CHANGES: u32 = 3;
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

/// A body with as many voxels as a random share of its box, each of a random material. It may be invalid.
pub(super) fn random_body<R: Rng>(width: usize, height: usize, palette: &Arc<Palette>, rng: &mut R) -> Body {
    let share = rng.random::<f64>();
    let last = palette.materials().len() as u8;
    let mut code = || if rng.random::<f64>() < share { rng.random_range(1..=last) } else { 0 };
    let codes = (0..width * height).map(|_| code()).collect();
    Body::new(width, height, codes, Arc::clone(palette))
}

/// A body with a random rectangle of another one of the same box in its place. It may be invalid.
pub(super) fn crossed<R: Rng>(body: &Body, other: &Body, rng: &mut R) -> Body {
    let mut side = |length: usize| {
        let (one, two) = (rng.random_range(0..length), rng.random_range(0..length));
        one.min(two)..=one.max(two)
    };
    let (columns, rows) = (side(body.width()), side(body.height()));
    let place = |at: usize| (at % body.width(), at / body.width());
    let is_inside = |at: usize| columns.contains(&place(at).0) && rows.contains(&place(at).1);
    let code = |at: usize| if is_inside(at) { other.codes()[at] } else { body.codes()[at] };
    let codes = (0..body.codes().len()).map(code).collect();
    Body::new(body.width(), body.height(), codes, body.palette().clone())
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use nbc_base::model::Palette;

    #[test]
    fn a_crossed_body_has_a_rectangle_of_the_other() {
        let bodies = ["11111", "22222"].map(|row| Body::parse(&[row; 4], &Palette::paper()).unwrap());
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..100 {
            let child = crossed(&bodies[0], &bodies[1], &mut rng);
            let others: Vec<String> = child.rows().into_iter().filter(|row| row.contains('2')).collect();
            assert!(!others.is_empty() && others.iter().all(|row| *row == others[0]), "{:?}", child.rows());
            assert!(!others[0].trim_matches('1').contains('1'));
        }
    }

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
