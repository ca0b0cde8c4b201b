//! Verilog, through Yosys.
//!
//! Yosys reads the files that a text names, calls functions of C for it, and evaluates its loops. So it is given one
//! text that was preprocessed and judged here, in a folder of its own, with little time and memory, and ends with its
//! asker.

mod checker;
mod conditions;
mod listing;
mod macros;
mod process;
mod source;
mod token;
mod yosys;

pub(super) use yosys::Verilog;
pub use yosys::VerilogFiles;
