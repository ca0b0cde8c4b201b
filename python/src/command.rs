//! The program `nbc`, which the package contains.

use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind};

use pyo3::prelude::*;

/// The exit status of a Rust program that panics.
const PANICKED: u8 = 101;

/// Runs the program on a command line, its own name first, and returns its exit status.
#[pyfunction]
pub fn program(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    // A panic has printed its message, as it does in a process of its own.
    py.detach(|| catch_unwind(AssertUnwindSafe(|| nbc::program(arguments))).unwrap_or(PANICKED))
}
