//! The commands by their names.

/// The commands.
pub(in crate::cli::lsp) const RUN: &str = "nbc.run";
pub(in crate::cli::lsp) const TEST: &str = "nbc.test";
pub(in crate::cli::lsp) const SCHEMATIC: &str = "nbc.schematic";
pub(in crate::cli::lsp) const TIMING: &str = "nbc.timing";

/// All commands.
pub(in crate::cli::lsp) const COMMANDS: [&str; 4] = [RUN, TEST, SCHEMATIC, TIMING];
