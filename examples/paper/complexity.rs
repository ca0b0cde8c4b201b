//! How hard each function is for bodies, beside measures of how complex it is for others.

use std::collections::BTreeMap;

use nbc_base::model::{Behavior, Function};

use crate::{Run, Spread, least_distances};

/// The most NANDs of a function of two inputs.
const MOST_NANDS: usize = 5;

/// How complex a function of two inputs is.
struct Complexity {
    /// Inputs that it depends on.
    inputs: usize,
    /// For how many of the two inputs a change changes the output, on average over the patterns.
    sensitivity: f64,
    /// The fewest NANDs that compute it of its inputs; none for an input itself or a constant.
    nands: usize,
}

impl Complexity {
    fn of(function: Function) -> Self {
        let changes = |input: usize| (0..4).filter(|row| function.row(*row) != function.row(row ^ 1 << input)).count();
        Self {
            inputs: (0..2).filter(|&input| function.depends_on(input)).count(),
            sensitivity: (0..2).map(changes).sum::<usize>() as f64 / 4.0,
            nands: fewest_nands(function),
        }
    }
}

fn fewest_nands(function: Function) -> usize {
    let bits = function.bits();
    let [a, b] = [0, 1].map(|input| (0..4).map(|row| u8::from(function.input_at(input, row)) << row).sum::<u8>());
    // Constants are there without a robot.
    let free = [0, 0b1111, a, b];
    (0..=MOST_NANDS).find(|&most| reaches(&mut free.to_vec(), bits, most)).expect("five are enough for any")
}

/// Whether that many more NANDs of these signals suffice for a function.
fn reaches(signals: &mut Vec<u8>, wanted: u8, most: usize) -> bool {
    if signals.contains(&wanted) {
        return true;
    }
    for (first, second) in (0..signals.len() * usize::from(most > 0)).flat_map(|i| (0..=i).map(move |k| (i, k))) {
        signals.push(!(signals[first] & signals[second]) & 0b1111);
        let found = reaches(signals, wanted, most - 1);
        signals.pop();
        if found {
            return true;
        }
    }
    false
}

/// Each behavior with its complexity and the median of its least distance, and how the two are correlated.
pub fn print(boxes: &[BTreeMap<u64, Run>]) {
    println!("\n| behavior | function | inputs | sensitivity | NANDs | 5x5 | 7x7 | 10x10 |");
    println!("|---|---|---|---|---|---|---|---|");
    let mut measures = [const { Vec::new() }; 3];
    let mut distances = vec![Vec::new(); boxes.len()];
    for behavior in Behavior::all(2) {
        let function = behavior.function();
        let Complexity { inputs, sensitivity, nands } = Complexity::of(function);
        print!("| {behavior} | {function} | {inputs} | {sensitivity} | {nands}");
        for (all, value) in measures.iter_mut().zip([inputs as f64, sensitivity, nands as f64]) {
            all.push(value);
        }
        for (all, runs) in distances.iter_mut().zip(boxes) {
            let Spread { median, .. } = least_distances(runs, behavior);
            print!(" | {median:.2}");
            all.push(median);
        }
        println!(" |");
    }
    println!("\n| correlated with the distance | 5x5 | 7x7 | 10x10 |\n|---|---|---|---|");
    for (name, values) in ["inputs", "sensitivity", "NANDs"].into_iter().zip(&measures) {
        print!("| {name}");
        distances.iter().for_each(|distances| print!(" | {:.2}", spearman(values, distances)));
        println!(" |");
    }
}

/// Spearman's rank correlation.
fn spearman(a: &[f64], b: &[f64]) -> f64 {
    let [a, b] = [a, b].map(ranks);
    let middle = (a.len() as f64 - 1.0) / 2.0;
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - middle) * (y - middle)).sum::<f64>();
    product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt()
}

/// The rank of each value from 0 on; equal ones share the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let less = values.iter().filter(|other| *other < value).count();
        let same = values.iter().filter(|other| *other == value).count();
        less as f64 + (same as f64 - 1.0) / 2.0
    };
    values.iter().map(rank).collect()
}
