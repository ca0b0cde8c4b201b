//! Waveforms.

use crate::cli::Failure;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_session::report;

pub(super) struct VcdPicture;

impl PictureKind for VcdPicture {
    fn description(&self) -> KindDescription {
        let extensions = &["vcd"];
        KindDescription { extensions, ..KindDescription::new("vcd", "The waveforms of a swarm", SubjectKind::Program) }
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawn, Failure> {
        let ran = request.ran(None)?;
        let trace = &ran.swarm().trace;
        Ok(Drawn { drawing: Drawing::Text(report::vcd(trace)), faults: faults::of_swarm(trace) })
    }
}
