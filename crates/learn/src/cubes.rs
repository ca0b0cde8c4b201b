//! Two-level logic of rows: cubes that are grown one after another until every row of one value is in a cube.

use crate::bits::Bits;
use crate::graph::{GateGraph, Literal};
use crate::tree::Feature;

/// Cubes as literals: features with the values that they must have.
#[derive(Clone, Debug)]
pub struct Cubes {
    cubes: Vec<Vec<(usize, bool)>>,
}

const MOST: usize = 400;

impl Cubes {
    /// Grows cubes that cover rows of `wanted` and no other rows. One that covers fewer than `least` rows which no cube
    /// had covered is left out: it is noise rather than a rule.
    pub fn grow(features: &[Feature], wanted: &Bits, least: usize) -> Self {
        let other = wanted.not();
        let (mut left, mut cubes) = (wanted.clone(), Vec::new());
        while cubes.len() < MOST {
            let Some(seed) = left.ones().next() else { break };
            let (cube, covered) = grow(features, seed, &left, &other);
            let count = left.count_and(&covered);
            left = left.and_not(&covered);
            if count >= least {
                cubes.push(cube);
            }
        }
        Self { cubes }
    }

    pub fn build(&self, graph: &mut GateGraph, features: &[Feature]) -> Literal {
        let literal = |&(feature, value): &(usize, bool)| features[feature].literal.inverted_if(!value);
        let terms = self.cubes.iter().map(|cube| graph.every(cube.iter().map(literal).collect())).collect();
        graph.any(terms)
    }
}

/// A cube around a row: literals of the row are added, each the one that tells the wanted rows best from the others
/// (FOIL's gain), until no other row is in the cube.
fn grow(features: &[Feature], seed: usize, wanted: &Bits, other: &Bits) -> (Vec<(usize, bool)>, Bits) {
    let (mut inside, mut outside) = (wanted.clone(), other.clone());
    let mut region = Bits::all(wanted.rows(), true);
    let mut cube = Vec::new();
    while outside.count() > 0 {
        let (all_in, all_out) = (inside.count(), outside.count());
        let mut best: Option<(f64, usize)> = None;
        for (at, feature) in features.iter().enumerate() {
            let value = feature.bits.get(seed);
            let side = |rows: &Bits, all: usize| {
                let ones = rows.count_and(&feature.bits);
                if value { ones } else { all - ones }
            };
            let out = side(&outside, all_out);
            if out == all_out {
                continue;
            }
            let held = side(&inside, all_in);
            let purity = |held: usize, out: usize| libm::log2(held as f64 / (held + out) as f64);
            let gain = held as f64 * (purity(held, out) - purity(all_in, all_out));
            if best.is_none_or(|(most, _)| gain > most) {
                best = Some((gain, at));
            }
        }
        // Equal rows with different values cannot be told apart.
        let Some((_, at)) = best else { break };
        let value = features[at].bits.get(seed);
        let keep = |rows: &Bits| if value { rows.and(&features[at].bits) } else { rows.and_not(&features[at].bits) };
        (inside, outside, region) = (keep(&inside), keep(&outside), keep(&region));
        cube.push((at, value));
    }
    (cube, region)
}
