//! Comparison of two networks: exhaustively, else gate by gate, else by SAT.

use crate::network::Network;
use crate::proof::method::Method;
use crate::proof::{exhaustive, sat, structural};

/// The most inputs, cuts included, for which every pattern is simulated.
const EXHAUSTIVE_INPUTS: usize = 16;

/// Compares two networks of the same inputs and outputs; fails with an output and the inputs at which it differs.
pub fn equal(one: &Network, two: &Network) -> Result<Method, (usize, Vec<bool>)> {
    assert!(one.inputs == two.inputs && one.outputs.len() == two.outputs.len(), "networks of the same ports");
    match one.inputs <= EXHAUSTIVE_INPUTS {
        true => exhaustive::equal(one, two),
        false if structural::equal(one, two) => Ok(Method::Structural),
        false => sat::equal(one, two),
    }
}
