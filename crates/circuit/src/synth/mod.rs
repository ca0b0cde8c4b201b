//! Logic synthesis: the search for few cells that compute the function of a circuit.

mod candidates;
mod care;
pub mod exact;
mod graph;
mod parts;
mod phases;
pub mod prices;
pub(crate) mod reduce;
mod roam;
mod shared_pairs;
mod surroundings;
mod walk;

pub use care::CareSet;
pub use reduce::{reduce, reduce_within};
