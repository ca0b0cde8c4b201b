//! The cells of a circuit with their robots.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;

pub(super) struct SchematicPicture;

impl PictureKind for SchematicPicture {
    fn description(&self) -> KindDescription {
        let options = &["--safe-colors"];
        KindDescription {
            options,
            ..KindDescription::new("schematic", "The cells of a circuit with their robots", SubjectKind::Program)
        }
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Picture(request.compiled()?.schematic(request.scheme())))
    }
}
