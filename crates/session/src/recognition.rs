//! How well bodies of an evolution tell images apart that they need not have seen.

use serde::Serialize;

use crate::report::{Align, Svg, TextTable, draw_accuracies};
use crate::wording;
use nbc_base::diag::{Diagnostic, counted};
use nbc_base::model::{Direction, Evolution, ImageOrder, NamedSchedule, Program, Schedule, SearchObjective};
use nbc_sim::Simulator;
use nbc_swarm::evolve::Elite;
use nbc_swarm::{ImageSets, image_displacements};

/// Images between two looks for a signal.
const PORTION: usize = 32;

/// Bodies that are shown the images of a schedule, each from a fresh start.
#[derive(Clone, Debug)]
pub struct Recognition {
    pub(super) simulator: Simulator,
    pub(super) evolution: Evolution,
    pub(super) schedule: NamedSchedule,
    /// With their seeds.
    pub(super) elites: Vec<(u64, Elite)>,
    /// Displacement of each body before each image so far, in voxels; `None` after a fault.
    walked: Vec<Vec<Option<f64>>>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RecognitionReport {
    pub schedule: String,
    pub bodies: Vec<RecognizingBody>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RecognizingBody {
    pub evolution: String,
    pub seed: u64,
    /// Rows of material codes, top row first.
    pub body: Vec<String>,
    /// Least distance before the images of its search, in voxels.
    pub least: f64,
    /// Images before which it walked the right way.
    pub correct: usize,
    pub images: usize,
    pub accuracy: f64,
    pub sets: Vec<RecognizedSet>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RecognizedSet {
    pub set: String,
    /// The right way, `left` or `right`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["left", "right"])))]
    pub way: &'static str,
    pub correct: usize,
    pub images: usize,
    /// Least distance in that way, in voxels; `None` if a simulation failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
}

impl Recognition {
    /// The schedule has the sets of the evolution's schedule, in the same order.
    pub fn new(
        program: &Program,
        evolution: &str,
        schedule: &str,
        elites: Vec<(u64, Elite)>,
        simulator: Simulator,
    ) -> Result<Self, Diagnostic> {
        let Some(found) = program.evolution(evolution) else {
            let known = program.evolutions.iter().map(|one| one.name.as_str());
            return Err(wording::unknown("evolution", evolution, known));
        };
        let Some(shown) = program.schedule(schedule) else {
            let known = program.schedules.iter().map(|one| one.name.as_str());
            return Err(wording::unknown("schedule", schedule, known));
        };
        if found.objective != SearchObjective::Images {
            return Err(wording::sees_no_images(evolution));
        }
        let known = ImageSets::of(&found.variable).count();
        if shown.sets.len() != known {
            return Err(wording::other_sets(schedule, shown.sets.len(), known));
        }
        if elites.is_empty() {
            return Err(wording::no_bodies(evolution));
        }
        if elites.iter().any(|(_, elite)| elite.body.palette() != &found.palette) {
            return Err(wording::other_materials(evolution));
        }
        let walked = vec![Vec::new(); elites.len()];
        Ok(Self { simulator, evolution: found.clone(), schedule: shown.clone(), elites, walked })
    }

    /// How many images the bodies have seen so far, and how many they will have seen at the end, all bodies together.
    pub fn progress(&self) -> (u64, u64) {
        let done = self.walked.iter().map(|walked| walked.len() as u64).sum();
        (done, (self.elites.len() * self.schedule.schedule.spells.len()) as u64)
    }

    /// Shows some images to a body; returns whether there are more.
    pub fn advance(&mut self) -> bool {
        let spells = &self.schedule.schedule.spells;
        let Some(place) = self.walked.iter().position(|walked| walked.len() < spells.len()) else { return false };
        let seen = self.walked[place].len();
        let portion = Schedule { spells: spells[seen..spells.len().min(seen + PORTION)].to_vec() };
        let body = std::slice::from_ref(&self.elites[place].1.body);
        let walked = image_displacements(&self.simulator, &self.evolution.world, ImageOrder::Apart, &portion, body);
        self.walked[place].extend(walked.into_iter().flatten().map(Result::ok));
        self.progress().0 < self.progress().1
    }

    pub fn finish(self) -> Vec<RecognizingBody> {
        let Self { evolution, schedule, elites, walked, .. } = self;
        let body = |((seed, elite), walked): (&(u64, Elite), &Vec<Option<f64>>)| {
            let sets: Vec<RecognizedSet> =
                (0..schedule.sets.len()).map(|number| recognized(&schedule, number, elite, walked)).collect();
            let (correct, images) = sets.iter().fold((0, 0), |sum, set| (sum.0 + set.correct, sum.1 + set.images));
            RecognizingBody {
                evolution: evolution.name.clone(),
                seed: *seed,
                body: elite.body.rows(),
                least: elite.fitness[0],
                correct,
                images,
                accuracy: correct as f64 / images.max(1) as f64,
                sets,
            }
        };
        elites.iter().zip(&walked).map(body).collect()
    }
}

fn recognized(schedule: &NamedSchedule, number: usize, elite: &Elite, walked: &[Option<f64>]) -> RecognizedSet {
    let pattern = Schedule::of_set(number);
    let direction = elite.behavior.direction(pattern);
    let own = schedule.schedule.spells.iter().zip(walked).filter(|(spell, _)| spell.pattern == pattern);
    let own: Vec<Option<f64>> = own.map(|(_, walked)| *walked).collect();
    let is_correct = |walked: &&Option<f64>| walked.is_some_and(|moved| Direction::of(moved) == direction);
    let whole: Option<Vec<f64>> = own.iter().copied().collect();
    RecognizedSet {
        set: schedule.sets[number].clone(),
        way: if direction == Direction::Right { "right" } else { "left" },
        correct: own.iter().filter(is_correct).count(),
        images: own.len(),
        least: whole.map(|walked| walked.iter().map(|moved| moved * direction.sign()).fold(f64::INFINITY, f64::min)),
    }
}

impl RecognitionReport {
    fn accuracies(&self) -> Vec<(&str, Vec<f64>)> {
        let runs = self.bodies.chunk_by(|a, b| a.evolution == b.evolution);
        runs.map(|own| (own[0].evolution.as_str(), own.iter().map(|body| body.accuracy).collect())).collect()
    }

    pub fn text(&self) -> String {
        let Self { schedule, bodies } = self;
        let columns = [
            ("evolution", Align::Left),
            ("seed", Align::Right),
            ("least", Align::Right),
            ("correct", Align::Right),
            ("", Align::Left),
        ];
        let mut table = TextTable::new(&columns);
        for RecognizingBody { evolution, seed, least, correct, images, accuracy, sets, .. } in bodies {
            let each: Vec<String> = sets
                .iter()
                .map(|RecognizedSet { set, way, correct, images, .. }| format!("{set}: {correct} of {images} {way}"))
                .collect();
            let correct = format!("{correct} of {images} ({:.1} %)", 100.0 * accuracy);
            table.push(vec![evolution.clone(), seed.to_string(), format!("{least:.2}"), correct, each.join(", ")]);
        }
        let mut text = format!("{} before the images of {schedule}\n{table}", counted(bodies.len(), "body"));
        for (evolution, accuracies) in self.accuracies() {
            if accuracies.len() > 1 {
                let mean = accuracies.iter().sum::<f64>() / accuracies.len() as f64;
                let least = accuracies.iter().copied().fold(1.0, f64::min);
                let most = accuracies.iter().copied().fold(0.0, f64::max);
                let [mean, least, most] = [mean, least, most].map(|share| format!("{:.1}", 100.0 * share));
                text += &format!("{evolution}: {mean} % on average, {least} to {most} %\n");
            }
        }
        text
    }

    pub fn chart(&self) -> Svg {
        draw_accuracies(&format!("Images of {} that are told apart", self.schedule), &self.accuracies())
    }
}
