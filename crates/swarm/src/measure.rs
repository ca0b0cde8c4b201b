//! All measurements of a body for its robot file.

use crate::characterize::characterize;
use crate::evaluate::{fixed_displacements, fixed_trials};
use nbc_base::model::{Behavior, Body, CYCLE_STEPS, Character, Fault, Setting, Trial};
use nbc_sim::Simulator;

/// Env steps of the paper's fixed simulations (docs/physics.md 10).
pub const FIXED_STEPS: u32 = 10 * CYCLE_STEPS;

/// The measurements of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Displacement in voxels over the paper's fixed simulations, patterns 00, 01, 10, 11.
    pub displacement: [f64; 4],
    /// Its behavior in them.
    pub behavior: Behavior,
    /// Its character as a gate with this behavior.
    pub character: Character,
}

/// The displacement of each body in the paper's fixed simulations, in voxels, patterns 00, 01, 10, 11; or the fault of
/// one of them.
pub fn walk(simulator: &Simulator, bodies: &[Body]) -> Vec<Result<[f64; 4], Fault>> {
    let trials: Vec<Trial> = bodies.iter().flat_map(|body| fixed_trials(body, FIXED_STEPS)).collect();
    let trajectories = simulator.run_trials(&Setting::default(), &trials);
    let (four, _) = trajectories.as_chunks();
    four.iter().map(fixed_displacements).collect()
}

/// Measures a body by the paper's fixed simulations and as a gate.
///
/// # Errors
/// The fault of a simulation.
pub fn measure(simulator: &Simulator, body: &Body) -> Result<Measurement, Fault> {
    let displacement = walk(simulator, std::slice::from_ref(body)).remove(0)?;
    let behavior = Behavior::of(&displacement);
    Ok(Measurement { displacement, behavior, character: characterize(simulator, body, behavior)? })
}
