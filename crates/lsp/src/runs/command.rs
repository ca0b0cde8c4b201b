//! The commands by their names.

pub(crate) const RUN: &str = "nbc.run";
pub(crate) const TEST: &str = "nbc.test";
pub(crate) const PROVE: &str = "nbc.prove";
pub(crate) const SCHEMATIC: &str = "nbc.schematic";
pub(crate) const TIMING: &str = "nbc.timing";

pub(crate) const COMMANDS: [&str; 5] = [RUN, TEST, PROVE, SCHEMATIC, TIMING];
