//! Checkpoints of evolution runs: a line with format and checksum, then the declaration and the state as JSON.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::declared::Declared;
use crate::disk::read;
use crate::first_checkpoint::FirstRecord;
use crate::search_state::SearchRecord as StateRecord;
use crate::wording::{CheckpointError, StateError};
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Evolution;
use nbc_base::source::FileError;
use nbc_swarm::evolve::{Search, SearchState};

/// The checkpoint version that this program writes; it also reads earlier ones.
const FORMAT: &str = "2";
/// The first bytes of checkpoints of any version.
const MAGIC: &str = "nbc-checkpoint";

/// The contents of a checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// The version of the program that wrote it.
    pub version: String,
    /// The declaration of its run.
    pub declared: Declared,
    /// The search.
    pub state: SearchState,
    /// Env steps simulated so far.
    pub env_steps: u64,
    /// Env steps left out so far.
    pub left_out: u64,
}

/// The part of a checkpoint after its header.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    version: String,
    evolution: Evolution,
    state: StateRecord,
    env_steps: u64,
    left_out: u64,
}

impl Checkpoint {
    /// The bytes of a search's checkpoint file, with the env steps simulated and left out so far.
    pub fn print(search: &Search, env_steps: u64, left_out: u64) -> Vec<u8> {
        let record = Record {
            version: nbc_base::VERSION.to_owned(),
            evolution: search.evolution().clone(),
            state: StateRecord::of(search.state()),
            env_steps,
            left_out,
        };
        framed(MAGIC, FORMAT, &serde_json::to_string(&record).expect("a search can be written as JSON"))
    }

    /// Reads the checkpoint file at `path`; `None` if there is no such file.
    pub fn open(path: &Path) -> Result<Option<Self>, Diagnostic> {
        let name = path.display().to_string();
        match read(path, Limit::CheckpointBytes.most()) {
            Ok(bytes) => Self::read(&name, &bytes).map(Some),
            Err(FileError::NotFound) => Ok(None),
            Err(error) => Err(Diagnostic::unreadable(&name, &error)),
        }
    }

    /// Reads the bytes of a checkpoint file called `name`.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, Diagnostic> {
        Self::read_bytes(bytes).map_err(|error| error.of(name))
    }

    fn read_bytes(bytes: &[u8]) -> Result<Self, CheckpointError> {
        let (format, text) = unframed(MAGIC, bytes)?;
        let read = match format {
            "1" => read_first,
            FORMAT => read_record,
            _ => return Err(CheckpointError::Format { found: format.to_owned(), expected: FORMAT }),
        };
        let text = text?;
        read(text).map_err(CheckpointError::Unreadable)
    }

    /// The search as it was, for the declaration it was made by.
    pub fn resume(self, name: &str, evolution: &Evolution, seed: u64) -> Result<Search, Diagnostic> {
        let declared = || evolution.name.clone();
        let error = if self.state.seed != seed {
            CheckpointError::OtherSeed { found: self.state.seed, expected: seed }
        } else if !self.declared.fits(evolution) {
            CheckpointError::Changed { evolution: declared() }
        } else if !self.state.fits(evolution) {
            CheckpointError::OtherEvolution { evolution: declared() }
        } else {
            return Ok(Search::resume(evolution, self.state));
        };
        Err(error.of(name))
    }
}

/// A text with a header: the kind of the file, its format, a checksum and the length.
pub(super) fn framed(magic: &str, format: &str, text: &str) -> Vec<u8> {
    format!("{magic} {format} {:08x} {}\n{text}\n", crc32fast::hash(text.as_bytes()), text.len()).into_bytes()
}

/// The format of a file with such a header, and its text, or that it is damaged.
pub(super) fn unframed<'b>(
    magic: &str,
    bytes: &'b [u8],
) -> Result<(&'b str, Result<&'b [u8], CheckpointError>), CheckpointError> {
    let none = CheckpointError::NotACheckpoint;
    let end = bytes.iter().take(MAX_HEADER).position(|&byte| byte == b'\n');
    let Some((header, rest)) = end.map(|end| (&bytes[..end], &bytes[end + 1..])) else { return Err(none) };
    let Ok(header) = std::str::from_utf8(header) else { return Err(none) };
    let words: Vec<&'b str> = header.split(' ').collect();
    let [kind, format, checksum, length] = words[..] else { return Err(none) };
    if kind != magic {
        return Err(none);
    }
    let text = length.parse().ok().and_then(|length: usize| rest.get(..length));
    let whole =
        text.filter(|text| rest[text.len()..] == *b"\n" && format!("{:08x}", crc32fast::hash(text)) == checksum);
    Ok((format, whole.ok_or(CheckpointError::Damaged)))
}

/// The longest header in bytes, so that a large file that is not a checkpoint is rejected at once.
const MAX_HEADER: usize = 100;

/// Reads the part after the header of format 1.
fn read_first(text: &[u8]) -> Result<Checkpoint, StateError> {
    let record: FirstRecord = serde_json::from_slice(text)?;
    let declared = record.declared().ok_or(StateError::NoMaterials)?;
    let FirstRecord { version, state, env_steps, left_out, .. } = record;
    let state = state.into_state(&declared)?;
    Ok(Checkpoint { version, declared, state, env_steps, left_out })
}

/// Reads the part after the header of format 2.
fn read_record(text: &[u8]) -> Result<Checkpoint, StateError> {
    let Record { version, evolution, state, env_steps, left_out } = serde_json::from_slice(text)?;
    let declared = Declared::of(evolution);
    let state = state.into_state(&declared)?;
    Ok(Checkpoint { version, declared, state, env_steps, left_out })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::{
        Axis, Behavior, Count, Genome, ImageOrder, MutationWeights, Niche, Palette, PhysicsWorld, Rules, Schedule,
        SearchObjective, Symmetry,
    };
    use nbc_swarm::evolve::{CandidateOutcome, Scores};

    fn evolution() -> Evolution {
        Evolution {
            name: "small".to_owned(),
            width: 4,
            height: 3,
            palette: Palette::paper(),
            genome: Genome::Cppn,
            start: None,
            mutation: MutationWeights::default(),
            variable: Schedule::default(),
            shown: ImageOrder::Apart,
            fixed_steps: 84,
            descriptors: vec![Axis::Count { of: Count::Voxels, bins: 4 }, Axis::Behavior],
            batch: 8,
            newcomers: 1,
            generations: 5,
            seeds: vec![1],
            rules: Rules::PAPER,
            objective: SearchObjective::Distance,
            behaviors: Vec::new(),
            symmetry: Symmetry::Npn,
            niche: Niche::Pareto(3),
            world: PhysicsWorld::default(),
            sample: None,
        }
    }

    fn search() -> Search {
        search_of(&evolution(), 5)
    }

    fn search_of(evolution: &Evolution, generations: usize) -> Search {
        let mut search = Search::new(evolution, 1);
        for generation in 0..generations {
            let candidates = search.ask();
            let scores = |i: usize| Scores {
                fitness: [0.1 * i as f64, 1.0 / (i + generation + 1) as f64],
                behavior: Behavior::of(&[1.0, -1.0, i as f64 - 3.0, 1.0]),
                displacement: vec![0.1 + 0.2, 1e-300, -1.0 / 3.0, 0.0].try_into().unwrap(),
            };
            let outcomes: Vec<CandidateOutcome> =
                (0..candidates.len()).map(|i| CandidateOutcome::Measured(scores(i))).collect();
            search.tell(&candidates, &outcomes);
        }
        search
    }

    #[test]
    fn a_search_reads_back_bit_for_bit() {
        let bytes = Checkpoint::print(&search(), 7, 8);
        let read = Checkpoint::read("a", &bytes).unwrap();
        assert_eq!((read.env_steps, read.left_out), (7, 8));
        assert_eq!(read.resume("a", &evolution(), 1), Ok(search()));
        let voxels = Evolution { genome: Genome::Voxels { crossover: 0.1 + 0.2 }, ..evolution() };
        for generations in [1, 5] {
            let search = search_of(&voxels, generations);
            assert_eq!(search.state().mirrors.is_empty(), generations == 5);
            let read = Checkpoint::read("a", &Checkpoint::print(&search, 7, 8)).unwrap();
            assert_eq!(read.resume("a", &voxels, 1), Ok(search));
        }
    }

    #[test]
    fn every_damage_is_detected() {
        let whole = Checkpoint::print(&search(), 7, 8);
        for place in (0..whole.len()).step_by(whole.len() / 300) {
            let mut damaged = whole.clone();
            damaged[place] ^= 1;
            assert!(Checkpoint::read("a", &damaged).is_err(), "a bit flipped at {place} went unseen");
            assert!(Checkpoint::read("a", &whole[..place]).is_err(), "a cut at {place} went unseen");
        }
        assert!(Checkpoint::read("a", &[whole, b"more".to_vec()].concat()).is_err());
    }

    #[test]
    fn another_declaration_or_seed_is_rejected() {
        let rejected = |evolution: &Evolution, seed| {
            let checkpoint = Checkpoint::read("a", &Checkpoint::print(&search(), 0, 0)).unwrap();
            checkpoint.resume("a", evolution, seed).unwrap_err().message
        };
        assert_eq!(rejected(&evolution(), 2), "`a` belongs to seed 1, expected seed 2");
        let wider = Evolution { width: 5, ..evolution() };
        assert_eq!(rejected(&wider, 1), "`a` was made by a different declaration of `small`");
        let mut forged = Checkpoint::read("a", &Checkpoint::print(&search(), 0, 0)).unwrap();
        forged.state.niches[0].1[0].genotype.as_mut().unwrap().links.clear();
        let message = forged.resume("a", &evolution(), 1).unwrap_err().message;
        assert_eq!(message, "`a` does not belong to evolution `small`");
        let text = String::from_utf8(Checkpoint::print(&search(), 0, 0)).unwrap();
        let later = text.replacen("nbc-checkpoint 2", "nbc-checkpoint 9", 1);
        let message = Checkpoint::read("a", later.as_bytes()).unwrap_err().message;
        assert_eq!(message, "`a` is a checkpoint of format 9, expected format 2");
        assert_eq!(Checkpoint::read("a", b"hello\n").unwrap_err().message, "`a` is not a checkpoint of such a run");
    }

    #[test]
    fn more_generations_are_the_same_declaration() {
        let longer = Evolution { generations: 500, seeds: vec![1, 2], name: "renamed".to_owned(), ..evolution() };
        let checkpoint = Checkpoint::read("a", &Checkpoint::print(&search(), 0, 0)).unwrap();
        assert!(checkpoint.resume("a", &longer, 1).is_ok());
    }
}
