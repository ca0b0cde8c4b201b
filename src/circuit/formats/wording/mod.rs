//! What can be wrong with circuit files and with writing them, as data, and how it is worded: a file for each way.

mod aiger;
mod encode;
mod text;

pub use aiger::{AigerError, AigerPlace};
pub use encode::EncodeError;
pub use text::TextError;
