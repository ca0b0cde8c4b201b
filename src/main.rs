//! The `nbc` program.
#![deny(missing_docs)]

fn main() {}
