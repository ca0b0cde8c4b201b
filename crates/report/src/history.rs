//! The history of a run: a line for each generation, read back from its `progress.jsonl`.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer};

use crate::groups::difficulty_of;
use nbc_base::model::Behavior;

#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct ProgressLine {
    pub generation: u32,
    pub coverage: f64,
    pub qd_score: f64,
    #[serde(default, deserialize_with = "best")]
    pub best: BTreeMap<Behavior, [f64; 2]>,
}

impl ProgressLine {
    /// Over the behaviors of one difficulty, 0 to 3 in the paper's order. One that was not found counts as 0.
    pub fn mean_fitness(&self, difficulty: usize) -> f64 {
        let own: Vec<Behavior> = Behavior::all(2).filter(|&one| difficulty_of(one) == difficulty).collect();
        let best = |behavior| self.best.get(behavior).map_or(0.0, |fitness| fitness[0]);
        own.iter().map(best).sum::<f64>() / own.len() as f64
    }
}

fn best<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<Behavior, [f64; 2]>, D::Error> {
    let best: BTreeMap<String, [f64; 2]> = Deserialize::deserialize(deserializer)?;
    Ok(best.into_iter().filter_map(|(word, fitness)| Some((word.parse().ok()?, fitness))).collect())
}

/// The lines of a run up to a generation, each generation once and in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History<'a> {
    lines: BTreeMap<u32, (ProgressLine, &'a str)>,
    generations: u32,
}

impl<'a> History<'a> {
    /// Lines after the last checkpoint are skipped: the run repeats them. An unreadable line counts as missing.
    pub fn read(text: &'a str, generations: u32) -> Self {
        let mut lines = BTreeMap::new();
        for text in text.lines() {
            let Ok(line) = serde_json::from_str::<ProgressLine>(text) else { continue };
            if (1..=generations).contains(&line.generation) {
                lines.entry(line.generation).or_insert((line, text));
            }
        }
        Self { lines, generations }
    }

    pub fn lines(&self) -> impl Iterator<Item = ProgressLine> {
        self.lines.values().map(|(line, _)| line.clone())
    }

    pub fn print(&self) -> String {
        self.lines.values().flat_map(|(_, text)| [*text, "\n"]).collect()
    }

    pub fn damage(&self) -> Option<String> {
        let missing = self.generations as usize - self.lines.len();
        let first = (1..=self.generations).find(|generation| !self.lines.contains_key(generation))?;
        Some(format!(
            "has no readable line for {missing} of {} generations, the first of them {first}",
            self.generations
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(generation: u32) -> String {
        format!("{{\"generation\":{generation},\"coverage\":0.5,\"qd_score\":1.0,\"more\":true}}\n")
    }

    #[test]
    fn a_whole_history_is_kept_up_to_the_checkpoint() {
        let text: String = (1..=5).map(line).collect();
        let history = History::read(&text, 3);
        assert_eq!((history.damage(), history.lines().count()), (None, 3));
        assert_eq!(history.print(), (1..=3).map(line).collect::<String>());
        let killed = text + "{\"gener";
        assert_eq!(History::read(&killed, 5).damage(), None, "the line that was being written is made again");
    }

    #[test]
    fn the_behaviors_found_so_far_are_read() {
        let best = r#"{"LLRR":[5.9,1.4],"LRLL":[1.7,0.1],"?":[0,0]}"#;
        let text = line(1).replace("true}", &format!("true,\"best\":{best}}}"));
        let found: Vec<String> =
            History::read(&text, 1).lines().flat_map(|line| line.best).map(|(b, _)| b.to_string()).collect();
        assert_eq!(found, ["LRLL", "LLRR"]);
    }

    #[test]
    fn damage_is_reported_and_valid_lines_are_kept() {
        let text = line(1) + "\0\0\0\n" + &line(3) + &line(3) + &line(4);
        let history = History::read(&text, 4);
        assert_eq!(history.damage().unwrap(), "has no readable line for 1 of 4 generations, the first of them 2");
        assert_eq!(history.print(), line(1) + &line(3) + &line(4));
        let damage = History::read("nothing\n", 6).damage().unwrap();
        assert_eq!(damage, "has no readable line for 6 of 6 generations, the first of them 1");
    }
}
