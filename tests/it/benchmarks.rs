//! The compiler on the benchmark circuits, and on all functions of four variables.

use std::fs;

use nbc_base::model::Function;
use nbc_circuit::formats::{Design, blif};
use nbc_circuit::synth::reduce;
use nbc_circuit::{CellKind, Effort, MapOptions, map_with, prove};

use crate::circuit::sum_of_products;
use crate::designs::{files, libraries, read};
use crate::support::abc::abc;

#[test]
#[ignore = "maps all benchmarks; .ci/full runs it"]
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
            fs::write(&written, blif::write(&Design::new(logic, design.registers.clone()))).unwrap();
            let command = if design.registers.is_empty() { "cec -n" } else { "dsec" };
            script.push_str(&format!("{command} {} {}; ", path.display(), written.display()));
            pairs += 1;
        }
    }
    let Some(said) = abc(folder.path(), &script) else { return };
    assert_eq!(said.matches("Networks are equivalent").count(), pairs, "{said}");
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
