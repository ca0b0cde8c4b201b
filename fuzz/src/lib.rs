//! Comparisons for several fuzz targets.

use nbc_circuit::Logic;
use nbc_circuit::formats::Design;

/// Asserts that two designs have the same ports and registers, and the same outputs for a few patterns of inputs.
pub fn same_design(one: &Design, two: &Design) {
    assert_eq!((one.inputs(), one.outputs()), (two.inputs(), two.outputs()), "the ports stay");
    assert_eq!(one.registers.len(), two.registers.len(), "the registers stay");
    let inputs = one.logic.inputs().len();
    let mut logics = [one, two].map(|design| Logic::new(&design.logic));
    for pattern in 0..8u64 {
        // Every input changes at a rate of its own.
        let value = |input: u64| (pattern * (2 * input + 1) >> (input % 3)) & 1 == 1;
        let values: Vec<_> = (0..inputs as u64).map(value).collect();
        let [first, second] = &mut logics;
        assert_eq!(first.settle(&values), second.settle(&values), "the function stays, at {values:?}");
    }
}
