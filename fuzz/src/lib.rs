//! Comparisons for several fuzz targets.

use nbc_circuit::{Logic, Netlist};
use nbc_circuit::formats::Design;

/// Asserts that two designs have the same ports and registers, and the same outputs for a few patterns of inputs.
pub fn same_design(one: &Design, two: &Design) {
    let opened = [one, two].map(Design::opened);
    let ports = |netlist: &Netlist| (netlist.inputs().len(), netlist.outputs().len());
    assert_eq!(ports(&opened[0]), ports(&opened[1]), "the ports and registers stay");
    let inputs = opened[0].inputs().len();
    let mut logics = [0, 1].map(|at| Logic::new(&opened[at]));
    for pattern in 0..8u64 {
        // Every input changes at a rate of its own.
        let value = |input: u64| (pattern * (2 * input + 1) >> (input % 3)) & 1 == 1;
        let values: Vec<_> = (0..inputs as u64).map(value).collect();
        let [first, second] = &mut logics;
        assert_eq!(first.settle(&values), second.settle(&values), "the function stays, at {values:?}");
    }
}
