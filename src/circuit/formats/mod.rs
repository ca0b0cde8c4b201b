//! Exchange formats: BLIF, AIGER and ISCAS .bench in; BLIF, AIGER, Verilog, DOT and .nb out.

pub mod aiger;
pub mod bench;
pub mod blif;
mod design;
pub mod dot;
mod draft;
mod format;
mod names;
pub mod nb;
pub mod verilog;
mod wording;

pub use design::{Design, Register, RegisterKind};
pub use format::CircuitFormat;
