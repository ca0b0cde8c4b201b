//! The results of an evolution run: of one seed's folder, or of all seeds of a declaration.

use std::collections::BTreeMap;
use std::path::Path;

use crate::cli::draw::titled::{NamedBody, TitledBody, TitledRobots};
use crate::cli::draw::wording;
use crate::cli::evolution_folder::{PROGRESS, checkpoints, read_checkpoint, read_progress};
use crate::cli::evolve::wording::gaps_in_curves;
use crate::cli::{Context, Failure};
use nbc_base::model::{Behavior, Evolution};
use nbc_base::source::Sources;
use nbc_session::report::{EvolutionResults, History, SeedRun};

pub(in crate::cli) fn is_run(folder: &Path) -> bool {
    !checkpoints(folder).is_empty()
}

pub(in crate::cli) fn read(folder: &Path, context: &Context) -> Result<EvolutionResults, Failure> {
    let mut results: Option<EvolutionResults> = None;
    for path in checkpoints(folder) {
        let Some(checkpoint) = read_checkpoint(&path)? else { continue };
        let (seed, progress) = (checkpoint.state.seed, path.with_file_name(PROGRESS));
        let bytes = read_progress(&progress)?;
        let text = String::from_utf8_lossy(&bytes);
        let history = History::read(&text, checkpoint.state.generation);
        let damage = history.damage().map(|damage| gaps_in_curves(&progress, &damage));
        context.tell(&Vec::from_iter(damage), &Sources::default());
        let run = SeedRun { niches: checkpoint.state.niches, progress: history.lines().collect() };
        if checkpoint.declared.descriptors.is_empty() {
            return Err(wording::no_axes(&path).into());
        }
        let images = checkpoint.declared.images();
        let Evolution { name, descriptors: axes, objective, palette, .. } = checkpoint.declared;
        let stimuli = palette.inputs();
        let empty = EvolutionResults { name, axes: axes.clone(), stimuli, images, objective, runs: BTreeMap::new() };
        let results = results.get_or_insert(empty);
        if results.axes != axes || results.objective != objective || results.stimuli != stimuli {
            return Err(wording::other_declaration(&path).into());
        }
        if results.runs.insert(seed, run).is_some() {
            return Err(wording::same_seed(&path, seed).into());
        }
    }
    results.ok_or_else(|| wording::no_run_in_folder(folder).into())
}

pub(super) fn champion(results: &EvolutionResults, behavior: Behavior) -> Option<TitledBody> {
    let elite = results.champion(behavior)?;
    let title = format!("{}: {}, {behavior}", results.name, behavior.function());
    Some(TitledBody { title, body: elite.body.clone() })
}

pub(super) fn each_champion(results: &EvolutionResults) -> TitledRobots {
    let one = |behavior: Behavior| {
        results.runs.iter().filter_map(move |(seed, run)| {
            let body = run.champion(behavior)?.body.clone();
            Some(NamedBody { behavior, name: format!("seed {seed}"), body })
        })
    };
    let title = match results.runs.len() {
        1 => format!("{}: the champion of each behavior", results.name),
        seeds => format!("{}: the champions of {seeds} seeds by behavior", results.name),
    };
    TitledRobots { title, robots: results.behaviors().into_iter().flat_map(one).collect() }
}

pub(super) fn best_champions(results: &EvolutionResults) -> TitledRobots {
    let one = |behavior: Behavior| {
        let body = results.champion(behavior)?.body.clone();
        Some(NamedBody { behavior, name: behavior.function().to_string(), body })
    };
    let robots = results.behaviors().into_iter().filter_map(one).collect();
    TitledRobots { title: format!("{}: the champion of each behavior", results.name), robots }
}
