//! The fitness of a run by group of behaviors.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_session::report::{self, EvolutionResults, Svg};

pub(super) struct ComparisonPicture;

impl PictureKind for ComparisonPicture {
    fn description(&self) -> KindDescription {
        KindDescription::new(
            "comparison",
            "The fitness of a run by group of behaviors, with statistics",
            SubjectKind::Run,
        )
    }

    fn of_run(&self, results: &EvolutionResults, _request: &DrawRequest) -> Result<Drawn, Failure> {
        Ok(Drawing::Picture(comparison(results)).into())
    }
}

pub(super) fn comparison(results: &EvolutionResults) -> Svg {
    let champions = results.runs.iter().map(|(&seed, run)| (seed, run.champions())).collect();
    let groups = report::behavior_groups(&champions);
    let title = format!("{}: champions by group of behaviors", results.name);
    report::draw_comparison(&title, results.unit(), &groups, &report::compare_groups(&groups))
}
