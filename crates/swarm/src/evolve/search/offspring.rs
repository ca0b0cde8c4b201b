//! The candidates of a generation: how each is made from an elite, at random, or as a mirror image.

use rand::RngExt;

use super::Search;
use crate::evolve::mutate::pick;
use crate::evolve::neighbors::{crossed, neighbor, random_body};
use crate::evolve::{Elite, NicheKey, cppn, mutate, phenotype, validate};
use nbc_base::model::{Body, Evolution, Genome, Genotype, Matter, Rules};

/// Mutations tried for one candidate before it is given up: a palette that cannot walk must not hang the search.
const MOST_ATTEMPTS: u32 = 20_000;
/// Generations without an elite in which neighbors of a start are tried. After them, random bodies are tried.
const NEARBY: u32 = 3;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CandidateOrigin {
    Random,
    Offspring(NicheKey),
    Start,
    Mirror,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    pub origin: CandidateOrigin,
    pub genotype: Option<Genotype>,
    pub body: Body,
    /// Networks or bodies drawn before it that could not be tried.
    pub undeveloped: u32,
}

impl Candidate {
    pub fn of_voxels(origin: CandidateOrigin, body: Body) -> Self {
        Self { origin, genotype: None, body, undeveloped: 0 }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum MirrorSource {
    Network(Genotype),
    Voxels(Body),
}

impl Search {
    /// A new body; `None` if this seems impossible.
    pub(super) fn draw(&self, index: u32, origin: CandidateOrigin, parent: Option<&Elite>) -> Option<Candidate> {
        match self.evolution.genome {
            Genome::Cppn => self.develop(index, origin, parent),
            Genome::Voxels { crossover } => self.assemble(index, origin, parent, crossover),
        }
    }

    /// A share of the offspring takes a part of another elite of its behavior. Without a parent, voxels are random.
    fn assemble(
        &self,
        index: u32,
        origin: CandidateOrigin,
        parent: Option<&Elite>,
        crossover: f64,
    ) -> Option<Candidate> {
        let Evolution { palette, width, height, .. } = &self.evolution;
        let mut rng = self.stream(index);
        for undeveloped in 0..MOST_ATTEMPTS {
            let body = match parent {
                None => random_body(*width, *height, palette, &mut rng),
                Some(elite) if rng.random::<f64>() < crossover => {
                    let mates: Vec<&Elite> =
                        self.archive.elites().filter(|mate| mate.behavior == elite.behavior).collect();
                    let mate = pick(mates.len(), &mut rng).map_or(elite, |at| mates[at]);
                    neighbor(&crossed(&elite.body, &mate.body, &mut rng), &mut rng)
                }
                Some(elite) => neighbor(&elite.body, &mut rng),
            };
            if validate(&body).is_ok() && parent.is_none_or(|elite| elite.body != body) {
                return Some(Candidate { undeveloped, ..Candidate::of_voxels(origin, body) });
            }
        }
        None
    }

    fn develop(&self, index: u32, origin: CandidateOrigin, parent: Option<&Elite>) -> Option<Candidate> {
        let Evolution { palette, rules, width, height, mutation, .. } = &self.evolution;
        let mut rng = self.stream(index);
        let start = parent
            .and_then(|elite| elite.genotype.clone())
            .unwrap_or_else(|| cppn::start(palette.materials().len(), *rules));
        let mut genotype = start.clone();
        for undeveloped in 0..MOST_ATTEMPTS {
            mutate(&mut genotype, mutation, *rules, &mut rng);
            let body = phenotype(&genotype, palette, *rules, *width, *height);
            match judge(*rules, parent.map(|elite| &elite.body), &body) {
                Attempt::Done => {
                    return Some(Candidate { origin, genotype: Some(genotype), body, undeveloped });
                }
                Attempt::GoOn => {}
                Attempt::Undo => genotype.clone_from(&start),
            }
        }
        None
    }

    pub(super) fn neighbors(&self, start: Option<&Body>) -> Vec<Candidate> {
        let elites: Vec<&Body> = self.archive.elites().map(|elite| &elite.body).collect();
        if elites.is_empty() && (start.is_none() || self.generation >= NEARBY) {
            return Self::new(&self.evolution, self.seed.wrapping_add(u64::from(self.generation))).ask();
        }
        let first = start.filter(|_| self.generation == 0).into_iter().cloned();
        let drawn = (0..self.evolution.batch).map(|index| {
            let mut rng = self.stream(index as u32);
            let parent = match start {
                Some(start) if elites.is_empty() => start,
                _ => elites[rng.random_range(0..elites.len())],
            };
            neighbor(parent, &mut rng)
        });
        first.chain(drawn).map(|body| Candidate::of_voxels(CandidateOrigin::Random, body)).collect()
    }

    pub(super) fn mirror(&self, source: &MirrorSource) -> Candidate {
        let Evolution { palette, rules, width, height, .. } = &self.evolution;
        let (genotype, body) = match source {
            MirrorSource::Network(genotype) => {
                (Some(genotype.clone()), phenotype(genotype, palette, *rules, *width, *height))
            }
            MirrorSource::Voxels(body) => (None, body.clone()),
        };
        Candidate { origin: CandidateOrigin::Mirror, genotype, body, undeveloped: 0 }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Attempt {
    Done,
    GoOn,
    Undo,
}

/// By the paper's text, a mutation without a valid body is undone, and an offspring differs from its parent. In the
/// authors' code, mutations accumulate until the body is valid, even if it is the parent's.
fn judge(rules: Rules, parent: Option<&Body>, body: &Body) -> Attempt {
    let is_kept = rules.follow_code(Matter::Repair);
    match (validate(body), parent) {
        (Ok(()), Some(parent)) if !is_kept && parent == body => Attempt::GoOn,
        (Ok(()), _) => Attempt::Done,
        (Err(_), Some(_)) if !is_kept => Attempt::Undo,
        (Err(_), _) => Attempt::GoOn,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::CandidateOutcome;
    use crate::evolve::tests::evolution;
    use nbc_base::model::Palette;

    #[test]
    fn invalid_mutations_are_undone_by_the_text_and_add_up_by_the_code() {
        use Attempt::{Done, GoOn, Undo};
        let [same, other, apart] = ["3330", "3331", "3303"].map(|row| Body::parse(&[row], &Palette::paper()).unwrap());
        let check = |rules, parent: Option<&Body>, expected: [Attempt; 3]| {
            let found = [&same, &other, &apart].map(|found| judge(rules, parent, found));
            assert_eq!(found, expected, "{rules:?}, {parent:?}");
        };
        check(Rules::PAPER, Some(&same), [GoOn, Done, Undo]);
        check(Rules::CODE, Some(&same), [Done, Done, GoOn]);
        check(Rules::PAPER, None, [Done, Done, GoOn]);
        check(Rules::CODE, None, [Done, Done, GoOn]);
    }

    #[test]
    fn a_start_without_elites_around_it_is_given_up() {
        let start = Body::parse(&["333", "343", "333"], &Palette::paper()).unwrap();
        let evolution = Evolution { width: 3, height: 3, ..evolution() };
        let [mut search, mut other] = [Some(start.clone()), None].map(|start| Search::around(&evolution, start, 1));
        let differing = |body: &Body| body.codes().iter().zip(start.codes()).filter(|(a, b)| a != b).count();
        for generation in 0..NEARBY {
            let around = search.ask();
            let is_start = usize::from(generation == 0);
            assert!(around[is_start..].iter().all(|one| (1..=3).contains(&differing(&one.body))), "{around:?}");
            search.tell(&around, &vec![CandidateOutcome::Surpassed; around.len()]);
            other.tell(&[], &[]);
        }
        assert_eq!(search.ask(), other.ask());
    }
}
