//! The compiler on the benchmark circuits: ABC proves every written BLIF, and a table of robots, levels and seconds.

use std::fs;
use std::path::{Path, PathBuf};

use nbc_base::model::Function;
use nbc_base::source::FileId;
use nbc_circuit::formats::{Design, aiger, bench, blif};
use nbc_circuit::synth::reduce;
use nbc_circuit::{CellKind, CellLibrary, Effort, MapOptions, map_with, prove};

use crate::circuit::sum_of_products;
use crate::flows::fewest_of_abc;
use crate::generated::generated;
use crate::support::abc::abc;
use crate::support::root;

fn files() -> Vec<PathBuf> {
    let folder = root().join("tests/benchmarks");
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending != "md" && ending != "csv"));
    files.sort();
    files
}

fn read(path: &Path) -> Design {
    let bytes = fs::read(path).unwrap();
    let text = || String::from_utf8(bytes.clone()).unwrap();
    match path.extension().unwrap().to_str().unwrap() {
        "blif" => blif::read(&text(), FileId(0), None).unwrap(),
        "bench" => bench::read(&text(), FileId(0), None).unwrap(),
        _ => aiger::read(&bytes, None).unwrap(),
    }
}

/// The cell libraries of docs/compiler.md: (a), (b) and (c).
fn libraries() -> [(&'static str, CellLibrary); 3] {
    let all = Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT);
    [
        ("a", CellLibrary::uniform([Function::NAND, Function::NOT])),
        ("b", CellLibrary::uniform([Function::NAND, Function::AND, Function::NOT])),
        ("c", CellLibrary::uniform(all)),
    ]
}

#[test]
#[ignore = "maps all benchmarks; .ci/run runs it"]
fn abc_proves_every_written_blif_of_the_benchmarks() {
    let folder = tempfile::tempdir().unwrap();
    let options = MapOptions { effort: Effort::Fast, ..MapOptions::default() };
    let mut script = String::new();
    let mut pairs = 0;
    for path in files() {
        let design = read(&path);
        for (name, library) in libraries() {
            let logic = map_with(&design.logic, &library, &options).unwrap();
            prove(&design.logic, &logic).unwrap();
            let written = folder.path().join(format!("{}-{name}.blif", path.file_stem().unwrap().display()));
            fs::write(&written, blif::write(&Design { logic, registers: design.registers.clone() })).unwrap();
            let command = if design.registers.is_empty() { "cec -n" } else { "dsec" };
            script.push_str(&format!("{command} {} {}; ", path.display(), written.display()));
            pairs += 1;
        }
    }
    let Some(said) = abc(folder.path(), &script) else { return };
    assert_eq!(said.matches("Networks are equivalent").count(), pairs, "{said}");
}

/// CPU time of this thread in seconds, which does not depend on the load of the machine; `None` where it is unknown
/// (not Linux).
fn seconds_used() -> f64 {
    let told = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    told.split_whitespace().next().map_or(f64::NAN, |nanoseconds| nanoseconds.parse::<f64>().unwrap_or(f64::NAN) / 1e9)
}

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
    let made = generated().into_iter().map(|logic| (logic.name.clone(), Design { logic, registers: Vec::new() }));
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
            let started = seconds_used();
            let mapped = map_with(&design.logic, &library, &MapOptions { effort, ..MapOptions::default() }).unwrap();
            prove(&design.logic, &mapped).unwrap();
            row.seconds[i] = seconds_used() - started;
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

/// Prints the table of docs/compiler.md, with ABC measured in the same run. `EFFORT` is `fast`, `normal` or `high`.
/// `ONLY` selects circuits by parts of their names. Fails if a circuit needs more than 1.03 of ABC's cells at normal or
/// high effort.
///
/// Run with `EFFORT=high cargo test --release --test it measure_the_benchmarks -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement: half an hour at normal effort, hours at high effort"]
fn measure_the_benchmarks() {
    let effort = match std::env::var("EFFORT").as_deref() {
        Ok("high") => Effort::High,
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
    assert!(effort == Effort::Fast || missed.is_empty(), "more than 1.03 of ABC's cells: {missed:?}");
}

/// All functions of four variables that follow from one by exchanging and inverting variables and the output.
fn variants(truth: u16) -> impl Iterator<Item = u16> {
    let orders = (0..256usize).map(|code| [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6]);
    let orders = orders.filter(|order| (0..4).all(|i| order.contains(&i)));
    orders.flat_map(move |order| {
        (0..32usize).map(move |turned| {
            let place = |row: usize| (0..4).fold(0, |place, i| place | (row >> order[i] & 1) << i) ^ (turned & 15);
            (0..16).fold(0u16, |made, row| made | (truth >> place(row) & 1 ^ (turned >> 4) as u16) << row)
        })
    })
}

/// Knuth, The Art of Computer Programming 7.1.2, table 1: the number of functions of four variables that need 0 to 7
/// gates.
///
/// Run with `cargo test --release --test it four_variables -- --ignored`.
#[test]
#[ignore = "takes minutes"]
fn functions_of_four_variables_need_as_many_gates_as_in_knuth() {
    let mut library = libraries()[2].1.clone();
    library.insert(Function::NOT, CellKind { cost: 0, ..CellKind::uniform(1, 1.0) });
    let options = MapOptions { effort: Effort::High, ..MapOptions::default() };
    let mut done = vec![false; 1 << 16];
    let mut counts = [0usize; 10];
    for truth in 0..=u16::MAX {
        if done[usize::from(truth)] {
            continue;
        }
        let network = reduce(&sum_of_products(4, truth.into()), &[], &library, &options).unwrap();
        let gates = network.gates.iter().filter(|gate| gate.function != Function::NOT).count();
        for variant in variants(truth) {
            counts[gates] += usize::from(!std::mem::replace(&mut done[usize::from(variant)], true));
        }
    }
    assert_eq!(counts, [10, 60, 456, 2474, 10624, 24184, 25008, 2720, 0, 0]);
}
