//! Integration tests, in one binary.

mod cli;
mod films;
mod physics;
mod pictures;
mod tidy;
mod waves;
