//! The file that a picture is written to. Its extension selects the format.

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::cli::draw::picture::{Drawing, FilmFormat, PictureKind};
use crate::cli::draw::wording;
use crate::cli::{Failure, Progress};
use nbc_session::report::{self, Film, Stage};
use nbc_session::store;

pub(super) struct Canvas {
    path: PathBuf,
    extension: String,
}

impl Canvas {
    pub(super) fn new(path: &Path, kind: &PictureKind) -> Result<Self, Failure> {
        let extension = path.extension().map(|text| text.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let PictureKind { word, extensions, .. } = kind;
        if extensions.contains(&extension.as_str()) {
            return Ok(Self { path: path.to_owned(), extension });
        }
        let expected: Vec<String> = extensions.iter().map(|extension| format!("`.{extension}`")).collect();
        Err(wording::extension(path, &expected, word).into())
    }

    pub(super) fn write(&self, drawing: Drawing) -> Result<(), Failure> {
        match drawing {
            Drawing::Picture(svg) if self.extension == "svg" => self.bytes(svg.finish().as_bytes()),
            Drawing::Sheets { page, .. } if self.extension == "html" => self.bytes(page.as_bytes()),
            Drawing::Sheets { top, .. } => self.write(Drawing::Picture(top)),
            Drawing::Picture(svg) => self.bytes(&report::png(&svg)),
            Drawing::Text(text) => self.bytes(text.as_bytes()),
            Drawing::Film { format, film, stage } => self.film(format, &film, *stage),
        }
    }

    fn bytes(&self, bytes: &[u8]) -> Result<(), Failure> {
        store::write(&self.path, bytes).map_err(|error| Failure::unwritable(&self.path, &error))
    }

    fn film(&self, format: FilmFormat, film: &Film, stage: Stage) -> Result<(), Failure> {
        let bar = Progress::new("drawing", stage.moments() as u64);
        let mut observe = |done| bar.set(done as u64);
        let write = |out: &mut dyn Write| match format {
            FilmFormat::Apng => report::write_apng(film, stage, out, &mut observe),
            FilmFormat::Gif => report::write_gif(film, stage, out, &mut observe),
        };
        store::write_with(&self.path, write).map_err(|error| Failure::unwritable(&self.path, &error))
    }
}
