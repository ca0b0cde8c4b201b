//! Verilog, through Yosys.
//!
//! Yosys reads the files that a text names, calls functions of C for it, and evaluates its loops. So it gets one text
//! that was preprocessed and checked here, in a folder of its own, with limits of time and memory. It ends when the
//! caller ends.

mod assertions;
mod checker;
mod conditions;
mod drivers;
mod icarus;
mod listing;
mod macros;
mod misread;
mod modules;
mod open_values;
mod parameter;
mod printing;
mod process;
mod reason;
mod rtlil;
mod source;
mod token;
mod yosys;

pub use parameter::ParameterValue;
pub(super) use yosys::Verilog;
pub use yosys::{TopModule, VerilogFiles};
