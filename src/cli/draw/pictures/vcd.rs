//! Waveforms.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_session::report;

pub(super) struct VcdPicture;

impl PictureKind for VcdPicture {
    fn description(&self) -> KindDescription {
        let extensions = &["vcd"];
        KindDescription { extensions, ..KindDescription::new("vcd", "The waveforms of a swarm", SubjectKind::Program) }
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Text(report::vcd(&request.ran(None)?.swarm().trace)))
    }
}
