//! A netlist for Graphviz.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_circuit::formats::dot;

pub(super) struct DotPicture;

impl PictureKind for DotPicture {
    fn word(&self) -> &'static str {
        "dot"
    }

    fn about(&self) -> &'static str {
        "The cells of a circuit, for Graphviz"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["dot", "gv"]
    }

    fn subject(&self) -> SubjectKind {
        SubjectKind::Program
    }

    fn of_program(&self, request: &DrawRequest) -> Result<Drawing, Failure> {
        Ok(Drawing::Text(dot::write(&request.compiled()?.mapping.netlist)))
    }
}
