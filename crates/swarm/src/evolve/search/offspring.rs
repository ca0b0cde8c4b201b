//! The candidates of a generation: how each is made from an elite, at random, or as a mirror image.

use rand::RngExt;

use super::Search;
use crate::evolve::mutate::pick;
use crate::evolve::neighbors::{crossed, neighbor, random_body};
use crate::evolve::{Elite, NicheKey, cppn, mutate, phenotype, validate};
use nbc_base::model::{Body, Evolution, Genome, Genotype, Matter, Rules};

/// Mutations tried for one candidate before it is given up: a palette that cannot walk must not hang the search.
const MOST_ATTEMPTS: u32 = 20_000;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CandidateOrigin {
    Random,
    Offspring(NicheKey),
    /// A robot with which the search begins.
    Start,
    /// The mirror image of a body that entered the archive in the previous generation.
    Mirror,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// Its place in the generation.
    pub index: u32,
    pub origin: CandidateOrigin,
    pub genotype: Option<Genotype>,
    pub body: Body,
    /// Networks or bodies drawn before it that could not be tried.
    pub undeveloped: u32,
}

/// A body whose mirror image is to be tried next.
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

    /// Changes the voxels of a parent, after putting a part of another elite of its behavior in their place for that
    /// share of the offspring; without a parent, draws random voxels.
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
                return Some(Candidate { index, origin, genotype: None, body, undeveloped });
            }
        }
        None
    }

    /// Mutates a network until its body is valid; `None` if this seems impossible.
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
                    return Some(Candidate { index, origin, genotype: Some(genotype), body, undeveloped });
                }
                Attempt::GoOn => {}
                Attempt::Undo => genotype.clone_from(&start),
            }
        }
        None
    }

    pub(super) fn mirror(&self, index: u32, source: &MirrorSource) -> Candidate {
        let Evolution { palette, rules, width, height, .. } = &self.evolution;
        let (genotype, body) = match source {
            MirrorSource::Network(genotype) => {
                (Some(genotype.clone()), phenotype(genotype, palette, *rules, *width, *height))
            }
            MirrorSource::Voxels(body) => (None, body.clone()),
        };
        Candidate { index, origin: CandidateOrigin::Mirror, genotype, body, undeveloped: 0 }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Attempt {
    Done,
    GoOn,
    /// Undo all mutations so far.
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
}
