//! The state of a search as data, without what follows from the declaration; bodies are rows of codes.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::wording;
use nbc_base::model::{Axis, Behavior, Body, Displacements, Evolution, Genotype, Palette};
use nbc_swarm::evolve::{Counts, Elite, MirrorSource, NicheKey, SearchState};

/// The most bins of an axis that can be declared.
const MAX_BINS: usize = 1000;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SearchRecord {
    seed: u64,
    generation: u32,
    counts: Counts,
    mirrors: Vec<Genotype>,
    /// The mirror images of bodies that no network develops into.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    mirror_bodies: Vec<Vec<String>>,
    niches: Vec<(NicheKey, Vec<EliteRecord>)>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct EliteRecord {
    fitness: [f64; 2],
    behavior: Behavior,
    displacement: Displacements,
    body: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    genotype: Option<Genotype>,
    generation: u32,
    evaluations: u64,
}

impl SearchRecord {
    pub(super) fn of(state: SearchState) -> Self {
        let SearchState { seed, generation, counts, mirrors, niches } = state;
        let record = |elites: Vec<Elite>| elites.into_iter().map(EliteRecord::of).collect();
        let niches = niches.into_iter().map(|(key, elites)| (key, record(elites))).collect();
        let (mut networks, mut bodies) = (Vec::new(), Vec::new());
        for mirror in mirrors {
            match mirror {
                MirrorSource::Network(genotype) => networks.push(genotype),
                MirrorSource::Voxels(body) => bodies.push(body.rows()),
            }
        }
        Self { seed, generation, counts, mirrors: networks, mirror_bodies: bodies, niches }
    }

    pub(super) fn into_state(self, declared: &Evolution) -> Result<SearchState, String> {
        let Self { seed, generation, counts, mirrors, mirror_bodies, niches } = self;
        let bins = declared
            .descriptors
            .iter()
            .filter_map(|axis| if let Axis::Count { bins, .. } = *axis { Some(bins) } else { None });
        if let Some(bins) = bins.into_iter().find(|bins| !(1..=MAX_BINS).contains(bins)) {
            return Err(wording::axis_bins(bins, MAX_BINS));
        }
        let niche = |(key, elites): (NicheKey, Vec<EliteRecord>)| {
            if !is_niche(&key, &declared.descriptors, declared.palette.inputs()) {
                return Err(wording::no_niche(&key.0));
            }
            let elites = elites.into_iter().map(|elite| elite.into_elite(&declared.palette));
            Ok((key, elites.collect::<Result<Vec<_>, _>>()?))
        };
        let niches = niches.into_iter().map(niche).collect::<Result<_, String>>()?;
        let body = |rows: Vec<String>| {
            Body::parse(&rows, &declared.palette).map(MirrorSource::Voxels).map_err(|error| wording::elite_body(&error))
        };
        let networks = mirrors.into_iter().map(|genotype| Ok(MirrorSource::Network(genotype)));
        let mirrors = networks.chain(mirror_bodies.into_iter().map(body)).collect::<Result<_, String>>()?;
        Ok(SearchState { seed, generation, counts, mirrors, niches })
    }
}

fn is_niche(key: &NicheKey, axes: &[Axis], inputs: usize) -> bool {
    let bins = |axis: &Axis| match axis {
        Axis::Count { .. } | Axis::Behavior => axis.bins(inputs),
        // A class has the number of one of its behaviors.
        Axis::Class => Axis::Behavior.bins(inputs),
    };
    key.0.len() == axes.len() && key.0.iter().zip(axes).all(|(&bin, axis)| usize::from(bin) < bins(axis))
}

impl EliteRecord {
    fn of(elite: Elite) -> Self {
        let Elite { fitness, behavior, displacement, body, genotype, generation, evaluations } = elite;
        Self { fitness, behavior, displacement, body: body.rows(), genotype, generation, evaluations }
    }

    fn into_elite(self, palette: &Arc<Palette>) -> Result<Elite, String> {
        let Self { fitness, behavior, displacement, body, genotype, generation, evaluations } = self;
        let body = Body::parse(&body, palette).map_err(|error| wording::elite_body(&error))?;
        if behavior.stimuli() != palette.inputs() || displacement.len() != 1 << palette.inputs() {
            return Err(wording::elite_stimuli(behavior, palette.inputs()));
        }
        Ok(Elite { fitness, behavior, displacement, body, genotype, generation, evaluations })
    }
}
