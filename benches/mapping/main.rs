//! The compiler on the benchmark circuits: the table of docs/synthesis.md, with ABC measured in the same run:
//! `cargo bench --bench mapping`.
//!
//! `EFFORT` is `fast`, or `normal`, the default, which takes half an hour. `ONLY` selects circuits by parts of their
//! names. The aim is at most 1.03 of ABC's cells for each circuit at normal effort.

// Files of the tests have more than this needs.
#![allow(dead_code, unused_imports)]

use std::fs;
use std::process::ExitCode;

use nbc_circuit::formats::Design;
use nbc_circuit::{Effort, MapOptions, map_with, prove};

use aims::Aims;
use designs::{files, libraries, read};
use flows::fewest_of_abc;
use generated::generated;
use processor::processor_seconds;
use support::root;

#[path = "../aims/mod.rs"]
mod aims;
#[path = "../../tests/it/designs.rs"]
mod designs;
#[path = "../../tests/it/flows.rs"]
mod flows;
mod generated;
#[path = "../processor/mod.rs"]
mod processor;
#[path = "../../tests/it/support/mod.rs"]
mod support;

/// The best results of ABC for a circuit that are known, and the optima proved by SAT, by library.
fn reference(name: &str) -> Option<[[Option<u32>; 2]; 3]> {
    let text = fs::read_to_string(root().join("tests/benchmarks/reference.csv")).unwrap();
    let row = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(','))?;
    let cells: Vec<Option<u32>> = row.split(',').map(|cell| cell.parse().ok()).collect();
    let [_, a2, a3, b2, b3, _, c2, c3] = <[Option<u32>; 8]>::try_from(cells).unwrap();
    Some([[a2, a3], [b2, b3], [c2, c3]])
}

/// The circuits of `tests/benchmarks` and the generated ones, with their names.
fn designs() -> Vec<(String, Design)> {
    let read = files().into_iter().map(|path| (path.file_stem().unwrap().display().to_string(), read(&path)));
    let made = generated().into_iter().map(|logic| (logic.name.clone(), Design::new(logic)));
    read.chain(made).collect()
}

/// The cells and seconds of `nbc` and the fewest cells of ABC for each library, as a row of the table.
struct Row {
    name: String,
    cells: [usize; 3],
    seconds: [f64; 3],
    abc: [Option<u32>; 3],
    optimum: [Option<u32>; 3],
}

impl Row {
    fn measure(name: String, design: &Design, effort: Effort) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let measured = fewest_of_abc(design, folder.path());
        let known = reference(&name).unwrap_or_default();
        let mut row = Self { name, cells: [0; 3], seconds: [0.0; 3], abc: [None; 3], optimum: [None; 3] };
        for (i, (_, library)) in libraries().into_iter().enumerate() {
            let started = processor_seconds();
            let logic = design.opened();
            let mapped = map_with(&logic, &library, &MapOptions { effort, ..MapOptions::default() }).unwrap();
            prove(&logic, &mapped).unwrap();
            row.seconds[i] = processor_seconds() - started;
            row.cells[i] = mapped.cells().count();
            row.abc[i] = measured.map(|measured| measured[i]).into_iter().chain(known[i][0]).min();
            row.optimum[i] = known[i][1];
        }
        row
    }

    fn ratio(&self, i: usize) -> Option<f64> {
        self.abc[i].filter(|&best| best > 0).map(|best| self.cells[i] as f64 / f64::from(best))
    }
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "| {} |", self.name)?;
        let shown = |number: Option<u32>| number.map_or(String::new(), |number| number.to_string());
        for i in 0..3 {
            let [abc, optimum] = [self.abc[i], self.optimum[i]].map(shown);
            write!(f, " {} | {abc} | {optimum} | {:.1} |", self.cells[i], self.seconds[i])?;
        }
        Ok(())
    }
}

fn main() -> ExitCode {
    let effort = match std::env::var("EFFORT").as_deref() {
        Ok("fast") => Effort::Fast,
        _ => Effort::Normal,
    };
    let only = std::env::var("ONLY").unwrap_or_default();
    let chosen = |name: &str| only.split(',').any(|part| name.contains(part));
    println!("| circuit |{}", " cells | ABC | optimum | seconds |".repeat(3));
    println!("|---|{}", "---|".repeat(12));
    let mut rows = Vec::new();
    for (name, design) in designs().into_iter().filter(|(name, _)| chosen(name)) {
        rows.push(Row::measure(name, &design, effort));
        println!("{}", rows[rows.len() - 1]);
    }
    let mut missed = Vec::new();
    for (i, (letter, _)) in libraries().iter().enumerate() {
        let ratios: Vec<f64> = rows.iter().filter_map(|row| row.ratio(i)).collect();
        let mean = libm::exp(ratios.iter().map(|ratio| libm::log(*ratio)).sum::<f64>() / ratios.len() as f64);
        println!("library {letter}: {mean:.3} of the cells of ABC's best, by the geometric mean");
        let above = rows.iter().filter(|row| row.ratio(i).is_some_and(|ratio| ratio > 1.03));
        missed.extend(above.map(|row| format!("{} with library {letter}", row.name)));
    }
    let mut aims = Aims::default();
    if effort != Effort::Fast {
        aims.check(missed.is_empty(), format_args!("no more than 1.03 of ABC's cells, except {missed:?}"));
    }
    aims.end()
}
