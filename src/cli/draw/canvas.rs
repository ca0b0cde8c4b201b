//! The file of a picture; its extension selects the format.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::cli::draw::kind::Kind;
use crate::cli::wording::DrawError;
use crate::cli::{Failure, Progress};
use crate::report::{self, Film, Stage, Svg};
use crate::store;

/// The file to be written.
pub(super) struct Canvas {
    path: PathBuf,
    extension: String,
    kind: Kind,
}

impl Canvas {
    /// The file, if its name fits the kind of picture.
    pub(super) fn new(path: &Path, kind: Kind) -> Result<Self, DrawError> {
        let extension = path.extension().map(|text| text.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        if kind.extensions().contains(&extension.as_str()) {
            return Ok(Self { path: path.to_owned(), extension, kind });
        }
        let expected = kind.extensions().iter().map(|extension| format!("`.{extension}`")).collect();
        Err(DrawError::Extension { path: path.display().to_string(), expected, kind: kind.word() })
    }

    pub(super) fn picture(&self, svg: &Svg) -> Result<(), Failure> {
        let bytes = if self.extension == "svg" { svg.finish().into_bytes() } else { report::png(svg) };
        self.bytes(&bytes)
    }

    pub(super) fn bytes(&self, bytes: &[u8]) -> Result<(), Failure> {
        store::write(&self.path, bytes).map_err(|error| Failure::unwritable(&self.path, &error))
    }

    pub(super) fn film(&self, film: &Film, stage: Stage) -> Result<(), Failure> {
        let bar = Progress::new("drawing", stage.moments() as u64);
        let mut observe = |done| bar.set(done as u64);
        let write = |out: &mut dyn Write| match self.kind {
            Kind::Apng => report::write_apng(film, stage, out, &mut observe),
            _ => report::write_gif(film, stage, out, &mut observe),
        };
        store::write_with(&self.path, write).map_err(|error| Failure::unwritable(&self.path, &error))
    }
}
