//! What a measurement is to show. A program that misses an aim ends with status 1.

use std::fmt::Display;
use std::process::ExitCode;

/// The aims that were missed.
#[derive(Default)]
pub struct Aims {
    missed: usize,
}

impl Aims {
    /// Says whether an aim is met.
    pub fn check(&mut self, is_met: bool, aim: impl Display) {
        println!("{}: {aim}", if is_met { "met" } else { "missed" });
        self.missed += usize::from(!is_met);
    }

    /// The status of the program.
    pub fn end(self) -> ExitCode {
        if self.missed == 0 { ExitCode::SUCCESS } else { ExitCode::from(1) }
    }
}
