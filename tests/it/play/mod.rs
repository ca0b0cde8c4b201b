//! `nbc play`: the server, by a page of the tests' own. The tests of `web/` do the same in a browser.

mod attacks;
mod class;
mod export;
mod lessons;
mod outside;
mod page;
mod robots;
mod safety;
mod swarm;
#[cfg(target_os = "linux")]
mod verilog;

const LATCH: &str = include_str!("../../../circuits/latch.nb");
