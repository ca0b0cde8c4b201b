//! What comes of trying a candidate, and how often each came.

use serde::{Deserialize, Serialize};

use crate::model::{Behavior, Fault};

/// What a body did, as far as the archive needs to know.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// The two fitnesses, each the more the better: distance in the variable simulation and least distance in the fixed ones, or
    /// the two of gates.
    pub fitness: [f64; 2],
    /// Which way it walks.
    pub behavior: Behavior,
    /// Displacement in voxels over the fixed simulations, patterns 00, 01, 10, 11.
    pub displacement: [f64; 4],
}

/// What came of a candidate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// It was tried in full.
    Measured(Scores),
    /// Cheaper tests showed that no niche can take it; the rest was left out.
    Surpassed,
    /// It walks one way under a constant pattern and the other way under the same pattern in the variable simulation.
    Inconsistent,
    /// A simulation could not go on.
    Faulty(Fault),
}

/// How often each outcome came, over a whole run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Candidates tried.
    pub evaluations: u64,
    /// Networks drawn whose bodies could not be tried (too few actuators, or apart).
    pub undeveloped: u64,
    /// Candidates left early because no niche could take them.
    pub surpassed: u64,
    /// Candidates that contradicted themselves.
    pub inconsistent: u64,
    /// Candidates whose simulation could not go on.
    pub faults: u64,
    /// Niches filled for the first time.
    pub new: u64,
    /// Elites replaced or joined.
    pub improved: u64,
}
