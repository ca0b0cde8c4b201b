//! Circuits made of soft robots: a declarative language, a compiler to swarms of robots without a brain, and their
//! physics.
//!
//! A circuit with its tests, run in full physics:
//!
//! ```
//! nbc::run_file("circuits/half_adder.nb", &nbc::CompileOptions::default())?.assert_passed();
//! # Ok::<(), nbc::Diagnostics>(())
//! ```
#![deny(missing_docs)]

pub mod check;
pub mod circuit;
#[cfg(feature = "cli")]
pub mod cli;
pub mod diag;
pub mod evolve;
pub mod model;
pub mod report;
pub mod session;
pub mod sim;
pub mod source;
pub mod store;
pub mod swarm;
pub mod syntax;

pub use diag::Diagnostics;
#[cfg(feature = "disk")]
pub use session::run_file;
pub use session::{CompileOptions, RunReport, Session};
