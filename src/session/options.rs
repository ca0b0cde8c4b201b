//! What a door may choose about compiling.

use crate::circuit::{Effort, MapOptions, MappingObjective};
use crate::model::Library;

/// Where evolution runs are unless another place is named.
pub const RUNS: &str = "out";

/// How a circuit becomes a swarm. The default is what the source declares.
#[derive(Clone, Debug)]
pub struct CompileOptions {
    /// The declared swarm, where several are declared for the circuit.
    pub swarm: Option<String>,
    /// These robots instead of those that the source declares.
    pub robots: Option<Library>,
    /// What mapping minimizes.
    pub objective: MappingObjective,
    /// How much work mapping does.
    pub effort: Effort,
    /// The folder of evolution runs: the robots of `from: NAME` are in `NAME/robots` there.
    pub runs: String,
}

impl Default for CompileOptions {
    fn default() -> Self {
        let MapOptions { objective, effort } = MapOptions::default();
        Self { swarm: None, robots: None, objective, effort, runs: RUNS.to_owned() }
    }
}

impl CompileOptions {
    /// What of it concerns mapping.
    pub fn mapping(&self) -> MapOptions {
        MapOptions { objective: self.objective, effort: self.effort }
    }
}
