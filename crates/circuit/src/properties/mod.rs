//! Properties of all steps of a machine: a search proves them, or finds the shortest run that violates one
//! (docs/always.md).
//!
//! A circuit and what is said of it become a transition system of and-gates (`machine.rs`, `monitor.rs`), maybe with
//! its environment (`beside.rs`), and so do two circuits to be compared (`pair.rs`); an AIGER file is one already.
//! The search looks at one number of steps after the other (`bounded.rs`), tries induction, and looks for an invariant
//! (`pairs.rs`, `frames.rs`). Proofs are checked by other code (`certificate.rs`), and runs are simulated.

mod beside;
mod bounded;
mod certificate;
#[cfg(test)]
mod circuit_tests;
mod frames;
mod machine;
mod monitor;
mod needed;
mod pair;
mod pairs;
mod search;
#[cfg(test)]
mod search_tests;
mod solver;
mod system;
mod unrolled;
mod wording;

pub use crate::and_graph::AndLiteral;
pub use beside::EnvironmentStep;
pub use certificate::InductiveProof;
pub use machine::StepClock;
pub use monitor::Monitored;
pub use search::{EmptyProof, PropertySearch, PropertyVerdict, SearchBudget};
pub(crate) use solver::{Solved, SolverLimits};
pub use system::{SystemRegister, SystemRun, TransitionSystem};
pub use wording::NoSteps;
