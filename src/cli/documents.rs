//! What several commands print with `--format json`.

use serde::Serialize;

use nbc_base::diag::Finding;

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct DiagnosticList {
    pub diagnostics: Vec<Finding>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct RobotList<T> {
    pub robots: Vec<T>,
}

/// A signal ended the work early.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Interrupted {
    /// The number of tests that were stopped or not begun.
    pub left: usize,
}
