//! What tests of several files use: they start programs, wait for them, and read what they write.

use std::path::Path;

pub mod abc;
pub mod bench;
pub mod limits;
pub mod programs;
pub mod random_program;
pub mod schema;
#[cfg(target_os = "linux")]
pub mod slow_yosys;
pub mod tools;
pub mod traces;

/// The repository.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
