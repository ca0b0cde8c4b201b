//! Integration tests, in one binary.

mod cli;
mod determinism;
mod films;
mod page;
mod language;
mod physics;
mod pictures;
mod tidy;
mod waves;
