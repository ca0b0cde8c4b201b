//! Diagnostics: what is wrong with the user's input, as plain data with places; [`render`] is the only user of miette, [`suggest`] finds what was meant.

mod code;
mod counted;
mod diagnostic;
mod file;
mod json;
pub mod render;
pub mod suggest;
mod visible;

pub use code::Code;
pub use counted::counted;
pub use diagnostic::{Diagnostic, Label, Related, Severity};
pub use file::io_words;
pub use json::json;
pub use visible::{is_hidden, visible};
