//! Plots of an evolution run, and the page with all of them.

use crate::cli::Failure;
use crate::cli::draw::evolution_run::each_champion;
use crate::cli::draw::picture::{Drawing, Drawn};
use crate::cli::draw::request::DrawRequest;
use crate::cli::draw::{spacetime, wording};
use nbc_base::diag::Diagnostic;
use nbc_base::model::SearchObjective;
use nbc_session::report::{self, ArchiveMap, EvolutionResults, PageFigure, Scheme, Svg};
use nbc_swarm::evolve::NicheKey;

pub(super) fn comparison(results: &EvolutionResults, _: &DrawRequest) -> Result<Drawn, Failure> {
    Ok(Drawing::Picture(draw_comparison(results)).into())
}

/// The champions of a run by group of behaviors.
fn draw_comparison(results: &EvolutionResults) -> Svg {
    let champions = results.runs.iter().map(|(&seed, run)| (seed, run.champions())).collect();
    let groups = report::behavior_groups(&champions);
    let title = format!("{}: champions by group of behaviors", results.name);
    report::draw_comparison(&title, results.unit(), &groups, &report::compare_groups(&groups))
}

pub(super) fn discovery(results: &EvolutionResults, _: &DrawRequest) -> Result<Drawn, Failure> {
    let last = results.runs.values().filter_map(|run| run.progress.last());
    let until = last.map(|line| line.generation).max().unwrap_or(1);
    let title = format!("{}: how soon each behavior was found", results.name);
    let svg = report::draw_discovery(&title, &results.discoveries(), results.runs.len(), until);
    Ok(Drawing::Picture(svg).into())
}

pub(super) fn progress(results: &EvolutionResults, _: &DrawRequest) -> Result<Drawn, Failure> {
    Ok(Drawing::Picture(draw_progress(results)).into())
}

/// Coverage, QD-score and champions over the generations.
fn draw_progress(results: &EvolutionResults) -> Svg {
    report::draw_progress(&format!("{} over time", results.name), "generation", &results.courses())
}

pub(super) fn heatmap(results: &EvolutionResults, request: &DrawRequest) -> Result<Drawn, Failure> {
    let [x, y] = axes(results, &request.axes)?;
    let best = results.best();
    let niches: Vec<(&NicheKey, f64)> = best.iter().map(|(key, (_, elite))| (*key, elite.fitness[0])).collect();
    let (unit, axes, stimuli) = (results.unit(), &results.axes, results.stimuli);
    let archive_map = ArchiveMap { unit, axes, stimuli, niches: &niches };
    let title = format!("{}: the best of each niche", results.name);
    Ok(Drawing::Picture(report::draw_heatmap(&title, &archive_map, x, y)).into())
}

/// By default the first two.
fn axes(results: &EvolutionResults, requested: &[String]) -> Result<[usize; 2], Failure> {
    let axes: Vec<String> = results.axes.iter().map(|axis| axis.word().to_owned()).collect();
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

pub(super) fn page(results: &EvolutionResults, request: &DrawRequest) -> Result<Drawn, Failure> {
    let (page, faults) = run_page(results, request.scheme());
    Ok(Drawn { drawing: Drawing::Text(page), faults })
}

/// The page of a run with all its plots, and warnings of robots that fail on their way through them.
pub(in crate::cli) fn run_page(results: &EvolutionResults, scheme: Scheme) -> (String, Vec<Diagnostic>) {
    let figure = |heading: &str, drawing| PageFigure { heading: heading.to_owned(), drawing };
    let (paths, faults) = spacetime::champions(&each_champion(results), &results.shown(10));
    let mut figures = vec![figure("Progress", draw_progress(results)), figure("Champions in space and time", paths)];
    if results.objective == SearchObjective::Distance && results.stimuli == 2 {
        figures.push(figure("Groups of behaviors", draw_comparison(results)));
    }
    (report::draw_evolution_page(results, &figures, scheme), faults)
}
