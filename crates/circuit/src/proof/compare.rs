//! Comparison of two networks: exhaustively, else gate by gate, else by SAT.

use crate::network::{Network, counting_word};
use crate::proof::method::Method;
use crate::proof::{sat, structural};

/// The most inputs, cuts included, for which every pattern is simulated.
const EXHAUSTIVE_INPUTS: usize = 16;

/// Compares two networks of the same inputs and outputs; fails with an output and the inputs at which it differs.
pub fn equal(one: &Network, two: &Network) -> Result<Method, (usize, Vec<bool>)> {
    assert!(one.inputs == two.inputs && one.outputs.len() == two.outputs.len(), "networks of the same ports");
    if one.inputs <= EXHAUSTIVE_INPUTS {
        exhaustive(one, two)
    } else if structural::equal(one, two) {
        Ok(Method::Structural)
    } else {
        sat::equal(one, two)
    }
}

fn exhaustive(one: &Network, two: &Network) -> Result<Method, (usize, Vec<bool>)> {
    let patterns = 1u64 << one.inputs;
    for block in 0..(patterns as usize).div_ceil(64) {
        let inputs: Vec<_> = (0..one.inputs).map(|i| counting_word(i, block)).collect();
        let (first, second) = (one.simulate(&inputs), two.simulate(&inputs));
        for (output, (&a, &b)) in one.outputs.iter().zip(&two.outputs).enumerate() {
            let different = first[a as usize] ^ second[b as usize];
            if different != 0 {
                let at = different.trailing_zeros();
                return Err((output, inputs.iter().map(|word| word >> at & 1 == 1).collect()));
            }
        }
    }
    Ok(Method::Exhaustive { patterns })
}
