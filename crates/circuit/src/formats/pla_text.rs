//! The writer of PLA: few cubes for each output, of a circuit without state and with few inputs.

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::formats::Design;
use crate::formats::names::{FileNames, visible};
use crate::two_level;
use crate::{NetId, Settled};

/// A design as PLA text. It has no registers and no loops, and so few inputs that its truth table can be written.
pub fn write(design: &Design) -> String {
    let netlist = &design.logic;
    let (inputs, outputs) = (netlist.inputs(), netlist.outputs());
    let names = FileNames::new(netlist, &[], &[], true, |name| visible(name, &['#']));
    let list = |ids: &[NetId]| ids.iter().map(|&id| format!(" {}", names.net(id))).collect::<String>();
    // The outputs of each cube, in the order in which cubes are found.
    let mut cubes: Vec<(Vec<u8>, Vec<u8>)> = Vec::new();
    let mut places: BTreeMap<Vec<u8>, usize> = BTreeMap::new();
    for (output, table) in tables(design).into_iter().enumerate() {
        for cube in two_level::cover(&table, &table) {
            let place = *places.entry(cube).or_insert_with_key(|cube| {
                cubes.push((cube.clone(), vec![b'0'; outputs.len()]));
                cubes.len() - 1
            });
            cubes[place].1[output] = b'1';
        }
    }
    let mut text = format!(".i {}\n.o {}\n", inputs.len(), outputs.len());
    let _ = write!(text, ".ilb{}\n.ob{}\n.p {}\n", list(inputs), list(outputs), cubes.len());
    for (cube, outputs) in &cubes {
        let digits = |digits: &[u8]| String::from_utf8_lossy(digits).into_owned();
        let _ = writeln!(text, "{} {}", digits(cube), digits(outputs));
    }
    text.push_str(".e\n");
    text
}

fn tables(design: &Design) -> Vec<Vec<bool>> {
    let bits = design.inputs();
    let mut tables = vec![Vec::with_capacity(1 << bits); design.outputs()];
    let mut settled = Settled::new(&design.logic);
    let inputs = |pattern: usize| (0..bits).rev().map(|bit| pattern >> bit & 1 == 1).collect();
    for first in (0..1usize << bits).step_by(Settled::ROWS) {
        let block: Vec<Vec<bool>> = (first..(first + Settled::ROWS).min(1 << bits)).map(inputs).collect();
        for end in settled.apply(&block.iter().map(Vec::as_slice).collect::<Vec<_>>()) {
            tables.iter_mut().zip(end.outputs).for_each(|(table, bit)| table.push(bit));
        }
    }
    tables
}
