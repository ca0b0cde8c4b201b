//! What can be wrong with circuit files and with writing them, as data, and how it is worded: a file for each format.

mod aiger;
mod bench;
mod blif;
mod encode;
mod pla;
mod text;

pub use aiger::{AigerError, AigerPlace};
pub use bench::BenchError;
pub use blif::{BlifError, ModelError};
pub use encode::EncodeError;
pub use pla::PlaError;
pub use text::TextError;
