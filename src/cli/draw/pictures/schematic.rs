//! The cells of a circuit with their robots.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_session::report::draw_schematic_page;

pub(super) struct SchematicPicture;

impl PictureKind for SchematicPicture {
    fn description(&self) -> KindDescription {
        let options = &["--safe-colors"];
        KindDescription {
            options,
            extensions: &["svg", "png", "html"],
            ..KindDescription::new("schematic", "The cells of a circuit with their robots", SubjectKind::Program)
        }
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawn, Failure> {
        let compiled = request.compiled()?;
        let schematic = compiled.schematic(request.scheme());
        let page = draw_schematic_page(&compiled.assembly, &schematic.pages());
        Ok(Drawing::Sheets { top: schematic.top(), page }.into())
    }
}
