//! The paper's text against its authors' code: the distances of both, and which differences make the code slower.

use std::collections::BTreeMap;
use std::fs;

use nbc_base::model::Behavior;
use nbc_session::report::{self, BehaviorGroup};
use serde::Deserialize;

use crate::{Fallible, Moment, Run, SHORT, Spread, folders};

/// The generation at which the differences are compared. Runs that have fewer are left out, and not counted.
const GENERATION: u32 = 100;

/// A line of a run's `progress.jsonl`.
#[derive(Deserialize)]
struct Line {
    generation: u32,
    coverage: f64,
    /// For each behavior found, both fitnesses of its champion.
    best: BTreeMap<Behavior, [f64; 2]>,
}

/// The groups of behaviors by the rules of the paper's text and by those of its code.
pub fn print_distances(text: &BTreeMap<u64, Run>, code: &BTreeMap<u64, Run>) {
    println!("\n| group | text | code | p | A12 |\n|---|---|---|---|---|");
    let [text, code] = [("text", text), ("code", code)].map(|(name, runs)| Moment::of(name.to_owned(), runs, SHORT));
    let both = text.groups(|_| true).into_iter().zip(code.groups(|_| true));
    for pair in both.map(<[BehaviorGroup; 2]>::from) {
        let [ours, theirs] = [&pair[0], &pair[1]].map(|group| Spread::of(group.values.iter().copied()).median);
        for comparison in report::compare_groups(&pair) {
            println!("| {} | {ours:.1} | {theirs:.1} | {:.5} | {:.2} |", pair[0].name, comparison.p, comparison.a12);
        }
    }
}

/// What runs that follow the code in these matters had after [`GENERATION`] generations, the first of them by the text.
/// A behavior that is not found counts as a distance of 0.
pub fn print_matters(runs: &[(&str, &str)]) -> Fallible<()> {
    println!("\n| the code in | runs | behaviors | niches filled | p | no stimulus | one | both | XOR and XNOR |");
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut text: Option<Vec<f64>> = None;
    for (name, folder) in runs {
        let lines = lines(folder)?;
        let niches: Vec<f64> = lines.iter().map(|line| 100.0 * line.coverage).collect();
        let behaviors = Spread::of(lines.iter().map(|line| line.best.len() as f64));
        print!("| {name} | {} | {behaviors:.0} | {:.1} % |", lines.len(), Spread::of(niches.iter().copied()));
        match &text {
            None => print!(" |"),
            Some(text) => print!(" {:.5} |", p(text, &niches)),
        }
        for difficulty in 0..4 {
            let mean = |line: &Line| {
                let own = || Behavior::all(2).filter(|&one| report::difficulty_of(one) == difficulty);
                let distances = own().map(|one| line.best.get(&one).map_or(0.0, |fitness| fitness[0]));
                distances.sum::<f64>() / own().count() as f64
            };
            print!(" {:.1} |", Spread::of(lines.iter().map(mean)).median);
        }
        println!();
        text.get_or_insert(niches);
    }
    Ok(())
}

/// The line of that generation of each run in a folder of `out`.
fn lines(folder: &str) -> Fallible<Vec<Line>> {
    let mut found = Vec::new();
    for folder in folders(folder)? {
        for line in fs::read_to_string(folder.join("progress.jsonl"))?.lines() {
            let line: Line = serde_json::from_str(line)?;
            if line.generation == GENERATION {
                found.push(line);
            }
        }
    }
    Ok(found)
}

/// The Mann-Whitney test of two sets of values: exact, unless some are equal.
fn p(one: &[f64], other: &[f64]) -> f64 {
    let group = |values: &[f64]| BehaviorGroup { name: "", stimuli: 0, difficulty: 0, values: values.to_vec() };
    let compared = report::compare_groups(&[group(one), group(other)]);
    compared.first().map_or(f64::NAN, |comparison| comparison.p)
}
