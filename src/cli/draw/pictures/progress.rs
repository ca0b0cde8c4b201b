//! The curves of a run.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_session::report::{self, EvolutionResults, Svg};

pub(super) struct ProgressPicture;

impl PictureKind for ProgressPicture {
    fn description(&self) -> KindDescription {
        KindDescription::new(
            "progress",
            "The coverage, QD-score and champions of a run over its generations",
            SubjectKind::Run,
        )
    }

    fn of_run(&self, results: &EvolutionResults, _request: &DrawRequest) -> Result<Drawn, Failure> {
        Ok(Drawing::Picture(progress(results)).into())
    }
}

pub(super) fn progress(results: &EvolutionResults) -> Svg {
    report::draw_progress(&format!("{} over time", results.name), "generation", &results.courses())
}
