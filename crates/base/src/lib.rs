//! What every crate of `nbc` speaks: source text, diagnostics, and the nouns of the field.

pub mod budget;
pub mod diag;
pub mod fnv;
pub mod model;
pub mod source;

pub const PROGRAM: &str = "nbc";
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
