//! Pictures of an evolution run: of one seed's folder, or of all seeds of a declaration.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::draw::arguments::DrawArguments;
use crate::cli::draw::canvas::Canvas;
use crate::cli::draw::kind::Kind;
use crate::cli::draw::robot::Subject;
use crate::cli::draw::several::{One, Several, champions};
use crate::cli::run_folder::{CHECKPOINT, PROGRESS, read_checkpoint, read_progress};
use crate::cli::wording::{DrawError, RunWarning};
use crate::cli::{Context, Failure};
use crate::evolve::NicheKey;
use crate::model::{Behavior, CYCLE_STEPS, Pattern, Schedule, SearchObjective, Spell};
use crate::report::{self, EvolutionResults, History, Plate, Scheme, SeedRun, Svg, Terrain, axis_word};
use crate::source::Sources;
use crate::store::Declared;

/// Whether a folder is that of a run: of one seed, or of several.
pub(in crate::cli) fn is_run(folder: &Path) -> bool {
    !seeds(folder).is_empty()
}

/// The checkpoints of a run, in order of their seeds.
fn seeds(folder: &Path) -> Vec<PathBuf> {
    let own = folder.join(CHECKPOINT);
    if own.is_file() {
        return vec![own];
    }
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let number = |path: &Path| path.file_name()?.to_str()?.strip_prefix("seed-")?.parse::<u64>().ok();
    let mut seeds: Vec<(u64, PathBuf)> = entries
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            Some((number(&path)?, path.join(CHECKPOINT)))
        })
        .filter(|(_, checkpoint)| checkpoint.is_file())
        .collect();
    seeds.sort();
    seeds.into_iter().map(|(_, checkpoint)| checkpoint).collect()
}

/// The results of the runs in a folder.
pub(in crate::cli) fn read(folder: &Path, context: &Context) -> Result<EvolutionResults, Failure> {
    let mut results: Option<EvolutionResults> = None;
    for path in seeds(folder) {
        let Some(checkpoint) = read_checkpoint(&path)? else { continue };
        let (seed, progress) = (checkpoint.state.seed, path.with_file_name(PROGRESS));
        let bytes = read_progress(&progress)?;
        let text = String::from_utf8_lossy(&bytes);
        let history = History::read(&text, checkpoint.state.generation);
        let damage = history.damage().map(|damage| {
            let path = progress.display().to_string();
            RunWarning::GapsInCurves { path, damage }.into()
        });
        context.tell(&Vec::from_iter(damage), &Sources::default());
        let run = SeedRun { niches: checkpoint.state.niches, progress: history.lines().collect() };
        let place = path.display().to_string();
        if checkpoint.declared.axes.is_empty() {
            return Err(DrawError::NoAxes { path: place }.into());
        }
        let Declared { name, axes, objective, .. } = checkpoint.declared;
        let results =
            results.get_or_insert(EvolutionResults { name, axes: axes.clone(), objective, runs: BTreeMap::new() });
        if results.axes != axes || results.objective != objective {
            return Err(DrawError::OtherDeclaration { path: place }.into());
        }
        if results.runs.insert(seed, run).is_some() {
            return Err(DrawError::SameSeed { path: place, seed }.into());
        }
    }
    results.ok_or_else(|| DrawError::NoRunInFolder { folder: folder.display().to_string() }.into())
}

impl DrawArguments {
    pub(super) fn draw_run(&self, canvas: &Canvas, results: &EvolutionResults) -> Result<(), Failure> {
        match self.kind {
            Kind::Comparison => canvas.picture(&comparison(results)),
            Kind::Heatmap => {
                let [x, y] = self.chosen_axes(results)?;
                canvas.picture(&heatmap(results, x, y))
            }
            Kind::Progress => canvas.picture(&progress(results)),
            Kind::Report => canvas.bytes(page(results, self.scheme()).as_bytes()),
            Kind::Spacetime => canvas.picture(&champions(&each_champion(results), &self.schedule()?)),
            Kind::Apng | Kind::Gif | Kind::Sprite => self.draw_several(canvas, &best_champions(results)),
            Kind::Pose | Kind::Strip => Err(self.not_of("a run", "one `--behavior` of it")),
            Kind::Dot | Kind::Schematic | Kind::Vcd => Err(self.not_of("a run", "a source file (.nb)")),
        }
    }

    /// The best robot of a behavior.
    pub(super) fn champion(&self, results: &EvolutionResults, behavior: Behavior) -> Result<Subject, Failure> {
        let elite = results.champion(behavior).ok_or_else(|| self.none_of(behavior))?;
        let title = format!("{}: {}, {behavior}", results.name, behavior.function());
        Ok(Subject { title, body: elite.body.clone() })
    }

    /// The indices of the two requested axes; by default the first two.
    fn chosen_axes(&self, results: &EvolutionResults) -> Result<[usize; 2], Failure> {
        let axes: Vec<String> = results.axes.iter().map(|&axis| axis_word(axis).to_owned()).collect();
        if self.axes.is_empty() {
            return Ok([0, usize::from(axes.len() > 1)]);
        }
        let [x, y] = &self.axes[..] else {
            return Err(DrawError::AxisCount { found: self.axes.len(), axes }.into());
        };
        let place = |word: &String| {
            let unknown = || DrawError::UnknownAxis { name: word.clone(), axes: axes.clone() };
            axes.iter().position(|known| known == word).ok_or_else(unknown)
        };
        match [place(x)?, place(y)?] {
            [x, y] if x == y => Err(DrawError::SameAxis { name: axes[x].clone(), axes }.into()),
            places => Ok(places),
        }
    }
}

/// The champions of every seed, by behavior.
fn each_champion(results: &EvolutionResults) -> Several {
    let one = |behavior: Behavior| {
        results.runs.iter().filter_map(move |(seed, run)| {
            let body = run.champion(behavior)?.body.clone();
            Some(One { behavior, name: format!("seed {seed}"), body })
        })
    };
    let title = match results.runs.len() {
        1 => format!("{}: the champion of each behavior", results.name),
        seeds => format!("{}: the champions of {seeds} seeds by behavior", results.name),
    };
    Several { title, robots: Behavior::all().flat_map(one).collect() }
}

/// The best of each behavior over all seeds.
fn best_champions(results: &EvolutionResults) -> Several {
    let one = |behavior: Behavior| {
        let body = results.champion(behavior)?.body.clone();
        Some(One { behavior, name: behavior.function().to_string(), body })
    };
    let robots = Behavior::all().filter_map(one).collect();
    Several { title: format!("{}: the champion of each behavior", results.name), robots }
}

fn heatmap(results: &EvolutionResults, x: usize, y: usize) -> Svg {
    let best = results.best();
    let niches: Vec<(&NicheKey, f64)> = best.iter().map(|(key, (_, elite))| (*key, elite.fitness[0])).collect();
    let terrain = Terrain { unit: results.unit(), axes: &results.axes, niches: &niches };
    report::draw_heatmap(&format!("{}: the best of each niche", results.name), &terrain, x, y)
}

fn progress(results: &EvolutionResults) -> Svg {
    report::draw_progress(&format!("{} over time", results.name), "generation", &results.courses())
}

fn comparison(results: &EvolutionResults) -> Svg {
    let champions = results.runs.iter().map(|(&seed, run)| (seed, run.champions())).collect();
    let groups = report::behavior_groups(&champions);
    let title = format!("{}: champions by group of behaviors", results.name);
    report::draw_comparison(&title, results.unit(), &groups, &report::compare_groups(&groups))
}

/// The page of a run with all its plots.
pub(in crate::cli) fn page(results: &EvolutionResults, scheme: Scheme) -> String {
    let spell = |pattern| Spell { pattern, steps: 10 * CYCLE_STEPS };
    let schedule = Schedule { spells: Pattern::PAIRS.map(spell).to_vec() };
    let plate = |heading: &str, drawing| Plate { heading: heading.to_owned(), drawing };
    let mut plates = vec![
        plate("Progress", progress(results)),
        plate("Champions in space and time", champions(&each_champion(results), &schedule)),
    ];
    if results.objective == SearchObjective::Distance {
        plates.push(plate("Groups of behaviors", comparison(results)));
    }
    report::draw_evolution_page(results, &plates, scheme)
}
