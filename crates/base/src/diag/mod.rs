//! Diagnostics: what is wrong with the user's input, as plain data with places; [`render`] is the only user of miette,
//! [`suggest`] finds what was meant. Each stage has its own errors as data, and words them as diagnostics in its
//! `wording` files.

mod code;
mod counted;
mod diagnostic;
mod diagnostics;
mod file;
mod finding;
mod fix;
#[cfg(feature = "render")]
pub mod render;
mod severity;
pub mod suggest;
mod verilog;
mod visible;

pub use code::Code;
pub use counted::counted;
pub use diagnostic::{Diagnostic, Label, Related};
pub use diagnostics::Diagnostics;
pub use file::{folder_error, io_words, similar_file};
pub use finding::{Finding, FoundFix, PlacedText, TextPlace, findings};
pub use fix::{Edit, Fix};
pub use severity::Severity;
pub use suggest::Suggestion;
pub use visible::{is_hidden, visible, without_passwords};
