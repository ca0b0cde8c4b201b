//! Circuits: the netlist and everything that makes, changes, reads and writes it, without any physics.

mod alike;
mod and_graph;
mod blocks;
mod cells;
mod clause;
mod components;
pub mod correspondence;
pub mod elaborate;
mod environment;
#[cfg(test)]
mod example;
pub mod formats;
mod guarded;
mod index;
pub mod interned;
pub mod known;
pub mod levels;
mod logic;
mod loops;
mod lowering;
mod map;
mod memory;
mod netlist;
pub mod network;
mod options;
pub mod passes;
mod proof;
pub mod properties;
mod random_run;
mod recipes;
mod register;
mod rings;
pub mod rows;
mod settled;
mod signal_blocks;
mod storage;
pub mod synth;
pub mod timing;
pub mod two_level;
pub mod waves;
mod wording;

pub use alike::{Likeness, likeness};
pub use blocks::{BlockId, Blocks, keeps_state};
pub use cells::{CellKind, CellLibrary};
pub use clause::{Clause, ValuedBit};
pub use elaborate::{
    Inspection, Inspector, NetWidths, elaborate, elaborate_net, elaborate_reference, elaborate_watched,
    is_same_instance,
};
pub use environment::{Environment, EnvironmentFault, MemoryAccess};
pub use guarded::{Guarded, Role};
pub use logic::{Delayed, Logic};
pub use loops::Loops;
pub use lowering::{KeptLatch, RegisterForm, as_nands, has_multiplexers, kept, lower};
pub use map::{map, map_with};
pub use memory::Memory;
pub use nbc_base::source::CancelFlag;
pub use netlist::{Cell, NetId, Netlist, Node};
pub use options::{Effort, MapOptions, MappingObjective};
pub use proof::{Proof, prove};
pub use random_run::DesignRun;
pub use register::{Forcing, RegisterKind, RegisterNode};
pub use rings::rings;
pub use settled::{Settled, SettledRow};
pub use storage::{FlipFlop, Latch, Storage, Unphased, WhyUnphased, latches_as_registers};
pub use timing::Timing;
pub use wording::{MapError, NetlistError, Oscillation, ProofError};
