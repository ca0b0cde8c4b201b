//! Archives and libraries as data for other programs: JSON with everything, or a table with a row for each elite or
//! robot.

use serde::Serialize;

use crate::report::csv::{cell, line};
use crate::report::evolution_results::{EvolutionResults, axis_word, bins};
use nbc_base::model::{Axis, Behavior, Body, Library, Material, MaterialKind, Pattern, Robot, SearchObjective};
use nbc_swarm::evolve::{Elite, NicheKey};

/// The archives of a declaration's runs.
#[derive(Clone, Debug, Serialize)]
pub struct Elites<'a> {
    run: &'a str,
    objective: SearchObjective,
    axes: Vec<AxisData>,
    elites: Vec<EliteData<'a>>,
}

/// An axis of an archive.
#[derive(Clone, Debug, Serialize)]
struct AxisData {
    name: &'static str,
    bins: usize,
}

/// An elite.
#[derive(Clone, Debug, Serialize)]
struct EliteData<'a> {
    seed: u64,
    /// The bin on each axis, from 0.
    niche: &'a [u16],
    behavior: Behavior,
    function: &'static str,
    fitness: [f64; 2],
    displacement: [f64; 4],
    #[serde(flatten)]
    body: BodyData<'a>,
    generation: u32,
    evaluations: u64,
}

/// A body with its counts of voxels.
#[derive(Clone, Debug, Serialize)]
struct BodyData<'a> {
    width: usize,
    height: usize,
    voxels: usize,
    actuators: usize,
    sensors: usize,
    body: Vec<String>,
    /// The materials of the codes from 1 on, unless they are the paper's.
    #[serde(skip_serializing_if = "Option::is_none")]
    materials: Option<&'a [Material]>,
}

impl<'a> BodyData<'a> {
    fn of(body: &'a Body) -> Self {
        let palette = body.palette();
        let count = |is: fn(MaterialKind) -> bool| {
            body.codes().iter().filter(|&&code| palette.kind(code).is_some_and(is)).count()
        };
        Self {
            width: body.width(),
            height: body.height(),
            voxels: count(|_| true),
            actuators: count(|kind| matches!(kind, MaterialKind::Actuator(_))),
            sensors: count(|kind| matches!(kind, MaterialKind::Sensor(_))),
            body: body.rows(),
            materials: (!palette.is_paper()).then(|| palette.materials()),
        }
    }

    const COLUMNS: [&'static str; 7] = ["width", "height", "voxels", "actuators", "sensors", "body", "materials"];

    fn cells(&self) -> [String; 7] {
        let materials =
            self.materials.map(|materials| serde_json::to_string(materials).expect("materials can be written as JSON"));
        let [width, height, voxels, actuators, sensors] =
            [self.width, self.height, self.voxels, self.actuators, self.sensors].map(|count| count.to_string());
        [width, height, voxels, actuators, sensors, self.body.join("|"), cell(&materials.unwrap_or_default())]
    }
}

impl<'a> Elites<'a> {
    /// All elites of some runs, seed by seed and niche by niche.
    pub fn of(results: &'a EvolutionResults) -> Self {
        let axis = |axis: &Axis| AxisData { name: axis_word(*axis), bins: bins(*axis) };
        let elites = results.runs.iter().flat_map(|(&seed, run)| {
            let niche = move |(key, elites): &'a (NicheKey, Vec<Elite>)| {
                elites.iter().map(move |elite| EliteData::of(seed, key, elite))
            };
            run.niches.iter().flat_map(niche)
        });
        Self {
            run: &results.name,
            objective: results.objective,
            axes: results.axes.iter().map(axis).collect(),
            elites: elites.collect(),
        }
    }

    /// The table of the elites.
    pub fn csv(&self) -> String {
        let own = ["run", "seed", "behavior", "function", "fitness_1", "fitness_2"].map(str::to_owned);
        let niche = self.axes.iter().enumerate().map(|(place, axis)| self.axis_column(place, axis));
        let head = own.into_iter().chain(niche).chain(displacement_columns());
        let head =
            head.chain(BodyData::COLUMNS.map(str::to_owned)).chain(["generation", "evaluations"].map(str::to_owned));
        let rows = self.elites.iter().map(|elite| line(elite.cells(self.run)));
        std::iter::once(line(head)).chain(rows).collect()
    }

    /// The column of an axis; a word that several axes have gets their places.
    fn axis_column(&self, place: usize, axis: &AxisData) -> String {
        let alone = self.axes.iter().filter(|other| other.name == axis.name).count() == 1;
        if alone { format!("niche_{}", axis.name) } else { format!("niche_{}_{}", axis.name, place + 1) }
    }
}

impl<'a> EliteData<'a> {
    fn of(seed: u64, key: &'a NicheKey, elite: &'a Elite) -> Self {
        Self {
            seed,
            niche: &key.0,
            behavior: elite.behavior,
            function: elite.behavior.function().name(),
            fitness: elite.fitness,
            displacement: elite.displacement,
            body: BodyData::of(&elite.body),
            generation: elite.generation,
            evaluations: elite.evaluations,
        }
    }

    fn cells(&self, run: &str) -> Vec<String> {
        let mut cells = vec![cell(run), self.seed.to_string(), self.behavior.to_string(), self.function.to_owned()];
        cells.extend(self.fitness.map(|value| value.to_string()));
        cells.extend(self.niche.iter().map(|bin| bin.to_string()));
        cells.extend(self.displacement.map(|value| value.to_string()));
        cells.extend(self.body.cells());
        cells.extend([self.generation.to_string(), self.evaluations.to_string()]);
        cells
    }
}

/// The table of a library's robots.
pub fn robots_csv(library: &Library) -> String {
    const CHARACTER: [&str; 6] = ["clock", "switches", "error_rate", "glitch_rate", "margin", "topples"];
    const RADIUS: [&str; 3] = ["radius", "radius_vary", "radius_error_rate"];
    const PROVENANCE: [&str; 6] = ["program", "version", "evolution", "seed", "generation", "evaluations"];
    let own = ["name", "behavior", "function"].map(str::to_owned);
    let head = own
        .into_iter()
        .chain(CHARACTER.map(str::to_owned))
        .chain(switches().map(|(from, to)| format!("settle_{from}_{to}")))
        .chain(RADIUS.map(str::to_owned));
    let head = head.chain(displacement_columns()).chain(BodyData::COLUMNS.map(str::to_owned));
    let head = line(head.chain(PROVENANCE.map(str::to_owned)));
    std::iter::once(head).chain(library.robots.iter().map(|robot| line(robot_cells(robot)))).collect()
}

fn robot_cells(robot: &Robot) -> Vec<String> {
    let (character, provenance) = (&robot.character, &robot.provenance);
    let mut cells = vec![cell(&robot.name), robot.behavior.to_string(), robot.function().name().to_owned()];
    cells.extend([character.clock.to_string(), character.switches.to_string()]);
    cells.extend([character.error_rate, character.glitch_rate, character.margin].map(|value| value.to_string()));
    cells.push(character.topples.to_string());
    cells.extend(switches().map(|(from, to)| {
        let same = character.settle.iter().find(|transition| (transition.from, transition.to) == (from, to));
        same.map_or(String::new(), |transition| transition.cycles.to_string())
    }));
    let radius = character.radius.as_ref();
    cells.push(radius.map_or(String::new(), |found| found.radius.to_string()));
    cells.push(radius.map_or(String::new(), |found| cell(&found.vary.replace(',', " "))));
    cells.push(radius.and_then(|found| found.error_rate).map_or(String::new(), |rate| rate.to_string()));
    cells.extend(robot.displacement.map(|value| value.to_string()));
    cells.extend(BodyData::of(&robot.body).cells());
    cells.extend([&provenance.program, &provenance.version, &provenance.evolution].map(|text| cell(text)));
    cells.extend([provenance.seed, u64::from(provenance.generation), provenance.evaluations].map(|n| n.to_string()));
    cells
}

/// The twelve switches between different patterns.
fn switches() -> impl Iterator<Item = (Pattern, Pattern)> {
    let pairs = Pattern::PAIRS.into_iter().flat_map(|from| Pattern::PAIRS.map(|to| (from, to)));
    pairs.filter(|(from, to)| from != to)
}

fn displacement_columns() -> impl Iterator<Item = String> {
    Pattern::PAIRS.into_iter().map(|pattern| format!("displacement_{pattern}"))
}
