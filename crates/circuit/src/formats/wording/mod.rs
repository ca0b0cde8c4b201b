//! Messages about circuit files and about writing them: a file for each format.

pub mod aiger;
pub mod bench;
pub mod blif;
pub mod encode;
pub mod pla;
pub mod text;
