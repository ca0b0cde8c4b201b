//! The archive of elites over niches (paper, Methods: MAP-Elites), with replacement by dominance in both fitnesses.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::evolve::rivals::{exceeds, reaches};
use crate::evolve::{Descriptor, NicheKey};
use nbc_base::model::{Behavior, Body, Displacements, Evolution, Genotype, Niche};

#[derive(Clone, Debug, PartialEq)]
pub struct Elite {
    pub fitness: [f64; 2],
    pub behavior: Behavior,
    /// Displacement in voxels over the fixed simulations, one for each pattern.
    pub displacement: Displacements,
    pub body: Body,
    pub genotype: Option<Genotype>,
    pub generation: u32,
    /// Evaluations made in the run up to and with its own.
    pub evaluations: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum AddStatus {
    /// The elites of the niche are better, or at least as good in both fitnesses.
    Rejected,
    /// It replaced the elites it dominates, or joined a Pareto set.
    Improved,
    New,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Champion {
    pub behavior: Behavior,
    pub fitness: [f64; 2],
    pub niches: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArchiveStats {
    pub filled: usize,
    pub niches: usize,
    pub coverage: f64,
    /// Sum over filled niches of the best first fitness.
    pub qd_score: f64,
    /// The best of each behavior found, in order of the functions' bits.
    pub champions: Vec<Champion>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Archive {
    descriptor: Descriptor,
    niche: Niche,
    niches: BTreeMap<NicheKey, Vec<Elite>>,
}

impl Archive {
    pub fn new(evolution: &Evolution) -> Self {
        Self { descriptor: Descriptor::new(evolution), niche: evolution.niche, niches: BTreeMap::new() }
    }

    pub fn with_niches(evolution: &Evolution, niches: Vec<(NicheKey, Vec<Elite>)>) -> Self {
        let niches = niches.into_iter().filter(|(_, elites)| !elites.is_empty()).collect();
        Self { niches, ..Self::new(evolution) }
    }

    /// The filled niches in order of their keys.
    pub fn niches(&self) -> impl ExactSizeIterator<Item = (&NicheKey, &[Elite])> {
        self.niches.iter().map(|(key, elites)| (key, elites.as_slice()))
    }

    pub fn elites_of(&self, key: &NicheKey) -> &[Elite] {
        self.niches.get(key).map_or(&[], Vec::as_slice)
    }

    pub fn elites(&self) -> impl Iterator<Item = &Elite> {
        self.niches.values().flatten()
    }

    pub fn is_empty(&self) -> bool {
        self.niches.is_empty()
    }

    pub fn add(&mut self, elite: Elite) -> AddStatus {
        let key = self.descriptor.niche(&elite.body, elite.behavior);
        let Some(elites) = self.niches.get_mut(&key) else {
            self.niches.insert(key, vec![elite]);
            return AddStatus::New;
        };
        let before = elites.len();
        let room = match self.niche {
            Niche::Dominance => {
                elites.retain(|there| !exceeds(&elite.fitness, &there.fitness));
                elites.is_empty()
            }
            Niche::Pareto(_) if elites.iter().any(|there| reaches(&there.fitness, &elite.fitness)) => false,
            Niche::Pareto(most) => {
                elites.retain(|there| !reaches(&elite.fitness, &there.fitness));
                elites.len() < before || before < most.max(1)
            }
        };
        if room {
            elites.push(elite);
            AddStatus::Improved
        } else {
            AddStatus::Rejected
        }
    }

    /// A body that these keep out now is kept out later too: elites are only replaced by bodies that dominate them.
    pub fn fitnesses(&self, body: &Body, behavior: Behavior) -> Vec<[f64; 2]> {
        let elites = self.niches.get(&self.descriptor.niche(body, behavior));
        elites.into_iter().flatten().map(|elite| elite.fitness).collect()
    }

    pub fn niche(&self) -> Niche {
        self.niche
    }

    pub fn stats(&self) -> ArchiveStats {
        let best = |elites: &[Elite]| elites.iter().map(|elite| elite.fitness[0]).fold(f64::NEG_INFINITY, f64::max);
        let (filled, niches) = (self.niches.len(), self.descriptor.niches());
        ArchiveStats {
            filled,
            niches,
            coverage: filled as f64 / niches as f64,
            qd_score: self.niches.values().map(|elites| best(elites)).sum(),
            champions: Behavior::all(self.descriptor.inputs()).filter_map(|behavior| self.champion(behavior)).collect(),
        }
    }

    fn champion(&self, behavior: Behavior) -> Option<Champion> {
        let best = self.best(behavior)?;
        let holds = |elites: &&Vec<Elite>| elites.iter().any(|elite| elite.behavior == behavior);
        Some(Champion { behavior, fitness: best.fitness, niches: self.niches.values().filter(holds).count() })
    }

    /// The elite of a behavior whose first fitness is highest; the first of equals.
    pub fn best(&self, behavior: Behavior) -> Option<&Elite> {
        let mut best: Option<&Elite> = None;
        for elite in self.elites().filter(|elite| elite.behavior == behavior) {
            if best.is_none_or(|best| elite.fitness[0] > best.fitness[0]) {
                best = Some(elite);
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::evolve::Rivals;
    use crate::evolve::search::tests::evolution;

    fn elite(voxels: usize, behavior: u8, fitness: [f64; 2]) -> Elite {
        let codes = (0..25).map(|place| if place < voxels { 3 } else { 0 }).collect();
        Elite {
            fitness,
            behavior: nbc_base::model::Function::new(behavior).into(),
            displacement: Displacements::zero(2),
            body: Body::new(5, 5, codes, nbc_base::model::Palette::paper()),
            genotype: None,
            generation: 0,
            evaluations: 0,
        }
    }

    fn archive(niche: Niche) -> Archive {
        Archive::new(&Evolution { niche, ..evolution() })
    }

    fn check(niche: Niche, offers: &[([f64; 2], AddStatus)]) {
        let mut archive = archive(niche);
        for &(fitness, expected) in offers {
            assert_eq!(archive.add(elite(5, 7, fitness)), expected, "{fitness:?}");
        }
    }

    #[test]
    fn elites_are_replaced_by_dominance_or_kept_as_trade_offs() {
        use AddStatus::{Improved, New, Rejected};
        let offers = [([1.0, 1.0], New), ([2.0, 1.0], Rejected), ([1.0, 1.0], Rejected), ([1.5, 1.5], Improved)];
        check(Niche::Dominance, &offers);
        let offers = [([1.0, 1.0], New), ([2.0, 0.5], Improved), ([3.0, 0.2], Rejected), ([1.0, 1.0], Rejected)];
        check(Niche::Pareto(2), &[&offers[..], &[([2.0, 1.0], Improved), ([3.0, 0.2], Improved)]].concat());
    }

    fn offers() -> impl Strategy<Value = Vec<(usize, u8, [f64; 2])>> {
        let fitness = prop::array::uniform2((0..6u8).prop_map(f64::from));
        prop::collection::vec((3..25usize, 0..4u8, fitness), 1..120)
    }

    proptest! {
        #[test]
        fn coverage_never_decreases_and_only_dominating_bodies_replace_elites(offers in offers(), most in 0..5usize) {
            let niche = if most == 0 { Niche::Dominance } else { Niche::Pareto(most) };
            let mut archive = archive(niche);
            for (voxels, behavior, fitness) in offers {
                let before = archive.clone();
                let offered = elite(voxels, behavior, fitness);
                let rivals = vec![archive.fitnesses(&offered.body, offered.behavior)];
                let could = Rivals::new(niche, vec![rivals; 16]).admit(offered.behavior, &fitness);
                let status = archive.add(elite(voxels, behavior, fitness));
                prop_assert!(could || status == AddStatus::Rejected, "what cannot be taken is not");
                prop_assert!(archive.stats().filled >= before.stats().filled);
                prop_assert!(archive.stats().qd_score >= before.stats().qd_score);
                for (key, elites) in before.niches() {
                    let now = &archive.niches[key];
                    prop_assert!(now.len() <= most.max(1));
                    for lost in elites.iter().filter(|there| !now.contains(there)) {
                        prop_assert!(reaches(&fitness, &lost.fitness) && fitness != lost.fitness);
                        prop_assert!(niche != Niche::Dominance || exceeds(&fitness, &lost.fitness));
                    }
                }
            }
        }
    }
}
