//! What came of a test.

use std::fmt;

use serde::Serialize;

use crate::diag::Diagnostic;

/// What came of a test.
#[derive(Serialize)]
pub(super) struct Outcome {
    pub(super) file: String,
    pub(super) circuit: String,
    pub(super) title: String,
    /// How it was tested: `logic` or `physics`.
    pub(super) level: &'static str,
    pub(super) passed: bool,
    pub(super) rows: usize,
    /// What went wrong, as text.
    #[serde(skip)]
    pub(super) failures: String,
    /// What is legal and surely not meant.
    #[serde(skip)]
    pub(super) warnings: Vec<Diagnostic>,
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.passed { "pass" } else { "FAIL" };
        let title = if self.title.is_empty() { String::new() } else { format!(" \"{}\"", self.title) };
        writeln!(f, "{verdict}  {}{title} ({} rows, {})", self.circuit, self.rows, self.level)?;
        f.write_str(&self.failures)
    }
}
