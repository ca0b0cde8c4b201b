//! Evolution of bodies: networks, their mutation and development, an archive of elites, and an ask/tell search. It
//! knows no physics.

mod archive;
pub mod cppn;
mod descriptor;
mod develop;
mod mutate;
mod neighbors;
mod outcome;
mod rivals;
mod search;
mod symmetry;
mod wording;

pub use archive::{AddStatus, Archive, ArchiveStats, Champion, Elite};
pub use descriptor::{Descriptor, NicheKey};
pub use develop::{develop, phenotype, validate};
pub use mutate::mutate;
pub use outcome::{CandidateOutcome, Counts, Scores};
pub use rivals::Rivals;
#[cfg(test)]
pub(crate) use search::tests;
pub use search::{Candidate, CandidateOrigin, MirrorSource, Search, SearchState, images, stream};
pub use symmetry::{Recoding, mirrored, recodings};
pub use wording::Undeveloped;
