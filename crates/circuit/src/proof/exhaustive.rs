//! Comparison of two networks over every pattern of their inputs.

use crate::network::{Network, counting_word};
use crate::proof::method::Method;

pub fn equal(one: &Network, two: &Network) -> Result<Method, (usize, Vec<bool>)> {
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
