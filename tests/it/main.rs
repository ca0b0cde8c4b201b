//! Integration tests, in one binary.

mod abc;
mod adding;
mod benchmarks;
mod broken_circuits;
mod circuit;
mod cli;
#[cfg(feature = "cluster")]
mod cluster;
mod declared;
mod designs;
mod determinism;
mod drawing;
mod editor;
mod evolution;
mod examples;
mod exchange;
mod exporting;
mod faults;
mod films;
mod first_steps;
mod flows;
mod formatting;
mod gallery;
#[cfg(feature = "gpu")]
mod gpu;
mod hostile;
mod language;
mod library;
mod limits;
mod live;
mod long_program;
mod lsp;
mod manual;
mod memory;
mod modules;
mod notices;
mod optima;
mod page;
mod palette;
mod phases;
mod physics;
mod pictures;
#[cfg(feature = "play")]
mod play;
mod plots;
mod pulsed;
mod python;
mod reachable;
mod redundant;
mod results;
mod runs;
mod schemas;
mod settling;
#[cfg(target_os = "linux")]
mod slow_yosys;
mod swarms;
mod synth;
mod terminal;
mod testing;
mod tidy;
mod tools;
mod ui;
mod using;
mod waves;
mod worlds;
mod written;
