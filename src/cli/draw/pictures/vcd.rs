//! Waveforms.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_session::report;

pub(super) struct VcdPicture;

impl PictureKind for VcdPicture {
    fn word(&self) -> &'static str {
        "vcd"
    }

    fn about(&self) -> &'static str {
        "The waveforms of a swarm"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["vcd"]
    }

    fn subject(&self) -> SubjectKind {
        SubjectKind::Program
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Text(report::vcd(&request.ran(None)?.swarm().trace)))
    }
}
