//! Boolean circuits that are learned from rows of values: recognized functions, two-level logic, decision trees,
//! small forests and codes of votes, of which the best on rows that were not used is taken.

mod arithmetic;
mod bits;
mod code;
mod cubes;
mod examples;
mod forest;
mod graph;
mod learner;
mod method;
mod recognize;
mod tree;
mod votes;

pub use bits::Bits;
pub use examples::{Examples, Wanted};
pub use graph::{GateGraph, Literal};
pub use learner::{Accuracy, LearnOptions, LearnedCircuit, LearnedOutput, Learner, Tried};
