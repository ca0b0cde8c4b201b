//! A search for gates around a body that somebody has painted.

use nbc_base::model::{Body, Displacements, Evolution, Fault};
use nbc_base::source::MemoryWorld;
use nbc_sim::Simulator;
use nbc_swarm::evolve::{CandidateOutcome, NeighborSearch, NicheKey, Scores};
use nbc_swarm::{evaluate_bodies, walk};

use crate::session::Session;

/// Bodies of a generation.
const BATCH: u32 = 16;

/// A search for gates. It is advanced by a generation at a time, and can be dropped between any two.
#[derive(Clone, Debug)]
pub struct BodySearch {
    search: NeighborSearch,
}

impl BodySearch {
    /// A search in a box of columns and rows, or in that of the body to start from.
    pub fn new(start: Option<Body>, [width, height]: [usize; 2], generations: u32, seed: u64) -> Self {
        let mut evolution = declared(width, height, generations);
        if let Some(start) = &start {
            evolution.palette = start.palette().clone();
        }
        Self { search: NeighborSearch::new(evolution, start, seed) }
    }

    /// The search and its archive.
    pub fn search(&self) -> &NeighborSearch {
        &self.search
    }

    /// Does a generation, of those bodies that are `wanted`. Returns the niches whose best body has changed.
    pub fn advance(&mut self, simulator: &Simulator, wanted: impl Fn(&Body) -> bool) -> Vec<NicheKey> {
        let mut bodies = self.search.ask();
        bodies.retain(wanted);
        let outcomes = evaluate_bodies(simulator, self.search.evolution(), bodies.clone());
        let evaluated = bodies.len() as u64;
        let measured = bodies.into_iter().zip(outcomes).filter_map(|(body, outcome)| match outcome {
            CandidateOutcome::Measured(scores) => Some((body, scores)),
            _ => None,
        });
        let steady = steady(simulator, measured.collect());
        self.search.tell(evaluated, steady)
    }
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

/// The bodies whose behavior in long simulations is that in the short holds of the search. The others would walk in
/// another way than the archive says.
fn steady(simulator: &Simulator, measured: Vec<(Body, Scores)>) -> Vec<(Body, Scores)> {
    let bodies: Vec<Body> = measured.iter().map(|(body, _)| body.clone()).collect();
    let walked = walk(simulator, &bodies);
    let is_steady = |scores: &Scores, walked: Result<Displacements, Fault>| {
        walked.is_ok_and(|displacement| displacement.behavior() == scores.behavior)
    };
    let both = measured.into_iter().zip(walked);
    both.filter(|((_, scores), walked)| is_steady(scores, *walked)).map(|(measured, _)| measured).collect()
}
