//! Checkpoints of evolution runs: a line with format and checksum, then the declaration and the state as JSON.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::disk::read;
use crate::search_state::SearchRecord as StateRecord;
use crate::wording;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Evolution;
use nbc_base::source::FileError;
use nbc_swarm::evolve::{Search, SearchState};

const FORMAT: &str = "2";
/// The first bytes of checkpoints of any version.
const MAGIC: &str = "nbc-checkpoint";

/// The contents of a checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    pub version: String,
    pub declared: Evolution,
    pub state: SearchState,
    pub env_steps: u64,
    pub left_out: u64,
}

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

    pub fn open(path: &Path) -> Result<Option<Self>, Diagnostic> {
        let name = path.display().to_string();
        match read(path, Limit::CheckpointBytes.most()) {
            Ok(bytes) => Self::read(&name, &bytes).map(Some),
            Err(FileError::NotFound) => Ok(None),
            Err(error) => Err(Diagnostic::unreadable(&name, &error)),
        }
    }

    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let text = unframed(name, MAGIC, FORMAT, bytes)?;
        let unreadable = |words: String| wording::unreadable_state(name, &words);
        let record: Record = serde_json::from_slice(text).map_err(|error| unreadable(error.to_string()))?;
        let Record { version, evolution: declared, state, env_steps, left_out } = record;
        let state = state.into_state(&declared).map_err(unreadable)?;
        Ok(Self { version, declared, state, env_steps, left_out })
    }

    /// The search as it was, for the declaration it was made by.
    pub fn resume(self, name: &str, evolution: &Evolution, seed: u64) -> Result<Search, Diagnostic> {
        if self.state.seed != seed {
            return Err(wording::other_seed(name, self.state.seed, seed));
        }
        // Name, seeds and number of generations do not change what fills the archive.
        let Evolution { name: declared, generations, seeds, .. } = evolution.clone();
        if (Evolution { name: declared, generations, seeds, ..self.declared }) != *evolution {
            return Err(wording::changed(name, &evolution.name));
        }
        if !self.state.fits(evolution) {
            return Err(wording::other_evolution(name, &evolution.name));
        }
        Ok(Search::resume(evolution, self.state))
    }
}

/// A text with a header: the kind of the file, its format, a checksum and the length.
pub(super) fn framed(magic: &str, format: &str, text: &str) -> Vec<u8> {
    format!("{magic} {format} {:08x} {}\n{text}\n", crc32fast::hash(text.as_bytes()), text.len()).into_bytes()
}

pub(super) fn unframed<'b>(name: &str, magic: &str, format: &str, bytes: &'b [u8]) -> Result<&'b [u8], Diagnostic> {
    let end = bytes.iter().take(MAX_HEADER).position(|&byte| byte == b'\n').unwrap_or(0);
    let words: Vec<&[u8]> = bytes[..end].split(|&byte| byte == b' ').collect();
    let [kind, found, checksum, length] = words[..] else { return Err(wording::not_a_checkpoint(name)) };
    if kind != magic.as_bytes() {
        return Err(wording::not_a_checkpoint(name));
    }
    if found != format.as_bytes() {
        return Err(wording::checkpoint_format(name, &String::from_utf8_lossy(found), format));
    }
    let rest = &bytes[end + 1..];
    let length = str::from_utf8(length).ok().and_then(|length| length.parse().ok());
    let text = length.and_then(|length: usize| rest.get(..length));
    let is_whole =
        |text: &&[u8]| rest[text.len()..] == *b"\n" && format!("{:08x}", crc32fast::hash(text)).as_bytes() == checksum;
    text.filter(is_whole).ok_or_else(|| wording::damaged(name))
}

/// The longest header in bytes, so that a large file that is not a checkpoint is rejected at once.
const MAX_HEADER: usize = 100;

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
