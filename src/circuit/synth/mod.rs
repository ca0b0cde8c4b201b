//! Logic synthesis: the search for few cells that compute the function of a circuit.

pub mod exact;
pub mod graph;
pub mod prices;
pub mod reduce;
mod roam;
pub mod walk;
pub mod window;

pub use reduce::reduce;
