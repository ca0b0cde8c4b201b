//! Logic synthesis: the search for few cells that compute the function of a circuit.

mod candidates;
mod chains;
pub mod exact;
mod graph;
mod parts;
mod phases;
pub mod prices;
pub(crate) mod reduce;
mod samples;
mod shared_pairs;
mod surroundings;
mod walk;
mod wide;

pub(crate) use candidates::below;
pub(crate) use reduce::reduce_between_registers;
pub use reduce::{alternative, reduce};
pub use wide::{CellNetwork, Coverer, NetworkCell, widen};
