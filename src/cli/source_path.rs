//! Paths of source files, which other files and messages repeat as text.

use std::path::Path;

use crate::cli::wording::UsageError;

/// The path of a source file as text.
///
/// # Errors
/// When it is not UTF-8: as text it would be the path of another file.
pub(super) fn source_path(path: &Path) -> Result<&str, UsageError> {
    path.to_str().ok_or_else(|| UsageError::NotText { name: path.display().to_string() })
}
