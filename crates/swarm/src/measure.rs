//! All measurements of a body for its robot file.

use crate::characterize::characterize;
use crate::distance::fixed_displacements;
use nbc_base::model::{Behavior, Body, CYCLE_STEPS, Character, Displacements, Fault, Setting};
use nbc_sim::Simulator;

/// Env steps of the paper's fixed simulations (docs/physics.md 10).
pub const FIXED_STEPS: u32 = 10 * CYCLE_STEPS;

#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Displacement in voxels over the paper's fixed simulations, one for each pattern.
    pub displacement: Displacements,
    pub behavior: Behavior,
    pub character: Character,
}

/// The displacements of each body in the paper's fixed simulations, in voxels.
pub fn walk(simulator: &Simulator, bodies: &[Body]) -> Vec<Result<Displacements, Fault>> {
    fixed_displacements(simulator, &Setting::default(), bodies, FIXED_STEPS)
}

pub fn measure(simulator: &Simulator, body: &Body) -> Result<Measurement, Fault> {
    let displacement = walk(simulator, std::slice::from_ref(body)).remove(0)?;
    let behavior = displacement.behavior();
    Ok(Measurement { displacement, behavior, character: characterize(simulator, body, behavior)? })
}
