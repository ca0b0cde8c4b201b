//! Checkpoints of evolution runs: a line with format and checksum, then the state as JSON.

use serde::{Deserialize, Serialize};

use crate::diag::{Code, Diagnostic};
use crate::evolve::{Search, SearchState};
use crate::model::{Axis, Evolution, Objective, Schedule};

/// The version of checkpoints that this program writes and reads.
const FORMAT: u32 = 1;
/// What every checkpoint begins with, of any version.
const MAGIC: &str = "nbc-checkpoint";

/// What a checkpoint holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Checkpoint {
    /// The version of the program that wrote it.
    pub version: String,
    /// The name of the evolution declaration.
    pub evolution: String,
    /// The declaration, but for its name, seeds and number of generations, as text to compare.
    declaration: String,
    /// The archive's axes; none in checkpoints that did not yet say them.
    #[serde(default)]
    pub descriptors: Vec<Axis>,
    /// What is rewarded.
    #[serde(default)]
    pub objective: Objective,
    /// The search.
    pub state: SearchState,
    /// Env steps simulated so far.
    pub env_steps: u64,
    /// Env steps left out so far.
    pub left_out: u64,
}

impl Checkpoint {
    /// A checkpoint of a search, with the env steps simulated and left out so far.
    pub fn of(search: &Search, env_steps: u64, left_out: u64) -> Self {
        let evolution = search.evolution();
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            evolution: evolution.name.clone(),
            declaration: declaration(evolution),
            descriptors: evolution.descriptors.clone(),
            objective: evolution.objective,
            state: search.state(),
            env_steps,
            left_out,
        }
    }

    /// The bytes of its file.
    pub fn print(&self) -> Vec<u8> {
        let state = serde_json::to_string(self).expect("a state has nothing that JSON cannot say");
        format!("{MAGIC} {FORMAT} {:08x} {}\n{state}\n", crc32fast::hash(state.as_bytes()), state.len()).into_bytes()
    }

    /// Reads the bytes of a checkpoint file called `name`.
    ///
    /// # Errors
    /// A diagnostic for what is no checkpoint, of another format, or damaged.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let fault = |code, text: &str| Diagnostic::without_place(code, format!("`{name}` {text}"));
        let none = || fault(Code::Checkpoint, "is no checkpoint of an evolution run");
        let end = bytes.iter().position(|&byte| byte == b'\n').ok_or_else(none)?;
        let (header, rest) = (std::str::from_utf8(&bytes[..end]).map_err(|_| none())?, &bytes[end + 1..]);
        let words: Vec<&str> = header.split(' ').collect();
        let [MAGIC, format, checksum, length] = words[..] else { return Err(none()) };
        if format != FORMAT.to_string() {
            let text = format!("is a checkpoint of format {format}, expected format {FORMAT}");
            return Err(fault(Code::ForeignFormat, &text).with_help("resume it with the version that wrote it"));
        }
        let damaged =
            || fault(Code::Checkpoint, "is damaged: its checksum does not fit").with_help("start the run afresh");
        let state = length.parse().ok().and_then(|length: usize| rest.get(..length)).ok_or_else(damaged)?;
        if rest[state.len()..] != *b"\n" || format!("{:08x}", crc32fast::hash(state)) != checksum {
            return Err(damaged());
        }
        serde_json::from_slice(state).map_err(|error| fault(Code::Checkpoint, &format!("cannot be read: {error}")))
    }

    /// The search as it was, for the declaration it was made by.
    ///
    /// # Errors
    /// A diagnostic when the declaration or the seed is another, or its bodies are none of that declaration.
    pub fn resume(self, name: &str, evolution: &Evolution, seed: u64) -> Result<Search, Diagnostic> {
        let fault = |text: String| {
            let fault = Diagnostic::without_place(Code::Checkpoint, format!("`{name}` {text}"));
            fault.with_help("give the run another name, or start it afresh without `--resume`")
        };
        if self.state.seed != seed {
            return Err(fault(format!("is of seed {}, expected seed {seed}", self.state.seed)));
        }
        if self.declaration != declaration(evolution) {
            return Err(fault(format!("was made by another declaration than `{}` is now", evolution.name)));
        }
        if !self.state.fits(evolution) {
            return Err(fault(format!("holds what no run of `{}` comes to", evolution.name)));
        }
        Ok(Search::resume(evolution, self.state))
    }
}

/// Everything in a declaration that its archive depends on.
fn declaration(evolution: &Evolution) -> String {
    let Schedule { spells } = &evolution.variable;
    let Evolution { width, height, palette, mutation, fixed_steps, descriptors, batch, newcomers, .. } = evolution;
    let Evolution { rules, objective, symmetry, niche, .. } = evolution;
    format!(
        "{width} x {height}; {palette:?}; {mutation:?}; {spells:?}; {fixed_steps}; {descriptors:?}; {batch} + {newcomers}; {rules:?}; \
         {objective:?}; {symmetry:?}; {niche:?}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::{Outcome, Scores};
    use crate::model::{Behavior, Count, MutationWeights, Niche, Palette, Rules, Symmetry};

    fn evolution() -> Evolution {
        Evolution {
            name: "small".to_owned(),
            width: 4,
            height: 3,
            palette: Palette::paper(),
            mutation: MutationWeights::default(),
            variable: Schedule::default(),
            fixed_steps: 84,
            descriptors: vec![Axis::Count { of: Count::Voxels, bins: 4 }, Axis::Behavior],
            batch: 8,
            newcomers: 1,
            generations: 5,
            seeds: vec![1],
            rules: Rules::Paper,
            objective: Objective::Distance,
            symmetry: Symmetry::Npn,
            niche: Niche::Pareto(3),
        }
    }

    fn search() -> Search {
        let mut search = Search::new(&evolution(), 1);
        for generation in 0..5 {
            let candidates = search.ask();
            let scores = |i: usize| Scores {
                fitness: [0.1 * i as f64, 1.0 / (i + generation + 1) as f64],
                behavior: Behavior::of(&[1.0, -1.0, i as f64 - 3.0, 1.0]),
                displacement: [0.1 + 0.2, 1e-300, -1.0 / 3.0, 0.0],
            };
            let outcomes: Vec<Outcome> = (0..candidates.len()).map(|i| Outcome::Measured(scores(i))).collect();
            search.tell(&candidates, &outcomes);
        }
        search
    }

    #[test]
    fn a_search_comes_back_bit_for_bit() {
        let bytes = Checkpoint::of(&search(), 7, 8).print();
        let read = Checkpoint::read("a", &bytes).unwrap();
        assert_eq!((read.env_steps, read.left_out), (7, 8));
        assert_eq!(read.resume("a", &evolution(), 1), Ok(search()));
    }

    #[test]
    fn every_damage_is_seen() {
        let whole = Checkpoint::of(&search(), 7, 8).print();
        for place in (0..whole.len()).step_by(whole.len() / 300) {
            let mut damaged = whole.clone();
            damaged[place] ^= 1;
            assert!(Checkpoint::read("a", &damaged).is_err(), "a bit flipped at {place} went unseen");
            assert!(Checkpoint::read("a", &whole[..place]).is_err(), "a cut at {place} went unseen");
        }
        assert!(Checkpoint::read("a", &[whole, b"more".to_vec()].concat()).is_err());
    }

    #[test]
    fn the_foreign_is_named() {
        let refused = |evolution: &Evolution, seed| {
            let checkpoint = Checkpoint::of(&search(), 0, 0);
            checkpoint.resume("a", evolution, seed).unwrap_err().message
        };
        assert_eq!(refused(&evolution(), 2), "`a` is of seed 1, expected seed 2");
        let wider = Evolution { width: 5, ..evolution() };
        assert_eq!(refused(&wider, 1), "`a` was made by another declaration than `small` is now");
        let mut forged = Checkpoint::of(&search(), 0, 0);
        forged.state.niches[0].1[0].genotype.links.clear();
        let message = forged.resume("a", &evolution(), 1).unwrap_err().message;
        assert_eq!(message, "`a` holds what no run of `small` comes to");
        let text = String::from_utf8(Checkpoint::of(&search(), 0, 0).print()).unwrap();
        let later = text.replacen("nbc-checkpoint 1", "nbc-checkpoint 9", 1);
        let message = Checkpoint::read("a", later.as_bytes()).unwrap_err().message;
        assert_eq!(message, "`a` is a checkpoint of format 9, expected format 1");
        assert_eq!(Checkpoint::read("a", b"hello\n").unwrap_err().message, "`a` is no checkpoint of an evolution run");
    }

    #[test]
    fn more_generations_are_no_other_declaration() {
        let longer = Evolution { generations: 500, seeds: vec![1, 2], name: "renamed".to_owned(), ..evolution() };
        assert!(Checkpoint::of(&search(), 0, 0).resume("a", &longer, 1).is_ok());
    }
}
