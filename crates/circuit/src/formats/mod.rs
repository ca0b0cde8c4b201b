//! Exchange formats: BLIF, PLA, AIGER and ISCAS .bench in; BLIF, PLA, AIGER, Verilog, DOT and .nb out.

pub mod aiger;
mod aiger_model;
pub mod bench;
pub mod blif;
mod blif_text;
pub mod buses;
mod circuit;
mod design;
pub mod dot;
mod draft;
mod forced;
mod format;
mod model_gate;
mod names;
pub mod nb;
mod nb_names;
pub mod pla;
pub mod verilog;
mod verilog_ports;
mod wording;

pub use crate::register::{Forcing, RegisterKind};
pub use aiger_model::AigerModel;
pub use blif::{verilog_design, verilog_module};
pub use circuit::circuit;
pub use design::Design;
pub use format::{CircuitFormat, CircuitSource};
pub use nb_names::is_word;
