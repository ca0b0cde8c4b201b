//! Integration tests, in one binary.

mod cli;
mod physics;
mod pictures;
mod tidy;
mod waves;
