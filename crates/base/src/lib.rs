//! What every crate of `nbc` speaks: source text, diagnostics, and the nouns of the field.

pub mod budget;
pub mod diag;
pub mod fnv;
pub mod model;
pub mod source;

/// The name of the program, as results and robot files have it.
pub const PROGRAM: &str = "nbc";
/// The version of the program. All its crates have the same.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
