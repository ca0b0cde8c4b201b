//! A search for gates while it runs.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

/// The niches of an archive that have changed in a generation.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ArchiveChange {
    pub(crate) id: u64,
    pub(crate) generation: u32,
    pub(crate) axes: Vec<AxisEntry>,
    pub(crate) niches: Vec<NicheEntry>,
    pub(crate) evaluations: u64,
}

/// The name of an axis and its number of bins.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct AxisEntry(pub(crate) &'static str, pub(crate) usize);

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct NicheEntry {
    /// The bin on each axis.
    pub(crate) place: Vec<u16>,
    pub(crate) fitness: [f64; 2],
    pub(crate) body: Vec<String>,
    pub(crate) letters: String,
    pub(crate) function: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct EvolutionEnd {
    pub(crate) generations: u32,
    pub(crate) evaluations: u64,
}
