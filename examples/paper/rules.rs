//! The paper's text against its authors' code: the distances of both, and which differences make the code slower.

use std::collections::BTreeMap;

use nbc_session::report::{self, BehaviorGroup, ProgressLine};

use crate::{Fallible, Moment, Run, SHORT, Spread, read};

/// The generation at which the differences are compared. Runs that have fewer are left out, and not counted.
const GENERATION: u32 = 100;

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
        let own = read(folder)?;
        let lines: Vec<&ProgressLine> = own.values().filter_map(|run| run.line(GENERATION)).collect();
        let niches: Vec<f64> = lines.iter().map(|line| 100.0 * line.coverage).collect();
        let behaviors = Spread::of(lines.iter().map(|line| line.best.len() as f64));
        print!("| {name} | {} | {behaviors:.0} | {:.1} % |", lines.len(), Spread::of(niches.iter().copied()));
        match &text {
            None => print!(" |"),
            Some(text) => print!(" {:.5} |", p(text, &niches)),
        }
        for difficulty in 0..4 {
            print!(" {:.1} |", Spread::of(lines.iter().map(|line| line.mean_fitness(difficulty))).median);
        }
        println!();
        text.get_or_insert(niches);
    }
    Ok(())
}

/// The Mann-Whitney test of two sets of values: exact, unless some are equal.
fn p(one: &[f64], other: &[f64]) -> f64 {
    let group = |values: &[f64]| BehaviorGroup { name: "", stimuli: 0, difficulty: 0, values: values.to_vec() };
    let compared = report::compare_groups(&[group(one), group(other)]);
    compared.first().map_or(f64::NAN, |comparison| comparison.p)
}
