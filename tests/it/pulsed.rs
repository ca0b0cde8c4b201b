//! Pulsed latches: registers of four cells that a pulse opens, used where they are proved safe.

use nbc_base::model::{Function, Stimulation};
use nbc_circuit::timing::{ClockTimes, Pulsed, WhyKept};
use nbc_circuit::{CellKind, CellLibrary, Delayed, Delays, Netlist, Timing};
use nbc_session::store::DiskWorld;
use nbc_session::{CompileOptions, Session};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::memory::{Element, elements, mapped, next, text};
use crate::support::root;

/// All functions with random clocks; NAND and AND are quick in most libraries, as they must be for pulses.
fn library(random: &mut ChaCha8Rng) -> CellLibrary {
    let functions = Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT);
    let most = if random.random_range(0..4) == 0 { 2 } else { 1 };
    let kind = |function| {
        let is_quick = [Function::NAND, Function::AND].contains(&function);
        (function, CellKind::uniform(random.random_range(1..=if is_quick { most } else { 3 }), 1.0))
    };
    functions.map(kind).collect()
}

/// Switches one input after another, holds each for the static time, and compares every output with the model.
fn remembers(elements: &[Element], netlist: &Netlist, library: &CellLibrary, random: &mut ChaCha8Rng) {
    let kind = library.kinds_of(netlist);
    let hold = Timing::of(netlist, library, Delays::Clock).hold as usize;
    let mut delayed = Delayed::new(netlist, |id| random.random_range(1..=kind(id).clock) as usize);
    let mut inputs = [false; 4];
    let mut state: Vec<bool> = elements.iter().map(|element| element.start).collect();
    next(elements, &inputs, &inputs, &mut state);
    delayed.run(&inputs, 2 * hold + 10);
    for row in 0..24 {
        let before = inputs;
        inputs[random.random_range(0..4)] ^= true;
        next(elements, &before, &inputs, &mut state);
        // A cell of one cycle changes in the cycle after the switch.
        let found = delayed.run(&inputs, hold + 1);
        assert_eq!(found, state, "row {row}, {before:?} to {inputs:?}\n{}{netlist}", text(elements));
    }
}

/// Whether a latch that a clock closes may take the next value of another one.
fn has_races(netlist: &Netlist, library: &CellLibrary) -> bool {
    let timing = Timing::of(netlist, library, Delays::Clock);
    let clocks = ClockTimes::all(netlist, &timing.storage, timing.hold, library.kinds_of(netlist));
    clocks.iter().any(|times| !times.races.is_empty())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn pulsed_latches_store_what_registers_store_for_any_delays(elements in elements(), seed: u64) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let library = library(&mut random);
        let netlist = mapped(&text(&elements), &library);
        let pulsed = Pulsed::of(&netlist, &library).netlist;
        assert!(pulsed.cells().count() <= netlist.cells().count());
        // Flip-flops that stay may race through a slow inverter of the clock, which static timing tells.
        prop_assume!(!has_races(&pulsed, &library));
        (0..4).for_each(|_| remembers(&elements, &pulsed, &library, &mut random));
    }
}

fn quick() -> CellLibrary {
    CellLibrary::uniform([Function::NAND, Function::AND, Function::NOT])
}

fn counts(body: &str, library: &CellLibrary) -> (usize, usize, Vec<WhyKept>) {
    let pulsed = Pulsed::of(&mapped(body, library), library);
    let latches = pulsed.registers.pulses.iter().map(|pulse| pulse.latches).sum();
    let padding = pulsed.registers.pulses.iter().map(|pulse| pulse.padding).sum();
    (latches, padding, pulsed.registers.kept.iter().map(|(_, why)| *why).collect())
}

#[test]
fn data_that_change_too_early_are_delayed_by_two_cells() {
    let shift = "circuit memory(a, clk) -> (q[4]) {\n    q = register({q[2..0], a}, clk)\n}\n";
    assert_eq!(counts(shift, &quick()), (4, 6, vec![]));
    let toggle = "circuit memory(clk) -> (q[2]) {\n    q = register[start = 1](not q, clk)\n}\n";
    assert_eq!(counts(toggle, &quick()), (2, 0, vec![]));
}

#[test]
fn registers_stay_flip_flops_where_pulses_are_not_proved() {
    let mut slow = quick();
    slow.insert(Function::NAND, CellKind::uniform(2, 1.0));
    let toggle = "circuit memory(clk) -> (q[2]) {\n    q = register[start = 1](not q, clk)\n}\n";
    assert_eq!(counts(toggle, &slow), (0, 0, vec![WhyKept::FastData; 2]));
    let other = CellLibrary::uniform([Function::AND, Function::OR, Function::NOT]);
    assert_eq!(counts(toggle, &other), (0, 0, vec![WhyKept::OtherForm; 2]));
    let gated = "circuit memory(a, b, clk) -> (q) {\n    q = register(a, clk and b)\n}\n";
    assert_eq!(counts(gated, &quick()), (0, 0, vec![WhyKept::DerivedClock]));
}

/// Every row of both programs of the computer is right for random delays of its robots.
#[test]
fn the_computer_of_pulsed_latches_needs_few_robots_and_every_row_is_right() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut session = Session::new(DiskWorld);
    let checked = session.checked(root().join("circuits/computer.nb").to_str().unwrap());
    for test in &checked.program.tests {
        let mapping = session.map(&checked, &test.circuit, &CompileOptions::default()).unwrap();
        let registers = mapping.registers.as_ref().expect("the swarms of the computer have pulsed latches");
        assert_eq!((registers.pulses.len(), registers.pulses[0].latches, &registers.kept[..]), (1, 11, &[][..]));
        assert!(mapping.netlist.cells().count() <= 110, "{} robots", mapping.netlist.cells().count());
        let hold = Timing::of(&mapping.netlist, &mapping.cells, Delays::Clock).hold as usize;
        println!("{}: {} robots, {hold} cycles by static timing", test.circuit, mapping.netlist.cells().count());
        let kind = mapping.cells.kinds_of(&mapping.netlist);
        let Stimulation::Rows(rows) = &test.stimulation else { panic!("the tests of the computer have rows") };
        for _ in 0..4 {
            let mut computer = Delayed::new(&mapping.netlist, |id| random.random_range(1..=kind(id).clock) as usize);
            for row in rows {
                let found = computer.run(&row.inputs, hold + 1);
                let agrees = found.iter().zip(&row.expected).all(|(found, bit)| bit.is_none_or(|bit| bit == *found));
                assert!(agrees, "line {}: {found:?}", row.line);
            }
        }
    }
}
