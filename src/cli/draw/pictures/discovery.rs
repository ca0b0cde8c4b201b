//! How soon a run found each behavior.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use nbc_session::report::{self, EvolutionResults, Svg};

pub(super) struct DiscoveryPicture;

impl PictureKind for DiscoveryPicture {
    fn description(&self) -> KindDescription {
        KindDescription::new(
            "discovery",
            "The generation in which each seed of a run first found each behavior",
            SubjectKind::Run,
        )
    }

    fn of_run(&self, results: &EvolutionResults, _request: &DrawRequest) -> Result<Drawn, Failure> {
        Ok(Drawing::Picture(discovery(results)).into())
    }
}

fn discovery(results: &EvolutionResults) -> Svg {
    let last = results.runs.values().filter_map(|run| run.progress.last());
    let until = last.map(|line| line.generation).max().unwrap_or(1);
    let title = format!("{}: how soon each behavior was found", results.name);
    report::draw_discovery(&title, &results.discoveries(), results.runs.len(), until)
}
