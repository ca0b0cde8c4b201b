//! Source text: files, spans, and the [`SourceWorld`] that reads files for the core, which itself does no input or
//! output.

mod file;
mod span;
mod verilog;
mod world;

pub use file::{LineColumn, LineStarts, SourceFile, Sources};
pub use span::{FileId, Span};
pub use verilog::{VerilogError, VerilogModules};
pub use world::{FileError, MemoryWorld, OverlayWorld, SharedWorld, SourceWorld};
