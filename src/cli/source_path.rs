//! Paths as text: those of source files, which other files and messages repeat, and those in results.

use std::path::{MAIN_SEPARATOR, Path};

use crate::cli::wording;
use nbc_base::diag::Diagnostic;

pub(super) fn source_path(path: &Path) -> Result<&str, Diagnostic> {
    path.to_str().ok_or_else(|| wording::not_text(path.display()))
}

/// The same text on every system.
pub(super) fn result_path(path: &Path) -> String {
    with_slashes(&path.display().to_string(), MAIN_SEPARATOR)
}

fn with_slashes(path: &str, separator: char) -> String {
    path.replace(separator, "/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_have_slashes_between_folders_on_every_system() {
        assert_eq!(with_slashes(r"out\latch\d-waves.vcd", '\\'), "out/latch/d-waves.vcd");
        assert_eq!(result_path(&Path::new("out").join("a.svg")), "out/a.svg");
    }
}
