//! A search for gates around a body that somebody has painted.

use serde::{Deserialize, Serialize};

use nbc_base::model::{Body, Evolution, bodies};
use nbc_base::source::MemoryWorld;
use nbc_sim::Simulator;
use nbc_swarm::evolve::{Candidate, CandidateOrigin, CandidateOutcome, Elite, NicheKey, Scores, Search};
use nbc_swarm::{evaluate_bodies, walk};

use crate::session::Session;

const BATCH: u32 = 16;

#[derive(Clone, Debug)]
pub struct BodySearch {
    search: Search,
}

/// Bodies to be measured anywhere: the result depends on these values alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyTrials {
    pub evolution: Evolution,
    #[serde(with = "bodies")]
    pub bodies: Vec<Body>,
}

impl BodySearch {
    pub fn new(start: Option<Body>, [width, height]: [usize; 2], generations: u32, seed: u64) -> Self {
        let mut evolution = declared(width, height, generations);
        if let Some(start) = &start {
            evolution.palette = start.palette().clone();
        }
        Self { search: Search::around(&evolution, start, seed) }
    }

    pub fn search(&self) -> &Search {
        &self.search
    }

    pub fn ask(&self, wanted: impl Fn(&Body) -> bool) -> BodyTrials {
        let asked = self.search.ask().into_iter().map(|candidate| candidate.body);
        let bodies = asked.filter(wanted).collect();
        BodyTrials { evolution: self.search.evolution().clone(), bodies }
    }

    /// Ends a generation. `found` is in the order of `bodies`. Returns the niches whose best body has changed.
    pub fn tell(&mut self, bodies: Vec<Body>, found: Vec<Option<Scores>>) -> Vec<NicheKey> {
        let before = self.search.archive().clone();
        let told = bodies.into_iter().zip(found).map(|(body, scores)| {
            let outcome = scores.map_or(CandidateOutcome::Inconsistent, CandidateOutcome::Measured);
            (Candidate::of_voxels(CandidateOrigin::Random, body), outcome)
        });
        let (candidates, outcomes): (Vec<_>, Vec<_>) = told.unzip();
        self.search.tell(&candidates, &outcomes);
        let is_new = |(key, elites): &(&NicheKey, &[Elite])| before.elites_of(key) != *elites;
        self.search.archive().niches().filter(is_new).map(|(key, _)| key.clone()).collect()
    }
}

impl BodyTrials {
    /// `None` if a body cannot be measured, or behaves otherwise in long simulations than in the search's short holds.
    pub fn measure(&self, simulator: &Simulator) -> Vec<Option<Scores>> {
        let outcomes = evaluate_bodies(simulator, &self.evolution, self.bodies.clone());
        let measured = |outcome| if let CandidateOutcome::Measured(scores) = outcome { Some(scores) } else { None };
        let mut found: Vec<Option<Scores>> = outcomes.into_iter().map(measured).collect();
        let tried = self.bodies.iter().zip(&found).filter(|(_, scores)| scores.is_some());
        let walked = walk(simulator, &tried.map(|(body, _)| body.clone()).collect::<Vec<_>>());
        for (scores, walked) in found.iter_mut().filter(|scores| scores.is_some()).zip(walked) {
            scores.take_if(|scores| walked.ok().map(|displacement| displacement.behavior()) != Some(scores.behavior));
        }
        found
    }

    pub fn split(&self, parts: usize) -> Vec<Self> {
        let all = self.bodies.len();
        let part = |part: usize| self.bodies[part * all / parts..(part + 1) * all / parts].to_vec();
        (0..parts).map(|at| Self { evolution: self.evolution.clone(), bodies: part(at) }).collect()
    }
}

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
