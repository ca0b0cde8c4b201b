//! Diagnostics: what is wrong with the user's input, as plain data with places; [`render`] is the only user of miette, [`suggest`] finds what was meant.

mod code;
mod counted;
mod diagnostic;
mod file;
mod json;
pub mod render;
pub mod suggest;

pub use code::Code;
pub use counted::counted;
pub use diagnostic::{Diagnostic, Label, Related, Severity};
pub use file::io_words;
pub use json::json;
