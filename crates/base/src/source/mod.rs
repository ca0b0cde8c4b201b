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
pub use proof_origin::{ForeignCircuit, ProofOrigin, grouped};
pub use span::{FileId, Span};
pub use verilog::{
    SecondReading, VerilogError, VerilogFile, VerilogFiles, VerilogModule, VerilogModules, VerilogNote, VerilogPlace,
};
pub use world::{EntryKind, MemoryWorld, OverlayWorld, SharedWorld, SourceWorld};
