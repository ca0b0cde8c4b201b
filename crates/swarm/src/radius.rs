//! How far a world may differ from the paper's before a robot makes errors as a gate (docs/robustness.md).

use crate::WorldSample;
use crate::characterize::errors_in;
use nbc_base::model::{PhysicsWorld, Robot, SafeRadius};
use nbc_sim::Simulator;

const RADII: [f64; 10] = [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0];

/// The largest factor up to which no world of the sample shows an error, and the errors at factor 1.
pub fn safe_radius(simulator: &Simulator, robot: &Robot, sample: &WorldSample, worlds: u32) -> SafeRadius {
    let errors = |radius: f64| {
        let scaled = WorldSample { variation: sample.variation.times(radius), ..*sample };
        let world = move |number| scaled.world(&PhysicsWorld::default(), number as usize);
        (0..worlds).map(move |number| errors_in(simulator, robot, &world(number)))
    };
    // Above 1, changes that cannot grow further are those of radius 1.
    let grows = |radius: &&f64| **radius <= 1.0 || sample.variation.times(**radius) != sample.variation.times(1.0);
    let is_safe = |radius: &&f64| errors(**radius).all(|share| share == 0.0);
    let radius = RADII.iter().filter(grows).take_while(is_safe).last().copied().unwrap_or(0.0);
    let mean = || errors(1.0).sum::<f64>() / f64::from(worlds.max(1));
    let error_rate = Some(if radius < 1.0 { mean() } else { 0.0 });
    SafeRadius { vary: sample.variation.changes(), worlds, seed: sample.seed, radius, error_rate }
}
