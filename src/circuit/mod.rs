//! Circuits: the netlist, what makes it, what changes it, what reads and writes it. Knows nothing of physics.

mod netlist;

pub use netlist::{Cell, NetId, Netlist, NetlistError, Node};
