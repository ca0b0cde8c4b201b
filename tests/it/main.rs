//! Integration tests, in one binary.

mod benchmarks;
mod circuit;
mod cli;
mod declared;
mod determinism;
mod editor;
mod evolution;
mod examples;
mod faults;
mod films;
mod formatting;
mod hostile;
mod language;
mod library;
mod manual;
mod page;
mod physics;
mod pictures;
mod plots;
mod swarms;
mod synth;
mod testing;
mod tidy;
mod ui;
mod waves;
