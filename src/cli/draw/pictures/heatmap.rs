//! An archive as a map of its niches.

use crate::cli::Failure;
use crate::cli::draw::picture::{Drawing, Drawn, KindDescription, PictureKind, SubjectKind};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::wording;
use nbc_session::report::{self, ArchiveMap, EvolutionResults, axis_word};
use nbc_swarm::evolve::NicheKey;

pub(super) struct HeatmapPicture;

impl PictureKind for HeatmapPicture {
    fn description(&self) -> KindDescription {
        let options = &["--axes"];
        KindDescription { options, ..KindDescription::new("heatmap", "The archive of a run", SubjectKind::Run) }
    }

    fn of_run(&self, results: &EvolutionResults, request: &DrawRequest) -> Result<Drawn, Failure> {
        let [x, y] = axes(results, &request.axes)?;
        let best = results.best();
        let niches: Vec<(&NicheKey, f64)> = best.iter().map(|(key, (_, elite))| (*key, elite.fitness[0])).collect();
        let (unit, axes, stimuli) = (results.unit(), &results.axes, results.stimuli);
        let archive_map = ArchiveMap { unit, axes, stimuli, niches: &niches };
        let title = format!("{}: the best of each niche", results.name);
        Ok(Drawing::Picture(report::draw_heatmap(&title, &archive_map, x, y)).into())
    }
}

/// By default the first two.
fn axes(results: &EvolutionResults, requested: &[String]) -> Result<[usize; 2], Failure> {
    let axes: Vec<String> = results.axes.iter().map(|&axis| axis_word(axis).to_owned()).collect();
    if requested.is_empty() {
        return Ok([0, usize::from(axes.len() > 1)]);
    }
    let [x, y] = requested else {
        return Err(wording::axis_count(requested.len(), &axes).into());
    };
    let place =
        |word: &String| axes.iter().position(|known| known == word).ok_or_else(|| wording::unknown_axis(word, &axes));
    match [place(x)?, place(y)?] {
        [x, y] if x == y => Err(wording::same_axis(&axes[x], &axes).into()),
        places => Ok(places),
    }
}
