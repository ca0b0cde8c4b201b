//! Integration tests, in one binary.

mod circuit;
mod cli;
mod determinism;
mod examples;
mod films;
mod language;
mod page;
mod physics;
mod pictures;
mod plots;
mod synth;
mod tidy;
mod waves;
