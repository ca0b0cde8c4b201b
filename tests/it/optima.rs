//! The fewest cells for functions of three inputs, found by a breadth-first search over sets of functions that shares
//! no code with the compiler.

use nbc_base::model::Function;
use nbc_circuit::synth::reduce;
use nbc_circuit::{CellLibrary, MapOptions};

use crate::circuit::sum_of_products;

const LIBRARIES: &str = "nand, nor, nand not, nor not, and not, or not, nota_and_b, nota_and_b one, nota_or_b, \
    nota_or_b zero, and xor, or xnor, xor and one, nand xor, nand nor not, and or not, nand and not, \
    nor nota_and_b a_and_notb xor nand and xnor nota_or_b a_or_notb or not";

type Set = [u64; 4];

const START: [u8; 5] = [0x00, 0xff, 0xaa, 0xcc, 0xf0];

const PATTERNS: [(bool, bool); 4] = [(false, false), (false, true), (true, false), (true, true)];

fn insert(set: &mut Set, truth: u8) -> bool {
    let (word, bit) = (&mut set[usize::from(truth >> 6)], 1u64 << (truth & 63));
    let new = *word & bit == 0;
    *word |= bit;
    new
}

fn members(set: &Set) -> Vec<u8> {
    let mut members = Vec::new();
    for (place, mut word) in (0u8..).zip(*set) {
        while word != 0 {
            members.push(place << 6 | word.trailing_zeros() as u8);
            word &= word - 1;
        }
    }
    members
}

/// The function of two functions: the rows where they are one of the patterns at which `function` is 1.
fn composed(function: Function, a: u8, b: u8) -> u8 {
    let rows = |x: bool, y: bool| if x { a } else { !a } & if y { b } else { !b };
    let ones = PATTERNS.into_iter().filter(|&(x, y)| function.output(x, y));
    ones.fold(0, |made, (x, y)| made | rows(x, y))
}

/// The functions that one more cell adds to a set.
fn extensions(cells: &[Vec<u8>], set: &Set) -> Vec<u8> {
    let members = members(set);
    let (mut made, mut news) = (*set, Vec::new());
    for cell in cells {
        for &a in &members {
            for &b in &members {
                let truth = cell[usize::from(a) << 8 | usize::from(b)];
                if insert(&mut made, truth) {
                    news.push(truth);
                }
            }
        }
    }
    news
}

/// The fewest cells for each function, and the number of cells up to which all sets were tried. Sets are built cell by
/// cell until there are more than `most`.
fn optima(library: &CellLibrary, most: usize) -> (Vec<Option<usize>>, usize) {
    let pairs = || (0..=255u8).flat_map(|a| (0..=255u8).map(move |b| (a, b)));
    let table = |cell: Function| pairs().map(|(a, b)| composed(cell, a, b)).collect::<Vec<u8>>();
    let cells: Vec<_> = library.functions().map(table).collect();
    let mut start = Set::default();
    START.iter().for_each(|&truth| assert!(insert(&mut start, truth)));
    let mut fewest = vec![None; 256];
    START.iter().for_each(|&truth| fewest[usize::from(truth)] = Some(0));
    let mut sets = vec![start];
    for count in 1.. {
        let mut next = Vec::new();
        let keep = sets.len() <= most;
        for set in &sets {
            for truth in extensions(&cells, set) {
                fewest[usize::from(truth)].get_or_insert(count);
                let mut more = *set;
                insert(&mut more, truth);
                if keep {
                    next.push(more);
                }
            }
        }
        if !keep || fewest.iter().all(Option::is_some) {
            return (fewest, count);
        }
        next.sort_unstable();
        next.dedup();
        sets = next;
    }
    unreachable!("the sets grow until there are too many")
}

fn representative(truth: u8) -> u8 {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let place = |order: [usize; 3], row: usize| (0..3).fold(0, |place, i| place | (row >> order[i] & 1) << i);
    let image = |order| (0..8).fold(0, |image, row| image | (truth >> place(order, row) & 1) << row);
    orders.into_iter().map(image).min().expect("there are six orders")
}

/// Compares the compiler's result for every `step`-th function with the search; returns the functions that the search
/// did not reach.
fn compare(cells: &str, most: usize, step: usize) -> Vec<u8> {
    let library = CellLibrary::uniform(cells.split(' ').map(|name| Function::parse(name).unwrap()));
    let (fewest, deepest) = optima(&library, most);
    let mut beyond = Vec::new();
    for truth in (0..=255u8).filter(|&truth| representative(truth) == truth).step_by(step) {
        let wanted = sum_of_products(3, truth.into());
        let made = reduce(&wanted, &[], &library, &MapOptions::default()).unwrap().gates.len();
        match fewest[usize::from(truth)] {
            Some(fewest) => assert_eq!(made, fewest, "{truth:#04x} of `{cells}`"),
            None => {
                assert!(
                    made > deepest,
                    "{truth:#04x} of `{cells}` takes {made} cells, and more than {deepest} are needed"
                );
                beyond.push(truth);
            }
        }
    }
    beyond
}

#[test]
fn the_compiler_uses_the_fewest_cells_of_any_library() {
    for cells in LIBRARIES.split(", ") {
        compare(cells, 60, 23);
    }
}

/// Run with `cargo test --release --test it optima -- --ignored --nocapture`.
#[test]
#[ignore = "takes minutes"]
fn every_three_input_function_uses_the_fewest_cells_of_any_library() {
    for cells in LIBRARIES.split(", ") {
        let beyond = compare(cells, 150_000, 1);
        println!("{cells}: {} of 80 classes beyond the search", beyond.len());
    }
}
