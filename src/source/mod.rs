//! Source text: files, spans into them, and the [`World`] that reads files for a core which does no input or output itself.

mod file;
mod span;
mod world;

pub use file::{LineColumn, SourceFile, Sources};
pub use span::{FileId, Span};
pub use world::{FileError, MemoryWorld, World};
