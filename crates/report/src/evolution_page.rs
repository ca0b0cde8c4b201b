//! The report of evolution runs as one self-contained HTML page: the verdict, the archive, whose niches open their
//! elites and play their gaits, and the plots.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use serde::Serialize;

use crate::chart::range_of;
use crate::color::Scheme;
use crate::evolution_results::{ArchiveAxis, EvolutionResults};
use crate::export::EliteData;
use crate::heatmap::{heat, share};
use crate::html::{Html, controls, escape, page_json, picture};
use crate::listing::walked;
use crate::looks::Looks;
use crate::page_bodies::{RecordedBody, VoxelLook, materials, voxel_looks};
use crate::stage::Stage;
use crate::svg::Svg;
use nbc_base::diag::counted;
use nbc_base::model::{Axis, Behavior, Body, CYCLE_STEPS, Image, Schedule, Setting, Spell};
use nbc_swarm::evolve::{Elite, NicheKey};
use nbc_swarm::{Recorded, Room};

const SCRIPT: &str = include_str!("../page/evolution.js");
const GAIT_CYCLES: u32 = 2;

pub struct PageFigure {
    pub heading: String,
    pub drawing: Svg,
}

struct Entry<'a> {
    key: &'a NicheKey,
    seed: u64,
    elite: &'a Elite,
}

/// The gaits are simulated here.
pub fn draw_evolution_page(results: &EvolutionResults, figures: &[PageFigure], scheme: Scheme) -> String {
    let entries = ranked(results);
    let looks = Looks::of(entries.iter().map(|entry| &entry.elite.body), scheme);
    let (pace, gaits) = record(&entries, &results.shown(GAIT_CYCLES));
    let left_out = entries.len() - gaits.len();
    let behaviors = results.behaviors().len();
    Html {
        heading: &results.name,
        passed: behaviors > 0,
        verdict: verdict(results, behaviors, entries.len()),
        body: archive(results, left_out) + &figures.iter().map(figure).collect::<String>(),
        script: Some((SCRIPT, page_json(&EvolutionData::of(results, &entries, &gaits, pace, &looks)))),
    }
    .finish()
}

fn verdict(results: &EvolutionResults, behaviors: usize, filled: usize) -> String {
    let seeds: Vec<u64> = results.runs.keys().copied().collect();
    let runs = match seeds[..] {
        [seed] => format!("seed {seed}"),
        _ => format!("{} seeds together", seeds.len()),
    };
    let niches = results.niche_count();
    format!(
        "{behaviors} of {} behaviors in {filled} of {niches} niches ({:.1} %), {runs}",
        Behavior::all(results.stimuli).count(),
        100.0 * filled as f64 / niches.max(1) as f64
    )
}

/// The best elite of each niche: first the best of every behavior, then the second best; behaviors that depend on more
/// stimuli first.
fn ranked(results: &EvolutionResults) -> Vec<Entry<'_>> {
    let mut of_behavior: BTreeMap<Behavior, Vec<Entry<'_>>> = BTreeMap::new();
    for (key, (seed, elite)) in results.best() {
        of_behavior.entry(elite.behavior).or_default().push(Entry { key, seed, elite });
    }
    let mut ranked = Vec::new();
    for (behavior, mut entries) in of_behavior {
        entries.sort_by(|a, b| b.elite.fitness[0].total_cmp(&a.elite.fitness[0]));
        let arity = Reverse(behavior.function().arity());
        ranked.extend(entries.into_iter().enumerate().map(|(rank, entry)| ((rank, arity, Reverse(behavior)), entry)));
    }
    ranked.sort_by_key(|(rank, _)| *rank);
    ranked.into_iter().map(|(_, entry)| entry).collect()
}

/// Frames per cycle, and the gaits of the first elites, as many as fit.
fn record(entries: &[Entry<'_>], schedule: &Schedule) -> (u32, Vec<Recorded>) {
    let bodies: Vec<Body> = entries.iter().map(|entry| entry.elite.body.clone()).collect();
    let setting = Setting::default();
    let probe = Stage::of_trials(&setting, &bodies, schedule, CYCLE_STEPS);
    let points: Vec<usize> = (0..bodies.len()).map(|i| probe.points(i)).collect();
    let (stride, count) = Room::GAITS.fit(&points, GAIT_CYCLES as usize * schedule.spells.len());
    let recording = Stage::of_trials(&setting, &bodies[..count], schedule, stride).record(count);
    (recording.frames_per_cycle, recording.robots)
}

fn archive(results: &EvolutionResults, left_out: usize) -> String {
    let counts: Vec<usize> =
        (0..results.axes.len()).filter(|&i| matches!(results.axes[i], Axis::Count { .. })).collect();
    let choice = |label: &str, place: usize| {
        let option = |&i: &usize| {
            let chosen = if counts.get(place.min(counts.len() - 1)) == Some(&i) { " selected" } else { "" };
            format!("<option value=\"{i}\"{chosen}>{}</option>", results.axes[i].word())
        };
        let options: String = counts.iter().map(option).collect();
        format!("<label>{label} <select class=\"axis\">{options}</select></label>")
    };
    let axes = if counts.is_empty() { String::new() } else { choice("across", 0) + &choice("upwards", 1) };
    let missing = match left_out {
        0 => String::new(),
        _ => {
            let elites = counted(left_out, "elite");
            format!("<p class=\"dim\">The page is full, so it has no gait of {elites}.</p>\n")
        }
    };
    format!(
        "<section id=\"archive\">\n<h2>Archive</h2>\n<p>Each square is a niche, colored by the best {unit} found \
         there. \
         Choose one to see its elite walk; the arrow keys go from niche to niche.</p>\n\
         <div class=\"controls\">{axes}<span class=\"key\">{low} <i \
         style=\"background:linear-gradient(90deg,{colors})\"></i> {high}</span></div>\n\
         <div class=\"beside\"><div class=\"maps\"></div>\n<div class=\"elite\"><div class=\"robot\" \
         aria-live=\"polite\"></div>\n\
         <p class=\"missing dim\" hidden>There was no room for the gait of this elite.</p>\n\
         <div class=\"player\">{controls}<canvas class=\"stage\" role=\"img\" aria-label=\"the elite \
         walking\"></canvas></div></div></div>\n\
         {missing}</section>\n",
        unit = escape(results.unit()),
        low = number(range(results).0),
        high = number(range(results).1),
        colors = (0..=8).map(|i| heat(f64::from(i) / 8.0).to_string()).collect::<Vec<_>>().join(","),
        controls = controls("1"),
    )
}

fn range(results: &EvolutionResults) -> (f64, f64) {
    range_of(results.best().values().map(|(_, elite)| elite.fitness[0]), 0.0)
}

fn number(value: f64) -> String {
    format!("{value:.2}")
}

fn figure(figure: &PageFigure) -> String {
    let heading = escape(&figure.heading);
    format!("<section>\n<h2>{heading}</h2>\n{}</section>\n", picture(&figure.drawing, &figure.heading))
}

#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EvolutionData {
    looks: Vec<VoxelLook>,
    /// What is shown of each image: rows from the top, 1 is black.
    images: Vec<Vec<Vec<f64>>>,
    /// The patterns, or as many as there are images.
    patterns: Vec<String>,
    /// Cycles under each of them.
    cycles: u32,
    /// Frames in a cycle.
    pace: u32,
    axes: Vec<ArchiveAxis>,
    behaviors: Vec<PageBehavior>,
    elites: Vec<PageElite>,
}

#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct PageBehavior {
    word: String,
    function: &'static str,
}

/// The best of a niche; there may have been no room for its gait.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct PageElite {
    #[serde(flatten)]
    elite: EliteData,
    color: String,
    about: Vec<[String; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gait: Option<RecordedBody>,
}

impl EvolutionData {
    fn of(results: &EvolutionResults, entries: &[Entry<'_>], gaits: &[Recorded], pace: u32, looks: &Looks) -> Self {
        let range = range(results);
        let elite = |(at, entry): (usize, &Entry<'_>)| {
            let color = heat(share(range, entry.elite.fitness[0])).to_string();
            let gait = gaits.get(at).map(|gait| RecordedBody::of(gait, &entry.elite.body, looks));
            PageElite::of(results, entry, gait, color)
        };
        let found = results.behaviors();
        // Of the 256 behaviors of three stimuli, only those that were found have a map.
        let shown = Behavior::all(results.stimuli).filter(|one| results.stimuli == 2 || found.contains(one));
        let digits = |spell: &Spell| spell.pattern.digits(results.stimuli);
        Self {
            looks: voxel_looks(looks),
            images: results.images.iter().map(|image| Vec::from(Image::clone(image))).collect(),
            patterns: results.shown(GAIT_CYCLES).spells.iter().map(digits).collect(),
            cycles: GAIT_CYCLES,
            pace,
            axes: results.named_axes(),
            behaviors: shown
                .map(|one| PageBehavior { word: one.to_string(), function: one.function().name() })
                .collect(),
            elites: entries.iter().enumerate().map(elite).collect(),
        }
    }
}

impl PageElite {
    fn of(results: &EvolutionResults, entry: &Entry<'_>, gait: Option<RecordedBody>, color: String) -> Self {
        let Entry { key, seed, elite } = entry;
        let counted = results.axes.iter().zip(&key.0).filter(|(axis, _)| matches!(axis, Axis::Count { .. }));
        let place: Vec<String> = counted
            .map(|(axis, bin)| format!("{} {} of {}", axis.word(), bin + 1, axis.bins(results.stimuli)))
            .collect();
        let about = [
            ("fitness", format!("{}, {}", number(elite.fitness[0]), results.unit())),
            ("bins", place.join(", ")),
            ("second", format!("{:.3}", elite.fitness[1])),
            ("displacement", format!("{} voxels", walked(&elite.displacement))),
            ("body", elite.body.rows().join(" ")),
            ("materials", materials(&elite.body)),
            ("born", format!("seed {seed}, generation {}", elite.generation)),
        ];
        Self {
            elite: EliteData::of(*seed, key, elite),
            color,
            about: about.map(|(word, text)| [word.to_owned(), text]).into(),
            gait,
        }
    }
}
