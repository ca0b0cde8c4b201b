//! The result of evaluating a candidate, and counts of the results.

use serde::{Deserialize, Serialize};

use nbc_base::model::{Behavior, Displacements, Fault};

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// The two fitnesses, higher is better: the distance in the variable simulation and the smallest distance in the
    /// fixed ones, or the two of gates.
    pub fitness: [f64; 2],
    pub behavior: Behavior,
    /// Displacement in voxels over the fixed simulations, one for each pattern.
    pub displacement: Displacements,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum CandidateOutcome {
    Measured(Scores),
    /// Dropped early: cheaper tests showed that it cannot enter any niche.
    Surpassed,
    /// It walks one way under a constant pattern and the other way under the same pattern in the variable simulation.
    Inconsistent,
    Faulty(Fault),
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Bodies tried.
    pub evaluations: u64,
    /// Networks drawn whose bodies could not be tried (too few actuators, or apart).
    pub undeveloped: u64,
    /// Bodies dropped early because they could enter no niche.
    pub surpassed: u64,
    /// Bodies that contradicted themselves.
    pub inconsistent: u64,
    /// Bodies whose simulation failed.
    pub faults: u64,
    /// Niches filled for the first time.
    pub new: u64,
    /// Elites replaced or joined.
    pub improved: u64,
}
