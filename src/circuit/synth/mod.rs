//! Logic synthesis: the search for few cells that compute the function of a circuit.

mod candidates;
pub mod exact;
pub mod graph;
mod parts;
pub mod prices;
pub mod reduce;
mod roam;
mod surroundings;
pub mod walk;

pub use reduce::reduce;
