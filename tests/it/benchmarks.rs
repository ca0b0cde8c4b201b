//! The compiler on the benchmark circuits: ABC proves every written BLIF, and a table of robots, levels and seconds.

use std::fs;
use std::path::{Path, PathBuf};

use nbc::circuit::formats::{Design, aiger, bench, blif};
use nbc::circuit::synth::reduce;
use nbc::circuit::{CellKind, CellLibrary, Effort, MapOptions, levels, map_with, prove};
use nbc::model::Function;
use nbc::source::FileId;

use crate::circuit::sum_of_products;
use crate::language::root;
use crate::synth::abc;

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
fn abc_proves_every_written_blif_of_the_benchmarks() {
    let folder = tempfile::tempdir().unwrap();
    let options = MapOptions { effort: Effort::Fast, ..MapOptions::default() };
    let mut script = String::new();
    let mut pairs = 0;
    for path in files() {
        let design = read(&path);
        for (name, library) in libraries() {
            let logic = map_with(&design.logic, &library, options).unwrap();
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

/// The results of ABC for a circuit, and the optimum proved by SAT, by library: fast, best, optimum. Empty if unknown.
fn reference(name: &str) -> Option<[[String; 3]; 3]> {
    let text = fs::read_to_string(root().join("tests/benchmarks/reference.csv")).unwrap();
    let row = text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(','))?;
    let cells: Vec<String> = row.split(',').map(str::to_owned).collect();
    let [a1, a2, a3, b2, b3, c1, c2, c3] = <[String; 8]>::try_from(cells).unwrap();
    Some([[a1, a2, a3], [String::new(), b2, b3], [c1, c2, c3]])
}

/// Prints the table of docs/compiler.md, and fails if a circuit needs more cells than its target. `EFFORT` is `fast`,
/// `normal` or `high`; only high effort has targets. `ONLY` selects circuits by a part of their names.
///
/// Run with `EFFORT=high cargo test --release --test it measure_the_benchmarks -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement: seconds at normal effort, half an hour at high effort"]
fn measure_the_benchmarks() {
    let effort = match std::env::var("EFFORT").as_deref() {
        Ok("high") => Effort::High,
        Ok("fast") => Effort::Fast,
        _ => Effort::Normal,
    };
    let only = std::env::var("ONLY").unwrap_or_default();
    let (mut ratios, mut missed) = ([const { Vec::new() }; 3], Vec::new());
    println!(
        "| circuit | library | cells | levels | ABC fast | ABC best | optimum | seconds \
         |\n|---|---|---|---|---|---|---|---|"
    );
    for path in files().iter().filter(|path| path.display().to_string().contains(&only)) {
        let (name, design) = (path.file_stem().unwrap().display().to_string(), read(path));
        for (i, (letter, library)) in libraries().into_iter().enumerate() {
            let started = seconds_used();
            let mapped = map_with(&design.logic, &library, MapOptions { effort, ..MapOptions::default() }).unwrap();
            prove(&design.logic, &mapped).unwrap();
            let seconds = seconds_used() - started;
            let (cells, levels) = (mapped.cells().count(), levels::depth(&mapped));
            let [fast, best, optimum] = reference(&name).map_or_else(Default::default, |rows| rows[i].clone());
            println!("| {name} | {letter} | {cells} | {levels} | {fast} | {best} | {optimum} | {seconds:.2} |");
            if let Ok(best) = best.parse::<f64>() {
                let ratio = cells as f64 / best;
                ratios[i].push(ratio);
                if ratio > [1.0, 1.03, 1.03][i] {
                    missed.push(format!("{name} takes {cells} cells of library {letter}, and ABC {best}"));
                }
            }
        }
    }
    for ((letter, _), ratios) in libraries().iter().zip(ratios) {
        let mean = ratios.iter().map(|ratio| libm::log(*ratio)).sum::<f64>() / ratios.len() as f64;
        println!("library {letter}: {:.3} of the cells of ABC best, by the geometric mean", libm::exp(mean));
        assert!(effort != Effort::High || mean <= 0.0, "library {letter} takes more cells than ABC");
    }
    assert!(effort != Effort::High || missed.is_empty(), "{missed:?}");
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
        let network = reduce(&sum_of_products(4, truth.into()), &[], &library, options).unwrap();
        let gates = network.gates.iter().filter(|gate| gate.function != Function::NOT).count();
        for variant in variants(truth) {
            counts[gates] += usize::from(!std::mem::replace(&mut done[usize::from(variant)], true));
        }
    }
    assert_eq!(counts, [10, 60, 456, 2474, 10624, 24184, 25008, 2720, 0, 0]);
}
