//! The tests and simulations of a file: their choice by name, and those that were run in physics.

mod complete_run;
mod names;
pub(super) mod wording;

pub(super) use complete_run::{CompleteRun, run_list, run_page};
pub(super) use names::{names_of_tests, unknown_run};
