//! Archives and libraries as data for other programs: JSON with everything, or a table with a row for each elite or
//! robot.

use std::sync::Arc;

use serde::Serialize;

use crate::csv::{cell, line};
use crate::evolution_results::{ArchiveAxis, EvolutionResults};
use nbc_base::model::{
    Behavior, Body, Displacements, Library, MaterialKind, Palette, Pattern, Robot, SearchObjective, Transition,
};
use nbc_swarm::evolve::{Elite, NicheKey};

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Elites<'a> {
    /// The declaration's name.
    run: &'a str,
    #[serde(skip)]
    stimuli: usize,
    objective: SearchObjective,
    axes: Vec<ArchiveAxis>,
    elites: Vec<EliteData>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EliteData {
    seed: u64,
    /// The bin on each axis, from 0.
    niche: Vec<u16>,
    behavior: Behavior,
    /// The gate, such as `nand`.
    function: &'static str,
    /// The two fitnesses of the run's objective.
    fitness: [f64; 2],
    displacement: Displacements,
    #[serde(flatten)]
    body: BodyData,
    /// The generation in which it was born.
    generation: u32,
    /// Bodies tried up to and with it.
    evaluations: u64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct BodyData {
    width: usize,
    height: usize,
    voxels: usize,
    /// Voxels that swell with time.
    actuators: usize,
    /// Voxels that respond to a stimulus.
    sensors: usize,
    /// Rows of material codes, top row first; 0 is empty.
    body: Vec<String>,
    /// The materials of the codes from 1 on, if they are not the paper's.
    #[serde(skip_serializing_if = "Option::is_none")]
    materials: Option<Arc<Palette>>,
}

impl BodyData {
    fn of(body: &Body) -> Self {
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
            materials: body.own_materials(),
        }
    }

    const COLUMNS: [&'static str; 7] = ["width", "height", "voxels", "actuators", "sensors", "body", "materials"];

    fn cells(&self) -> [String; 7] {
        let materials = self
            .materials
            .as_ref()
            .map(|materials| serde_json::to_string(&**materials).expect("materials can be written as JSON"));
        let [width, height, voxels, actuators, sensors] =
            [self.width, self.height, self.voxels, self.actuators, self.sensors].map(|count| count.to_string());
        [width, height, voxels, actuators, sensors, self.body.join("|"), cell(&materials.unwrap_or_default())]
    }
}

impl<'a> Elites<'a> {
    pub fn of(results: &'a EvolutionResults) -> Self {
        let elites = results.runs.iter().flat_map(|(&seed, run)| {
            let niche = move |(key, elites): &'a (NicheKey, Vec<Elite>)| {
                elites.iter().map(move |elite| EliteData::of(seed, key, elite))
            };
            run.niches.iter().flat_map(niche)
        });
        Self {
            run: &results.name,
            stimuli: results.stimuli,
            objective: results.objective,
            axes: results.named_axes(),
            elites: elites.collect(),
        }
    }

    pub fn csv(&self) -> String {
        let own = ["run", "seed", "behavior", "function", "fitness_1", "fitness_2"].map(str::to_owned);
        let niche = self.axes.iter().enumerate().map(|(place, axis)| self.axis_column(place, axis));
        let head = own.into_iter().chain(niche).chain(displacement_columns(vec![self.stimuli]));
        let head =
            head.chain(BodyData::COLUMNS.map(str::to_owned)).chain(["generation", "evaluations"].map(str::to_owned));
        let rows = self.elites.iter().map(|elite| line(elite.cells(self.run)));
        std::iter::once(line(head)).chain(rows).collect()
    }

    /// An axis whose word occurs twice gets its place, too.
    fn axis_column(&self, place: usize, axis: &ArchiveAxis) -> String {
        let alone = self.axes.iter().filter(|other| other.name == axis.name).count() == 1;
        if alone { format!("niche_{}", axis.name) } else { format!("niche_{}_{}", axis.name, place + 1) }
    }
}

impl EliteData {
    pub fn of(seed: u64, key: &NicheKey, elite: &Elite) -> Self {
        Self {
            seed,
            niche: key.0.clone(),
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
        cells.extend(self.displacement.iter().map(|value| value.to_string()));
        cells.extend(self.body.cells());
        cells.extend([self.generation.to_string(), self.evaluations.to_string()]);
        cells
    }
}

pub fn robots_csv(library: &Library) -> String {
    const CHARACTER: [&str; 6] = ["clock", "switches", "error_rate", "glitch_rate", "margin", "topples"];
    const RADIUS: [&str; 3] = ["radius", "radius_vary", "radius_error_rate"];
    const PROVENANCE: [&str; 6] = ["program", "version", "evolution", "seed", "generation", "evaluations"];
    // Those of two stimuli have columns of their own even where there are only robots with three.
    let is_wide = library.robots.iter().any(|robot| robot.behavior.stimuli() == 3);
    let stimuli: &[usize] = if is_wide { &[2, 3] } else { &[2] };
    let own = ["name", "behavior", "function"].map(str::to_owned);
    let head = own
        .into_iter()
        .chain(CHARACTER.map(str::to_owned))
        .chain(
            switches(stimuli)
                .map(|(stimuli, from, to)| format!("settle_{}_{}", from.digits(stimuli), to.digits(stimuli))),
        )
        .chain(RADIUS.map(str::to_owned));
    let head = head.chain(displacement_columns(stimuli.to_vec())).chain(BodyData::COLUMNS.map(str::to_owned));
    let head = line(head.chain(PROVENANCE.map(str::to_owned)));
    std::iter::once(head).chain(library.robots.iter().map(|robot| line(robot_cells(robot, stimuli)))).collect()
}

fn robot_cells(robot: &Robot, stimuli: &[usize]) -> Vec<String> {
    let (character, provenance) = (&robot.character, &robot.provenance);
    let mut cells = vec![cell(&robot.name), robot.behavior.to_string(), robot.function().name().to_owned()];
    cells.extend([character.clock.to_string(), character.switches.to_string()]);
    cells.extend([character.error_rate, character.glitch_rate, character.margin].map(|value| value.to_string()));
    cells.push(character.topples.to_string());
    cells.extend(switches(stimuli).map(|(stimuli, from, to)| {
        let is_same = |one: &&Transition| (one.stimuli, one.from, one.to) == (stimuli, from, to);
        let same = character.settle.iter().find(is_same);
        same.map_or(String::new(), |transition| transition.cycles.to_string())
    }));
    let radius = character.radius.as_ref();
    cells.push(radius.map_or(String::new(), |found| found.radius.to_string()));
    cells.push(radius.map_or(String::new(), |found| cell(&found.vary.replace(',', " "))));
    cells.push(radius.and_then(|found| found.error_rate).map_or(String::new(), |rate| rate.to_string()));
    for &count in stimuli {
        let is_own = robot.behavior.stimuli() == count;
        let cell = |at: usize| if is_own { robot.displacement[at].to_string() } else { String::new() };
        cells.extend((0..1 << count).map(cell));
    }
    cells.extend(BodyData::of(&robot.body).cells());
    cells.extend([&provenance.program, &provenance.version, &provenance.evolution].map(|text| cell(text)));
    cells.extend([provenance.seed, u64::from(provenance.generation), provenance.evaluations].map(|n| n.to_string()));
    cells
}

fn switches(stimuli: &[usize]) -> impl Iterator<Item = (usize, Pattern, Pattern)> {
    let of = |count: usize| {
        let pairs = Pattern::all(count).flat_map(move |from| Pattern::all(count).map(move |to| (count, from, to)));
        pairs.filter(|(_, from, to)| from != to)
    };
    stimuli.iter().copied().flat_map(of)
}

fn displacement_columns(stimuli: Vec<usize>) -> impl Iterator<Item = String> {
    let column =
        |count: usize| Pattern::all(count).map(move |pattern| format!("displacement_{}", pattern.digits(count)));
    stimuli.into_iter().flat_map(column)
}
