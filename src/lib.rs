//! Circuits made of soft robots: a declarative language, a compiler to swarms of robots without a brain, and their
//! physics.
//!
//! A circuit with its tests, run in full physics:
//!
//! ```
//! nbc::run_file("circuits/half_adder.nb", &nbc::Options::default())?.assert_passed();
//! # Ok::<(), nbc::RunError>(())
//! ```
#![deny(missing_docs)]

pub mod check;
pub mod circuit;
pub mod cli;
pub mod diag;
pub mod evolve;
pub mod model;
pub mod pipeline;
pub mod report;
pub mod sim;
pub mod source;
pub mod store;
pub mod swarm;
pub mod syntax;

pub use pipeline::{Options, RunError, RunReport, run_file};
