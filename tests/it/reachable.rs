//! `nbc synth --reachable-only`: circuits that are right in the reachable states of their registers.

use std::collections::BTreeSet;

use nbc_base::model::Function;
use nbc_base::source::FileId;
use nbc_circuit::formats::{Design, Forcing, Register, RegisterKind, blif};
use nbc_circuit::reachable::{WhyEveryState, simplify};
use nbc_circuit::{CellLibrary, Effort, Logic, MapOptions, Netlist};
use proptest::prelude::*;

use crate::support::abc::abc_agrees;
use crate::support::bench::Bench;

/// A state machine with a register for each state, of which one is 1. It goes on while `x` is 1 and back to the start
/// when `y` is 1. The states are tested one after the other, as in a chain of `else if`.
fn one_hot(states: usize) -> String {
    let names: Vec<String> = (0..states).map(|at| format!("s{at}")).collect();
    let list = names.join(" ");
    let mut text = ".model chain\n.inputs clk x y\n.outputs odd last\n".to_owned();
    for at in 0..states {
        text += &format!(".latch n{at} s{at} re clk {}\n", u8::from(at == 0));
    }
    // The first state that is 1, of all; the conditions are `x` and `y`.
    let row =
        |from: usize, conditions: &str| format!("{}1{} {conditions}", "0".repeat(from), "-".repeat(states - from - 1));
    let join = |row: String| row.replace(' ', "");
    for at in 0..states {
        let mut rows = vec![row((at + states - 1) % states, "10"), row(at, "00")];
        if at == 0 {
            rows.extend((0..states).map(|from| row(from, "-1")));
        }
        text += &format!(".names {list} x y n{at}\n");
        rows.into_iter().for_each(|row| text += &format!("{} 1\n", join(row)));
    }
    let shown = |name: &str, from: &mut dyn Iterator<Item = usize>| {
        let rows: String = from.map(|from| format!("{} 1\n", join(row(from, "")))).collect();
        format!(".names {list} {name}\n{rows}")
    };
    text += &shown("odd", &mut (1..states).step_by(2));
    text += &shown("last", &mut std::iter::once(states - 1));
    text + ".end\n"
}

/// The next state and the outputs of a design, if the registers of these clock edges take their next values.
fn step(design: &Design, state: &[bool], inputs: &[bool], ticks: &dyn Fn(&Register) -> bool) -> (Vec<bool>, Vec<bool>) {
    let all: Vec<bool> = inputs.iter().chain(state).copied().collect();
    let mut shown = Logic::new(&design.logic).settle(&all).unwrap();
    let nexts = shown.split_off(design.outputs());
    let taken = design.registers.iter().zip(nexts).zip(state);
    (taken.map(|((register, next), &now)| if ticks(register) { next } else { now }).collect(), shown)
}

/// Compares two designs in every state that the first reaches from the start; returns the number of states.
fn same_from_the_start(one: &Design, two: &Design) -> usize {
    let start = |design: &Design| design.registers.iter().map(Register::starts_at).collect::<Vec<bool>>();
    assert_eq!(start(one), start(two));
    let mut seen = BTreeSet::from([start(one)]);
    let mut pending = vec![start(one)];
    while let Some(state) = pending.pop() {
        for pattern in 0..1u32 << one.inputs() {
            let inputs: Vec<bool> = (0..one.inputs()).map(|bit| pattern >> bit & 1 == 1).collect();
            for ticks in 0..4u8 {
                let clocked = |register: &Register| {
                    let other = register.clock.as_deref() == Some("b") || register.kind == RegisterKind::Falling;
                    ticks >> u8::from(other) & 1 == 1
                };
                let next = step(one, &state, &inputs, &clocked);
                assert_eq!(next, step(two, &state, &inputs, &clocked), "in {state:?} at {inputs:?}");
                if seen.insert(next.0.clone()) {
                    pending.push(next.0);
                }
            }
        }
    }
    seen.len()
}

fn read(bench: &Bench, name: &str) -> Design {
    let text = std::fs::read_to_string(bench.path().join(name)).unwrap();
    blif::read(&text, FileId(0), None).unwrap()
}

#[test]
fn a_one_hot_machine_shrinks_and_stays_equal_from_the_start() {
    let bench = Bench::new();
    for (states, cells) in [(4, "nand,not"), (6, "all")] {
        bench.file("chain.blif", one_hot(states));
        let plain = ["synth", "chain.blif", "-o", "plain.blif", "--cells", cells, "--format", "json"];
        let whole = bench.run(&plain).expect_json();
        assert!(whole.get("unreachable").is_none());
        let smaller = ["synth", "chain.blif", "-o", "small.blif", "--cells", cells, "--reachable-only"];
        let report = bench.run(&[&smaller[..], &["--format", "json"]].concat()).expect_json();
        let found = &report["unreachable"];
        assert_eq!((&found["reachable_states"], &found["states"]), (&states.into(), &(1 << states).into()));
        let saved = found["cells_saved"].as_u64().unwrap();
        assert!(saved > 0, "{report}");
        assert_eq!(whole["cells"].as_u64().unwrap() - saved, report["cells"].as_u64().unwrap());
        let [source, small] = ["chain.blif", "small.blif"].map(|name| read(&bench, name));
        assert_eq!(same_from_the_start(&source, &small), states);
        abc_agrees(&bench, "dsec", "chain.blif", "small.blif");
        let said = bench.run(&smaller);
        let line = format!("{states} of {} states are reachable: {saved} cells fewer; ", 1 << states);
        assert!(said.out.contains(&line), "{}", said.out);
    }
}

#[test]
fn relations_of_many_registers_are_proved_by_induction() {
    let bench = Bench::new();
    bench.file("chain.blif", one_hot(13));
    let arguments =
        ["synth", "chain.blif", "-o", "small.blif", "--cells", "all", "--reachable-only", "--effort", "fast"];
    let report = bench.run(&[&arguments[..], &["--format", "json"]].concat()).expect_json();
    let found = &report["unreachable"];
    assert!(found.get("states").is_none());
    // Of each pair at most one is 1, and one of all is.
    assert_eq!(found["relations"].as_array().unwrap().len(), 13 * 12 / 2 + 1);
    let saved = found["cells_saved"].as_u64().unwrap();
    assert!(saved > 0, "{report}");
    let [source, small] = ["chain.blif", "small.blif"].map(|name| read(&bench, name));
    assert_eq!(same_from_the_start(&source, &small), 13);
    let said = bench.run(&arguments);
    let line = format!("79 relations between registers hold in every reachable state: {saved} cells fewer; ");
    assert!(said.out.contains(&line), "{}", said.out);
}

#[test]
fn every_effort_and_run_gives_the_same_bytes() {
    let bench = Bench::new();
    bench.file("chain.blif", one_hot(5));
    for effort in ["fast", "normal"] {
        let written = ["one.blif", "two.blif"].map(|out| {
            let arguments =
                ["synth", "chain.blif", "-o", out, "--cells", "all", "--reachable-only", "--effort", effort];
            assert_eq!(bench.run(&arguments).status, 0);
            std::fs::read(bench.path().join(out)).unwrap()
        });
        assert_eq!(written[0], written[1]);
    }
}

/// A design of registers that are clocked by two clocks and both edges, with random gates between them.
fn design(registers: &[(bool, bool, bool)], gates: &[(u8, usize, usize)]) -> Design {
    let mut logic = Netlist::new("random");
    let mut nets: Vec<_> = ["x", "y"].map(|name| logic.add_input(name)).into();
    nets.extend((0..registers.len()).map(|at| logic.add_input(format!("s{at}"))));
    for &(bits, a, b) in gates {
        let pins = [nets[a % nets.len()], nets[b % nets.len()]];
        nets.push(logic.add_gate(Function::new(bits % 16), &pins));
    }
    logic.add_output("q", *nets.last().unwrap());
    let first = nets.len() - registers.len();
    (0..registers.len()).for_each(|at| _ = logic.add_output(format!("s{at}_next"), nets[first + at]));
    let register = |(at, &(falls, other, start)): (usize, &(bool, bool, bool))| Register {
        name: format!("s{at}"),
        kind: if falls { RegisterKind::Falling } else { RegisterKind::Rising },
        clock: Some(if other { "b" } else { "a" }.to_owned()),
        start: start.then_some(true),
        forcing: Forcing::Never,
    };
    Design::new(logic, registers.iter().enumerate().map(register).collect())
}

fn options() -> MapOptions {
    MapOptions { effort: Effort::Fast, ..MapOptions::default() }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_designs_stay_equal_in_reachable_states(
        registers in prop::collection::vec((any::<bool>(), any::<bool>(), any::<bool>()), 1..5),
        gates in prop::collection::vec((any::<u8>(), any::<usize>(), any::<usize>()), 5..30),
    ) {
        let source = design(&registers, &gates);
        let library = CellLibrary::uniform([Function::NAND, Function::NOT]);
        let (smaller, found) = simplify(&source, &library, &options()).unwrap();
        let reached = same_from_the_start(&source, &smaller);
        let (states, all) = found.states.unwrap();
        // The test lets a falling edge of one clock come with the other clock only.
        prop_assert!(states as usize >= reached && all == 1 << registers.len());
    }
}

#[test]
fn designs_with_latches_or_without_registers_count_every_state() {
    let library = CellLibrary::uniform([Function::NAND]);
    let mut one = design(&[(false, false, false)], &[(7, 0, 2)]);
    one.registers[0].kind = RegisterKind::High;
    let why = simplify(&one, &library, &options()).unwrap_err();
    assert_eq!(why, WhyEveryState::Latch("s0".to_owned()));
    let bench = Bench::new();
    bench.file("and.blif", ".model and\n.inputs a b\n.outputs q\n.names a b q\n11 1\n.end\n");
    let said = bench.run(&["synth", "and.blif", "--cells", "all", "--reachable-only"]);
    assert_eq!(said.status, 0);
    assert!(said.out.ends_with("every state counts: the design has no registers\n"), "{}", said.out);
}
