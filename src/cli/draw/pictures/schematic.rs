//! The cells of a circuit with their robots.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;

pub(super) struct SchematicPicture;

impl PictureKind for SchematicPicture {
    fn word(&self) -> &'static str {
        "schematic"
    }

    fn about(&self) -> &'static str {
        "The cells of a circuit with their robots"
    }

    fn options(&self) -> &'static [&'static str] {
        &["--safe-colors"]
    }

    fn subject(&self) -> SubjectKind {
        SubjectKind::Program
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Picture(request.compiled()?.schematic(request.scheme())))
    }
}
