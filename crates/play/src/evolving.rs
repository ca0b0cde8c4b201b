//! A search for gates around a body, shown while it runs.

use rand::RngExt;

use crate::bodies;
use crate::jobs::{Job, PortionEnd};
use crate::message::{ArchiveChange, AxisEntry, EvolutionEnd, NicheEntry, PlayEvent, RequestResult};
use crate::refusal::Refused;
use crate::request::EvolveRequest;
use nbc_base::model::{Axis, Body, Displacements, Evolution, Fault};
use nbc_base::source::MemoryWorld;
use nbc_session::report::axis_word;
use nbc_session::{Observer, Session};
use nbc_sim::Simulator;
use nbc_swarm::evolve::{Archive, CandidateOutcome, Elite, NicheKey, Scores, Search, neighbor, stream};
use nbc_swarm::{evaluate_bodies, walk};

/// The largest and the smallest side of a box, and the most generations.
const SIDES: std::ops::RangeInclusive<usize> = 2..=10;
const MOST_GENERATIONS: u32 = 1000;
/// Bodies of a generation.
const BATCH: u32 = 16;
/// The number of generations without a gate in which neighbors of the start are tried. After them, random bodies are
/// tried.
const NEARBY: u32 = 3;

/// A search and its archive.
pub(super) struct Evolving {
    evolution: Evolution,
    archive: Archive,
    start: Option<Body>,
    seed: u64,
    /// The generations that are done.
    generation: u32,
    evaluations: u64,
}

/// The declaration of the search.
fn declared(width: usize, height: usize, generations: u32) -> Evolution {
    let text = format!(
        "evolution play {{ from: gates, objective: gate, box: {width} x {height}, batch: {BATCH}, \
         descriptors: [active in 8 bins, behavior], generations: {generations} }}"
    );
    let mut session = Session::new(MemoryWorld::default());
    session.update("play.nb", 1, text);
    let checked = session.open("play.nb").unwrap_or_else(|found| panic!("the declaration is correct: {found:?}"));
    checked.program.evolution("play").expect("it is declared above").clone()
}

/// The bodies whose behavior in long simulations is that in the short holds of the search. The others would appear in
/// the designer with another behavior than in the archive.
fn steady(simulator: &Simulator, measured: Vec<(Body, Scores)>) -> Vec<(Body, Scores)> {
    let bodies: Vec<Body> = measured.iter().map(|(body, _)| body.clone()).collect();
    let walked = walk(simulator, &bodies);
    let is_steady = |scores: &Scores, walked: Result<Displacements, Fault>| {
        walked.is_ok_and(|displacement| displacement.behavior() == scores.behavior)
    };
    let both = measured.into_iter().zip(walked);
    both.filter(|((_, scores), walked)| is_steady(scores, *walked)).map(|(measured, _)| measured).collect()
}

impl Evolving {
    /// A search that begins.
    ///
    /// # Errors
    /// When the body is not one, or the box is too small or too large.
    pub(super) fn new(request: &EvolveRequest) -> Result<Self, Refused> {
        let start = request.body.as_deref().map(bodies::body).transpose()?;
        let [width, height] = start.as_ref().map_or(request.bounds, |body| [body.width(), body.height()]);
        if !SIDES.contains(&width) || !SIDES.contains(&height) {
            let sides = format!("expected a box of {} to {} voxels a side", SIDES.start(), SIDES.end());
            return Err(Refused::Body(sides));
        }
        let mut evolution = declared(width, height, request.generations.clamp(1, MOST_GENERATIONS));
        if let Some(start) = &start {
            evolution.palette = start.palette().clone();
        }
        let archive = Archive::new(&evolution);
        Ok(Self { evolution, archive, start, seed: request.seed, generation: 0, evaluations: 0 })
    }

    /// Does a generation, and reports the niches that have changed.
    ///
    /// # Errors
    /// When it is stopped.
    pub(super) fn advance(&mut self, job: &mut Job) -> Result<PortionEnd, Refused> {
        job.check()?;
        let changed = self.next_generation(&job.simulator());
        self.generation += 1;
        let (generation, generations) = (self.generation, self.evolution.generations);
        job.outbox.event(PlayEvent::Archive(self.change(job.id, generation, &changed)));
        job.progress(generation.into(), generations.into());
        if generation < generations {
            return Ok(PortionEnd::More);
        }
        job.check()?;
        Ok(PortionEnd::Done(Some(RequestResult::Evolve(EvolutionEnd { generations, evaluations: self.evaluations }))))
    }

    /// Does a generation, and returns the niches that have changed.
    fn next_generation(&mut self, simulator: &Simulator) -> Vec<NicheKey> {
        let generation = self.generation;
        let mut bodies = self.candidates();
        // A body without a third stimulus would have another behavior in the designer.
        bodies.retain(|body| bodies::body(&body.rows()).is_ok_and(|own| own.palette() == body.palette()));
        let outcomes = evaluate_bodies(simulator, &self.evolution, bodies.clone());
        let before: Vec<(NicheKey, [f64; 2])> = self.best().map(|(key, elite)| (key.clone(), elite.fitness)).collect();
        self.evaluations += bodies.len() as u64;
        let measured = bodies.into_iter().zip(outcomes).filter_map(|(body, outcome)| match outcome {
            CandidateOutcome::Measured(scores) => Some((body, scores)),
            _ => None,
        });
        for (body, scores) in steady(simulator, measured.collect()) {
            self.archive.add(Elite {
                fitness: scores.fitness,
                behavior: scores.behavior,
                displacement: scores.displacement,
                body,
                genotype: None,
                generation,
                evaluations: self.evaluations,
            });
        }
        let is_new = |(key, elite): &(&NicheKey, &Elite)| !before.contains(&((*key).clone(), elite.fitness));
        self.best().filter(is_new).map(|(key, _)| key.clone()).collect()
    }

    /// The bodies of a generation: neighbors of elites; at first those of the start, or random ones.
    fn candidates(&self) -> Vec<Body> {
        let (generation, start) = (self.generation, self.start.as_ref());
        let elites: Vec<&Body> = self.archive.elites().map(|elite| &elite.body).collect();
        if elites.is_empty() && (start.is_none() || generation >= NEARBY) {
            let seed = self.seed.wrapping_add(u64::from(generation));
            return Search::new(&self.evolution, seed).ask().into_iter().map(|candidate| candidate.body).collect();
        }
        let drawn = (0..BATCH).map(|index| {
            let mut rng = stream(self.seed, generation, index);
            let parent = match start {
                Some(start) if elites.is_empty() => start,
                _ => elites[rng.random_range(0..elites.len())],
            };
            neighbor(parent, &mut rng)
        });
        start.filter(|_| generation == 0).into_iter().cloned().chain(drawn).collect()
    }

    fn best(&self) -> impl Iterator<Item = (&NicheKey, &Elite)> {
        let best = |elites: &'_ [Elite]| {
            (0..elites.len()).max_by(|&a, &b| elites[a].fitness[0].total_cmp(&elites[b].fitness[0]))
        };
        self.archive.niches().filter_map(move |(key, elites)| Some((key, &elites[best(elites)?])))
    }

    fn change(&self, id: u64, generation: u32, changed: &[NicheKey]) -> ArchiveChange {
        let axis = |&axis: &Axis| AxisEntry(axis_word(axis), axis.bins(self.evolution.palette.inputs()));
        let niche = |(key, elite): (&NicheKey, &Elite)| NicheEntry {
            place: key.0.clone(),
            fitness: elite.fitness,
            body: elite.body.rows(),
            letters: elite.behavior.to_string(),
            function: elite.behavior.function().name(),
        };
        ArchiveChange {
            id,
            generation,
            axes: self.evolution.descriptors.iter().map(axis).collect(),
            niches: self.best().filter(|(key, _)| changed.contains(key)).map(niche).collect(),
            evaluations: self.evaluations,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Palette;

    #[test]
    fn a_start_without_gates_around_it_is_given_up() {
        let start = Body::parse(&["333", "343", "333"], &Palette::paper()).unwrap();
        let request = EvolveRequest { body: Some(start.rows()), bounds: [3, 3], generations: 10, seed: 1 };
        let mut evolving = Evolving::new(&request).unwrap();
        let differing = |body: &Body| body.codes().iter().zip(start.codes()).filter(|(a, b)| a != b).count();
        evolving.generation = NEARBY - 1;
        let around = evolving.candidates();
        assert!(around.iter().all(|body| (1..=3).contains(&differing(body))), "{around:?}");
        evolving.generation = NEARBY;
        let random = evolving.candidates();
        evolving.start = None;
        assert_eq!(random, evolving.candidates());
    }
}
