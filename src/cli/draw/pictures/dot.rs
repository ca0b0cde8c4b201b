//! A netlist for Graphviz.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_circuit::formats::dot;

pub(super) struct DotPicture;

impl PictureKind for DotPicture {
    fn description(&self) -> KindDescription {
        let extensions = &["dot", "gv"];
        KindDescription {
            extensions,
            ..KindDescription::new("dot", "The cells of a circuit, for Graphviz", SubjectKind::Program)
        }
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawn, Failure> {
        Ok(Drawing::Text(dot::write(&request.compiled()?.mapping.netlist)).into())
    }
}
