//! The options of compiling.

use nbc_base::model::Library;
use nbc_circuit::{CancelFlag, Effort, MapOptions, MappingObjective};

pub const RUNS: &str = "out";

/// Options of compiling a circuit to a swarm. The default is what the source declares.
#[derive(Clone, Debug)]
pub struct CompileOptions {
    pub swarm: Option<String>,
    pub robots: Option<Library>,
    pub without: Vec<String>,
    pub objective: MappingObjective,
    pub effort: Effort,
    /// Replacements of declared files, by name and path.
    pub files: Vec<(String, String)>,
    /// The folder of evolution runs; the robots of `from: NAME` are in its `NAME/robots`.
    pub runs: String,
    pub cancel: CancelFlag,
}

impl Default for CompileOptions {
    fn default() -> Self {
        let MapOptions { objective, effort, cancel } = MapOptions::default();
        Self {
            swarm: None,
            robots: None,
            without: Vec::new(),
            objective,
            effort,
            files: Vec::new(),
            runs: RUNS.to_owned(),
            cancel,
        }
    }
}

impl CompileOptions {
    pub fn mapping(&self) -> MapOptions {
        MapOptions { objective: self.objective, effort: self.effort, cancel: self.cancel.clone() }
    }
}
