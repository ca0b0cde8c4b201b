//! How far a world may differ from the paper's before a robot makes errors as a gate (docs/robustness.md).

use crate::WorldSample;
use crate::characterize::errs;
use nbc_base::model::{PhysicsWorld, Robot, SafeRadius};
use nbc_sim::Simulator;

/// The factors of the changes that are tried, in order.
const RADII: [f64; 8] = [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0];

/// The largest factor of a sample's changes at which a robot makes no errors in any of its worlds, nor at a smaller one
/// that was tried.
pub fn safe_radius(simulator: &Simulator, robot: &Robot, sample: &WorldSample, worlds: u32) -> SafeRadius {
    let is_safe = |radius: &&f64| {
        let scaled = WorldSample { variation: sample.variation.times(**radius), ..*sample };
        let world = |number| scaled.world(&PhysicsWorld::default(), number as usize);
        (0..worlds).all(|number| !errs(simulator, robot, &world(number)))
    };
    let radius = RADII.iter().take_while(is_safe).last().copied().unwrap_or(0.0);
    SafeRadius { vary: sample.variation.changes(), worlds, seed: sample.seed, radius }
}
