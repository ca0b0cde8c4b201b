//! Laws of the compiler: it finds the optimum of every small function, and no damaged file makes a reader panic.

use nbc_base::model::Function;
use nbc_base::source::FileId;
use nbc_circuit::formats::{Design, aiger, bench, blif};
use nbc_circuit::network::Network;
use nbc_circuit::synth::exact::{self, ExactResult};
use nbc_circuit::synth::prices::Prices;
use nbc_circuit::synth::reduce;
use nbc_circuit::{CancelFlag, CellLibrary, MapOptions, Netlist};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A network of AND and OR cells for the function with these outputs.
pub fn sum_of_products(inputs: usize, truth: u32) -> Network {
    let mut network = Network::new(inputs);
    let mut sum = 0;
    for minterm in (0..1u32 << inputs).filter(|minterm| truth >> minterm & 1 == 1) {
        let mut product = 1;
        for i in 0..inputs {
            let function = if minterm >> i & 1 == 1 { Function::AND } else { Function::AND.with_input_inverted(1) };
            product = network.add(function, [product, network.input(i)]);
        }
        sum = network.add(Function::OR, [sum, product]);
    }
    network.outputs = vec![sum];
    network
}

/// The total number of cells for these functions of three inputs, at normal effort.
fn total(library: &CellLibrary, truths: impl Iterator<Item = u32>) -> usize {
    let cells = |truth| reduce(&sum_of_products(3, truth), &[], library, &MapOptions::default()).unwrap().gates.len();
    truths.map(cells).sum()
}

/// Run with `cargo test --release --test it three_input -- --ignored`.
#[test]
#[ignore = "takes half a minute"]
fn all_three_input_functions_reach_the_optimum() {
    assert_eq!(total(&CellLibrary::uniform([Function::NAND, Function::NOT]), 1..=254), 1318);
    let all = Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT);
    assert_eq!(total(&CellLibrary::uniform(all), 1..=254), 597);
}

/// Random libraries of a few functions, and random functions: no search over all sequences of cells finds fewer than
/// the compiler.
#[test]
fn any_library_makes_functions_with_the_fewest_cells() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let mut compared = 0;
    while compared < 30 {
        let bits = random.next_u32() & random.next_u32();
        let library = CellLibrary::uniform(Function::all().filter(|function| bits >> function.bits() & 1 == 1));
        if !library.is_complete() {
            continue;
        }
        let wanted = sum_of_products(3, 1 + random.next_u32() % 254);
        let made = reduce(&wanted, &[], &library, &MapOptions::default()).unwrap().gates.len();
        match exact::fewer(&wanted, &Prices::of(&library), 24, 2_000_000, &CancelFlag::default()) {
            ExactResult::Made(fewest) => assert_eq!(made, fewest.gates.len(), "{library:?} {wanted:?}"),
            ExactResult::Impossible => panic!("a complete library makes every function"),
            ExactResult::Unknown => continue,
        }
        compared += 1;
    }
}

/// A circuit with a register and a constant.
fn sample() -> Design {
    let text = "INPUT(a)\nINPUT(b)\nOUTPUT(y)\nOUTPUT(z)\nq = DFF(n)\nn = XOR(q, a)\ny = NAND(q, b)\nz = NOT(n)\n";
    bench::read(text, FileId(0), None).unwrap()
}

#[test]
fn damaged_files_do_not_make_a_reader_panic() {
    let design = sample();
    let files = [aiger::write(&design, true), aiger::write(&design, false), blif::write(&design).into_bytes()];
    for bytes in files {
        for at in 0..bytes.len() {
            read_all(&bytes[..at]);
            for wrong in [0u8, b' ', b'\n', b'9', b'.', 0xff] {
                let mut damaged = bytes.clone();
                damaged[at] = wrong;
                read_all(&damaged);
            }
        }
    }
}

/// Reads bytes as each format; the results do not matter.
fn read_all(bytes: &[u8]) {
    let _ = aiger::read(bytes, None);
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = blif::read(text, FileId(0), None);
        let _ = bench::read(text, FileId(0), None);
    }
}

#[test]
fn written_files_read_back() {
    let design = sample();
    let ports = |netlist: &Netlist| (netlist.inputs().len(), netlist.outputs().len());
    let again = blif::read(&blif::write(&design), FileId(0), None).unwrap();
    assert_eq!((ports(&again.logic), again.registers), (ports(&design.logic), design.registers.clone()));
    for binary in [false, true] {
        let again = aiger::read(&aiger::write(&design, binary), None).unwrap();
        assert_eq!((ports(&again.logic), &again.registers), (ports(&design.logic), &design.registers));
    }
}
