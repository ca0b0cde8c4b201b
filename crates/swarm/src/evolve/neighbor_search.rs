//! A search that tries neighbors: of its elites, and at first of a body that somebody has made.

use nbc_base::model::{Body, Evolution};
use rand::RngExt;

use crate::evolve::archive::{Archive, Elite};
use crate::evolve::descriptor::NicheKey;
use crate::evolve::neighbors::neighbor;
use crate::evolve::outcome::Scores;
use crate::evolve::search::{Search, stream};

/// The number of generations without an elite in which neighbors of the start are tried. After them, random bodies are
/// tried.
const NEARBY: u32 = 3;

/// A search around a body, by ask and tell. It knows no physics.
#[derive(Clone, Debug)]
pub struct NeighborSearch {
    evolution: Evolution,
    archive: Archive,
    start: Option<Body>,
    seed: u64,
    generation: u32,
    evaluations: u64,
}

impl NeighborSearch {
    /// A search with the archive, the box and the batch of a declaration. Without a start it begins with random bodies.
    pub fn new(evolution: Evolution, start: Option<Body>, seed: u64) -> Self {
        let archive = Archive::new(&evolution);
        Self { evolution, archive, start, seed, generation: 0, evaluations: 0 }
    }

    /// The declaration.
    pub fn evolution(&self) -> &Evolution {
        &self.evolution
    }

    /// The generations that are done.
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// The bodies that were evaluated.
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// The bodies of the next generation: neighbors of elites; at first those of the start, or random ones.
    pub fn ask(&self) -> Vec<Body> {
        let (generation, start) = (self.generation, self.start.as_ref());
        let elites: Vec<&Body> = self.archive.elites().map(|elite| &elite.body).collect();
        if elites.is_empty() && (start.is_none() || generation >= NEARBY) {
            let seed = self.seed.wrapping_add(u64::from(generation));
            return Search::new(&self.evolution, seed).ask().into_iter().map(|candidate| candidate.body).collect();
        }
        let drawn = (0..self.evolution.batch).map(|index| {
            let mut rng = stream(self.seed, generation, index as u32);
            let parent = match start {
                Some(start) if elites.is_empty() => start,
                _ => elites[rng.random_range(0..elites.len())],
            };
            neighbor(parent, &mut rng)
        });
        start.filter(|_| generation == 0).into_iter().cloned().chain(drawn).collect()
    }

    /// Ends a generation, of which so many bodies were evaluated, and these are worth keeping. Returns the niches whose
    /// best elite has changed.
    pub fn tell(&mut self, evaluated: u64, measured: Vec<(Body, Scores)>) -> Vec<NicheKey> {
        let before: Vec<(NicheKey, [f64; 2])> = self.best().map(|(key, elite)| (key.clone(), elite.fitness)).collect();
        self.evaluations += evaluated;
        for (body, scores) in measured {
            self.archive.add(Elite {
                fitness: scores.fitness,
                behavior: scores.behavior,
                displacement: scores.displacement,
                body,
                genotype: None,
                generation: self.generation,
                evaluations: self.evaluations,
            });
        }
        self.generation += 1;
        let is_new = |(key, elite): &(&NicheKey, &Elite)| !before.contains(&((*key).clone(), elite.fitness));
        self.best().filter(is_new).map(|(key, _)| key.clone()).collect()
    }

    /// The best elite of each niche.
    pub fn best(&self) -> impl Iterator<Item = (&NicheKey, &Elite)> {
        let best = |elites: &'_ [Elite]| {
            (0..elites.len()).max_by(|&a, &b| elites[a].fitness[0].total_cmp(&elites[b].fitness[0]))
        };
        self.archive.niches().filter_map(move |(key, elites)| Some((key, &elites[best(elites)?])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::search::tests::evolution;
    use nbc_base::model::Palette;

    #[test]
    fn a_start_without_elites_around_it_is_given_up() {
        let start = Body::parse(&["333", "343", "333"], &Palette::paper()).unwrap();
        let mut search = NeighborSearch::new(Evolution { width: 3, height: 3, ..evolution() }, Some(start.clone()), 1);
        let differing = |body: &Body| body.codes().iter().zip(start.codes()).filter(|(a, b)| a != b).count();
        for generation in 0..NEARBY {
            let around = search.ask();
            let is_start = usize::from(generation == 0);
            assert!(around[is_start..].iter().all(|body| (1..=3).contains(&differing(body))), "{around:?}");
            assert_eq!(search.tell(around.len() as u64, Vec::new()), []);
        }
        let random = search.ask();
        search.start = None;
        assert_eq!(random, search.ask());
    }
}
