//! The search: it is asked for candidates and told their results, generation by generation (paper, Methods;
//! docs/physics.md 11).

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::evolve::mutate::pick;
use crate::evolve::{
    AddStatus, Archive, CandidateOutcome, Counts, Descriptor, Elite, NicheKey, Recoding, Rivals, Scores, develop,
    mirrored, recodings, validate,
};
use nbc_base::model::{Behavior, Body, Displacements, Evolution, Genome, Genotype, NodeKind, Symmetry};

mod offspring;

pub use offspring::{Candidate, CandidateOrigin, MirrorSource};

/// A MAP-Elites search in progress. Everything it will do follows from the declaration, the seed and its state.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    evolution: Evolution,
    recodings: Vec<Recoding>,
    archive: Archive,
    seed: u64,
    generation: u32,
    counts: Counts,
    mirrors: Vec<MirrorSource>,
    proposal: Proposal,
}

#[derive(Clone, Debug, PartialEq)]
enum Proposal {
    Declared,
    /// Neighbors of elites; while there are none, those of a body, or random ones.
    Neighbors(Option<Body>),
}

#[derive(Clone, Debug, PartialEq)]
pub struct SearchState {
    pub seed: u64,
    pub generation: u32,
    pub counts: Counts,
    pub mirrors: Vec<MirrorSource>,
    pub niches: Vec<(NicheKey, Vec<Elite>)>,
}

impl SearchState {
    /// Whether a run can reach this state: every body is what its network develops into, is valid, and is in its niche.
    pub fn fits(&self, evolution: &Evolution) -> bool {
        let Evolution { genome, palette, rules, width, height, .. } = evolution;
        let descriptor = Descriptor::new(evolution);
        let is_foreign =
            |kind| matches!(kind, NodeKind::Output(code, _) if usize::from(code) > palette.materials().len());
        let develops = |genotype: &Genotype| match genotype.nodes.iter().any(|&(_, kind)| is_foreign(kind)) {
            true => None,
            false => develop(genotype, palette, *rules, *width, *height).ok(),
        };
        let is_voxels = |body: &Body| {
            (body.width(), body.height(), body.palette()) == (*width, *height, palette) && validate(body).is_ok()
        };
        let is_body = |elite: &Elite| match (genome, &elite.genotype) {
            (Genome::Cppn, Some(genotype)) => develops(genotype).as_ref() == Some(&elite.body),
            (Genome::Voxels { .. }, None) => is_voxels(&elite.body),
            _ => false,
        };
        let is_mirror = |mirror: &MirrorSource| match (genome, mirror) {
            (Genome::Cppn, MirrorSource::Network(genotype)) => develops(genotype).is_some(),
            (Genome::Voxels { .. }, MirrorSource::Voxels(body)) => is_voxels(body),
            _ => false,
        };
        let holds =
            |key: &NicheKey, elite: &Elite| is_body(elite) && descriptor.niche(&elite.body, elite.behavior) == *key;
        self.mirrors.iter().all(is_mirror)
            && self.niches.iter().all(|(key, elites)| elites.iter().all(|elite| holds(key, elite)))
    }
}

impl Search {
    pub fn new(evolution: &Evolution, seed: u64) -> Self {
        Self {
            evolution: evolution.clone(),
            recodings: match evolution.symmetry {
                Symmetry::None => Vec::new(),
                Symmetry::Npn => recodings(&evolution.palette),
            },
            archive: Archive::new(evolution),
            seed,
            generation: 0,
            counts: Counts::default(),
            mirrors: Vec::new(),
            proposal: Proposal::Declared,
        }
    }

    /// A search that draws neighbors of its elites, and at first of `start`, instead of the bodies of its declaration.
    pub fn around(evolution: &Evolution, start: Option<Body>, seed: u64) -> Self {
        Self { proposal: Proposal::Neighbors(start), ..Self::new(evolution, seed) }
    }

    pub fn resume(evolution: &Evolution, state: SearchState) -> Self {
        Self {
            archive: Archive::with_niches(evolution, state.niches),
            generation: state.generation,
            counts: state.counts,
            mirrors: state.mirrors,
            ..Self::new(evolution, state.seed)
        }
    }

    pub fn state(&self) -> SearchState {
        SearchState {
            seed: self.seed,
            generation: self.generation,
            counts: self.counts,
            mirrors: self.mirrors.clone(),
            niches: self.archive.niches().map(|(key, elites)| (key.clone(), elites.to_vec())).collect(),
        }
    }

    pub fn evolution(&self) -> &Evolution {
        &self.evolution
    }

    pub fn archive(&self) -> &Archive {
        &self.archive
    }

    pub fn seed(&self) -> u64 {
        self.seed
    }

    pub fn generation(&self) -> u32 {
        self.generation
    }

    pub fn counts(&self) -> Counts {
        self.counts
    }

    pub fn is_done(&self) -> bool {
        self.generation >= self.evolution.generations
    }

    /// Calling it twice returns the same candidates.
    pub fn ask(&self) -> Vec<Candidate> {
        if let Proposal::Neighbors(start) = &self.proposal {
            return self.neighbors(start.as_ref());
        }
        let parents = self.parents();
        let fresh = if parents.is_empty() { self.evolution.batch } else { 0 } + self.evolution.newcomers;
        let offspring = parents.iter().map(|(key, elite)| (CandidateOrigin::Offspring((*key).clone()), Some(*elite)));
        let newcomers = std::iter::repeat_n((CandidateOrigin::Random, None), fresh);
        let mut candidates: Vec<Candidate> = Vec::new();
        for (index, (origin, parent)) in (0..).zip(offspring.chain(newcomers)) {
            candidates.extend(self.draw(index, origin, parent));
        }
        if self.generation == 0 {
            let first = self.first_bodies().into_iter();
            candidates.extend(first.map(|body| Candidate::of_voxels(CandidateOrigin::Start, body)));
        }
        candidates.extend(self.mirrors.iter().map(|source| self.mirror(source)));
        candidates
    }

    /// In their order. Panics when there is not one outcome for each candidate.
    pub fn tell(&mut self, candidates: &[Candidate], outcomes: &[CandidateOutcome]) {
        assert_eq!(candidates.len(), outcomes.len(), "each candidate has one outcome");
        self.mirrors.clear();
        self.generation += 1;
        for (candidate, outcome) in candidates.iter().zip(outcomes) {
            self.counts.evaluations += 1;
            self.counts.undeveloped += u64::from(candidate.undeveloped);
            match outcome {
                CandidateOutcome::Measured(scores) => self.take(candidate, scores),
                CandidateOutcome::Surpassed => self.counts.surpassed += 1,
                CandidateOutcome::Inconsistent => self.counts.inconsistent += 1,
                CandidateOutcome::Faulty(_) => self.counts.faults += 1,
            }
        }
    }

    pub fn rivals(&self, body: &Body) -> Rivals {
        let images: Vec<(Option<&Recoding>, Body)> = match self.recodings.as_slice() {
            [] => vec![(None, body.clone())],
            recodings => recodings.iter().map(|recoding| (Some(recoding), recoding.body(body))).collect(),
        };
        let in_niche = |behavior: Behavior, (recoding, image): &(Option<&Recoding>, Body)| {
            let shown = recoding.map_or(behavior, |recoding| recoding.behavior(behavior));
            self.archive.fitnesses(image, shown)
        };
        let niches = |behavior| images.iter().map(|image| in_niche(behavior, image)).collect();
        Rivals::new(self.archive.niche(), Behavior::all(self.evolution.palette.inputs()).map(niches).collect())
    }

    /// The displacements that a candidate probably has: those of the oldest elite of its parent's niche.
    pub fn expected(&self, candidate: &Candidate) -> Option<Displacements> {
        let CandidateOrigin::Offspring(key) = &candidate.origin else { return None };
        Some(self.archive.elites_of(key).first()?.displacement)
    }

    fn take(&mut self, candidate: &Candidate, scores: &Scores) {
        let elite = Elite {
            fitness: scores.fitness,
            behavior: scores.behavior,
            displacement: scores.displacement,
            body: candidate.body.clone(),
            genotype: candidate.genotype.clone(),
            generation: self.generation,
            evaluations: self.counts.evaluations,
        };
        let taken = self.offer(elite);
        if taken && self.evolution.symmetry == Symmetry::Npn && candidate.origin != CandidateOrigin::Mirror {
            self.mirrors.push(match &candidate.genotype {
                Some(genotype) => MirrorSource::Network(mirrored(genotype)),
                None => MirrorSource::Voxels(candidate.body.mirrored()),
            });
        }
    }

    fn offer(&mut self, elite: Elite) -> bool {
        let images: Vec<Elite> = match self.recodings.as_slice() {
            [] => vec![elite],
            recodings => recodings.iter().map(|recoding| image(recoding, &elite)).collect(),
        };
        let mut taken = false;
        for image in images {
            let status = self.archive.add(image);
            self.counts.new += u64::from(status == AddStatus::New);
            self.counts.improved += u64::from(status == AddStatus::Improved);
            taken |= status != AddStatus::Rejected;
        }
        taken
    }

    fn first_bodies(&self) -> Vec<Body> {
        let rows = self.evolution.start.iter().flat_map(|start| &start.bodies);
        let bodies = rows.filter_map(|rows| Body::parse(rows, &self.evolution.palette).ok());
        bodies.filter(|body| validate(body).is_ok()).collect()
    }

    fn parents(&self) -> Vec<(&NicheKey, &Elite)> {
        let mut rng = self.stream(u32::MAX);
        let mut niches: Vec<_> = self.archive.niches().collect();
        let wanted = self.evolution.batch.min(niches.len());
        let mut parents = Vec::with_capacity(wanted);
        while parents.len() < wanted {
            let Some(at) = pick(niches.len(), &mut rng) else { break };
            let (key, elites) = niches.remove(at);
            parents.extend(pick(elites.len(), &mut rng).map(|at| (key, &elites[at])));
        }
        parents
    }

    fn stream(&self, index: u32) -> ChaCha8Rng {
        stream(self.seed, self.generation, index)
    }
}

pub fn stream(seed: u64, generation: u32, index: u32) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(u64::from(generation) << 32 | u64::from(index));
    rng
}

/// The first of each behavior of its class, the elite itself first. Mirrored ones move nearly as their originals do.
pub fn images(elite: &Elite) -> Vec<Elite> {
    let mirrored = Elite {
        behavior: elite.behavior.function().inverted().into(),
        displacement: Displacements::under(elite.behavior.stimuli(), |pattern| -elite.displacement.at(pattern)),
        body: elite.body.mirrored(),
        genotype: elite.genotype.as_ref().map(mirrored),
        ..elite.clone()
    };
    let recodings = recodings(elite.body.palette());
    let mut images: Vec<Elite> = Vec::new();
    for image in [elite, &mirrored].iter().flat_map(|one| recodings.iter().map(|recoding| image(recoding, one))) {
        if images.iter().all(|known| known.behavior != image.behavior) {
            images.push(image);
        }
    }
    images
}

fn image(recoding: &Recoding, elite: &Elite) -> Elite {
    if recoding.is_identity() {
        return elite.clone();
    }
    Elite {
        behavior: recoding.behavior(elite.behavior),
        displacement: recoding.displacement(&elite.displacement),
        body: recoding.body(&elite.body),
        genotype: elite.genotype.as_ref().map(|genotype| recoding.genotype(genotype)),
        ..elite.clone()
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::evolve::phenotype;
    use nbc_base::model::{
        Axis, Count, ImageOrder, MutationWeights, Niche, Palette, Pattern, PhysicsWorld, Rules, Schedule,
        SearchObjective, Spell,
    };

    pub(crate) fn evolution() -> Evolution {
        let spells = Pattern::PAIRS.map(|pattern| Spell::of(pattern, 840)).to_vec();
        let count = |of| Axis::Count { of, bins: 4 };
        Evolution {
            name: "gates".to_owned(),
            width: 5,
            height: 5,
            palette: Palette::paper(),
            genome: Genome::Cppn,
            start: None,
            mutation: MutationWeights::default(),
            variable: Schedule { spells },
            shown: ImageOrder::Apart,
            fixed_steps: 840,
            descriptors: vec![count(Count::Voxels), count(Count::Active), count(Count::Sensory), Axis::Behavior],
            batch: 16,
            newcomers: 0,
            generations: 30,
            seeds: vec![1],
            rules: Rules::PAPER,
            objective: SearchObjective::Distance,
            behaviors: Vec::new(),
            symmetry: Symmetry::None,
            niche: Niche::Dominance,
            world: PhysicsWorld::default(),
            sample: None,
        }
    }

    pub(crate) fn outcome(body: &Body) -> CandidateOutcome {
        let weight = |k: usize| {
            body.codes().iter().enumerate().map(|(i, &c)| ((i * k + 3) % 7 * usize::from(c)) as f64).sum::<f64>()
        };
        let displacement = [1, 2, 3, 5].map(|k| weight(k) % 11.0 - 5.0);
        let fitness =
            [displacement.iter().map(|d| d.abs()).sum(), displacement.iter().map(|d| d.abs()).fold(9.0, f64::min)];
        let displacement = Displacements::try_from(displacement.to_vec()).unwrap();
        CandidateOutcome::Measured(Scores { fitness, behavior: displacement.behavior(), displacement })
    }

    fn advance(search: &mut Search) {
        let candidates = search.ask();
        let outcomes: Vec<CandidateOutcome> = candidates.iter().map(|candidate| outcome(&candidate.body)).collect();
        search.tell(&candidates, &outcomes);
    }

    #[test]
    fn every_candidate_is_valid_and_differs_from_its_parent() {
        let mut search = Search::new(&evolution(), 1);
        for _ in 0..20 {
            for candidate in search.ask() {
                assert_eq!(validate(&candidate.body), Ok(()));
                if let CandidateOrigin::Offspring(key) = &candidate.origin {
                    let (_, elites) = search.archive().niches().find(|(niche, _)| *niche == key).unwrap();
                    assert_ne!(elites[0].body, candidate.body);
                }
            }
            advance(&mut search);
        }
        assert!(search.archive().stats().filled > 16, "the search finds its way");
    }

    #[test]
    fn offspring_of_voxels_differ_in_few_voxels_or_have_a_second_parent() {
        let run = |crossover| {
            let evolution = Evolution { genome: Genome::Voxels { crossover }, ..evolution() };
            let mut search = Search::new(&evolution, 1);
            let mut most = 0;
            for _ in 0..20 {
                for candidate in search.ask() {
                    assert_eq!((validate(&candidate.body), &candidate.genotype), (Ok(()), &None));
                    let CandidateOrigin::Offspring(key) = &candidate.origin else { continue };
                    let (_, elites) = search.archive().niches().find(|(niche, _)| *niche == key).unwrap();
                    let pairs = elites[0].body.codes().iter().zip(candidate.body.codes());
                    most = most.max(pairs.filter(|(a, b)| a != b).count());
                }
                advance(&mut search);
            }
            assert!(search.archive().stats().filled > 16 && search.state().fits(search.evolution()));
            most
        };
        assert_eq!(run(0.0), 3);
        assert!(run(0.5) > 8);
    }

    #[test]
    fn equal_seeds_give_equal_searches_and_different_seeds_different_ones() {
        let run = |seed| {
            let mut search = Search::new(&evolution(), seed);
            (0..15).for_each(|_| advance(&mut search));
            search
        };
        assert_eq!(run(1), run(1));
        assert_ne!(run(1).archive(), run(2).archive());
    }

    #[test]
    fn a_resumed_search_continues_exactly() {
        let voxels = Genome::Voxels { crossover: 0.5 };
        for (symmetry, genome) in
            [(Symmetry::None, Genome::Cppn), (Symmetry::Npn, Genome::Cppn), (Symmetry::Npn, voxels)]
        {
            let evolution = Evolution { symmetry, genome, rules: Rules::CODE, ..evolution() };
            let mut straight = Search::new(&evolution, 7);
            (0..12).for_each(|_| advance(&mut straight));
            let mut resumed = Search::resume(&evolution, straight.state());
            for search in [&mut straight, &mut resumed] {
                (0..12).for_each(|_| advance(search));
            }
            assert_eq!(straight, resumed);
        }
    }

    #[test]
    fn an_impossible_state_is_rejected() {
        let evolution = Evolution { symmetry: Symmetry::Npn, ..evolution() };
        let mut search = Search::new(&evolution, 3);
        (0..4).for_each(|_| advance(&mut search));
        let state = search.state();
        assert!(state.fits(&evolution));
        let check = |change: fn(&mut SearchState)| {
            let mut changed = state.clone();
            change(&mut changed);
            assert!(!changed.fits(&evolution));
        };
        check(|state| state.niches[0].0.0[0] += 1);
        check(|state| state.niches[0].1[0].body = Body::new(5, 5, vec![3; 25], Palette::paper()));
        check(|state| state.niches[0].1[0].genotype.as_mut().unwrap().links.clear());
        check(|state| state.niches[0].1[0].genotype = None);
        check(|state| state.mirrors[0] = MirrorSource::Voxels(state.niches[0].1[0].body.clone()));
        let poorer = Arc::new(Palette::new(Palette::paper().materials()[..4].to_vec()));
        assert!(!state.fits(&Evolution { palette: poorer, ..evolution.clone() }));
    }

    #[test]
    fn a_state_of_the_other_genome_is_rejected() {
        let voxels = Evolution { genome: Genome::Voxels { crossover: 0.0 }, symmetry: Symmetry::Npn, ..evolution() };
        let mut search = Search::new(&voxels, 3);
        (0..4).for_each(|_| advance(&mut search));
        let state = search.state();
        assert!(state.fits(&voxels) && !state.mirrors.is_empty());
        assert!(!state.fits(&Evolution { genome: Genome::Cppn, ..voxels.clone() }));
        let apart = Body::parse(&["33303", "00000", "00000", "00000", "00000"], &Palette::paper()).unwrap();
        let small = Body::parse(&["333"], &Palette::paper()).unwrap();
        for body in [apart, small] {
            let mut changed = state.clone();
            changed.mirrors[0] = MirrorSource::Voxels(body);
            assert!(!changed.fits(&voxels));
        }
    }

    #[test]
    fn images_enter_the_niches_of_their_class_and_develop_from_their_networks() {
        let mut search = Search::new(&Evolution { symmetry: Symmetry::Npn, ..evolution() }, 3);
        (0..6).for_each(|_| advance(&mut search));
        for elite in search.archive().elites() {
            assert_eq!(phenotype(elite.genotype.as_ref().unwrap(), &Palette::paper(), Rules::PAPER, 5, 5), elite.body);
            for recoding in recodings(&Palette::paper()) {
                let (body, behavior) = (recoding.body(&elite.body), recoding.behavior(elite.behavior));
                let held = !search.rivals(&body).admit(behavior, &elite.fitness);
                assert!(held, "the image's niche holds something as good");
            }
        }
        assert!(search.ask().iter().any(|candidate| candidate.origin == CandidateOrigin::Mirror));
    }

    #[test]
    fn a_palette_that_cannot_walk_ends_the_search_without_candidates() {
        let palette = Arc::new(Palette::new(Palette::paper().materials()[..2].to_vec()));
        let search = Search::new(&Evolution { palette, batch: 1, width: 2, height: 2, ..evolution() }, 1);
        assert!(search.ask().is_empty());
    }
}
