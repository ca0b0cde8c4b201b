//! Paths of files and folders that a command writes.

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use nbc_base::diag::is_hidden;

/// A path whose name can be read wherever it is shown.
pub(in crate::cli) fn new_path() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| {
        let is_visible = !path.to_string_lossy().contains(|c| c == '\n' || is_hidden(c));
        if is_visible { Ok(path) } else { Err("a name cannot have control characters") }
    })
}

/// A path that ends in `.svg` or `.png`.
pub(in crate::cli) fn picture_path() -> impl TypedValueParser<Value = PathBuf> {
    new_path().try_map(|path| {
        let is_picture = path.extension().is_some_and(|extension| extension == "svg" || extension == "png");
        if is_picture { Ok(path) } else { Err("expected a name that ends in .svg or .png") }
    })
}
