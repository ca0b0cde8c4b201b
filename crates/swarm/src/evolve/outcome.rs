//! The result of evaluating a candidate, and counts of the results.

use serde::{Deserialize, Serialize};

use nbc_base::model::{Behavior, Displacements, Fault};

/// The result of a body, as far as the archive needs it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// The two fitnesses, higher is better: the distance in the variable simulation and the smallest distance in the
    /// fixed ones, or the two of gates.
    pub fitness: [f64; 2],
    /// The directions under each pattern.
    pub behavior: Behavior,
    /// Displacement in voxels over the fixed simulations, one for each pattern.
    pub displacement: Displacements,
}

/// The result of a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum CandidateOutcome {
    /// It was tried in full.
    Measured(Scores),
    /// Dropped early: cheaper tests showed that it cannot enter any niche.
    Surpassed,
    /// It walks one way under a constant pattern and the other way under the same pattern in the variable simulation.
    Inconsistent,
    /// A simulation failed.
    Faulty(Fault),
}

/// Counts of the results over a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Counts {
    /// Candidates tried.
    pub evaluations: u64,
    /// Networks drawn whose bodies could not be tried (too few actuators, or apart).
    pub undeveloped: u64,
    /// Candidates dropped early because they could not enter any niche.
    pub surpassed: u64,
    /// Candidates whose long and short simulations disagree.
    pub inconsistent: u64,
    /// Candidates with a failed simulation.
    pub faults: u64,
    /// Niches filled for the first time.
    pub new: u64,
    /// Elites replaced or joined.
    pub improved: u64,
}
