//! Paths as text: those of source files, which other files and messages repeat, and those in results.

use std::path::{MAIN_SEPARATOR, Path};

use crate::cli::wording::UsageError;

/// The path of a source file as text.
pub(super) fn source_path(path: &Path) -> Result<&str, UsageError> {
    path.to_str().ok_or_else(|| UsageError::NotText { name: path.display().to_string() })
}

/// The path of a file in results for programs, which is the same text on every system.
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
