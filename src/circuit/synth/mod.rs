//! Logic synthesis: the search for few cells that compute what a circuit computes.

pub mod exact;
pub mod graph;
pub mod prices;
pub mod reduce;
mod roam;
pub mod walk;
pub mod window;

pub use reduce::{Effort, reduce};
