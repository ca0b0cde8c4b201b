//! Diagnostics: what is wrong with the user's input, as plain data with places; [`render`] is the only user of miette.

mod code;
mod diagnostic;
mod file;
pub mod render;

pub use code::Code;
pub use diagnostic::{Diagnostic, Label, Related, Severity};
