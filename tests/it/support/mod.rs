//! What tests of several files use: they start programs, wait for them, and read what they write. `use
//! crate::support::*` has the names that most of them need.

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

pub use std::fs;
pub use std::path::{Path, PathBuf};

pub use serde_json::{Value, json};

pub use abc::*;
pub use bench::*;
pub use limits::*;
pub use programs::*;
pub use schema::*;
pub use tools::*;

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[track_caller]
pub fn text_of(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A text whose words are parted by single spaces, so that line ends and columns do not matter.
pub fn squeezed(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
