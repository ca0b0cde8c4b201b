//! Source text: files, spans, and the [`SourceWorld`] that reads files for the core, which itself does no input or
//! output.

mod cancel;
mod file;
mod file_error;
mod proof_origin;
mod span;
mod verilog;
mod world;

pub use cancel::CancelFlag;
pub use file::{LineColumn, LineStarts, SourceFile, Sources, without_mark};
pub use file_error::FileError;
pub use proof_origin::{ForeignCircuit, ProofOrigin};
pub use span::{FileId, Span};
pub use verilog::{
    Simulated, VERILOG_SOURCE, VerilogDifference, VerilogDrivers, VerilogError, VerilogFault, VerilogFile,
    VerilogModules, VerilogName, VerilogPlace, verilog_line,
};
pub use world::{EntryKind, MemoryWorld, OverlayWorld, SharedWorld, SourceWorld};
