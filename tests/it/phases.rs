//! Static timing by phases: what is recognized as a register, and whether the holds and the times of clocks suffice for
//! any delays of the cells.

use std::collections::BTreeMap;

use nbc_base::model::{Function, Instance};
use nbc_circuit::timing::ClockTimes;
use nbc_circuit::{
    CellKind, CellLibrary, Delayed, Guarded, NetId, Netlist, RegisterForm, Role, Timing, WhyUnphased, elaborate, lower,
    map,
};
use nbc_session::store::DiskWorld;
use nbc_session::{CompileOptions, Session};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::memory::{CLOCK, ENABLE, Element, elements, libraries, mapped, next, program, text};

use crate::support::*;

/// A clock for each cell: one to three cycles, and at most two for cells that compute an enable.
fn kinds(netlist: &Netlist, random: &mut ChaCha8Rng) -> BTreeMap<NetId, CellKind> {
    let guarded = Guarded::of(netlist);
    let most = |id| if guarded.role(id) == Some(Role::Control) { 2 } else { 3 };
    let kind = |id| (id, CellKind::uniform(random.random_range(1..=most(id)), 1.0));
    netlist.ids().map(kind).collect()
}

/// The netlist with a random delay for each cell, of at most its clock.
fn delayed(netlist: &Netlist, kinds: &BTreeMap<NetId, CellKind>, random: &mut ChaCha8Rng) -> Delayed {
    Delayed::new(netlist, |id| random.random_range(1..=kinds[&id].clock) as usize)
}

/// Switches the clock, or any of the other inputs, and asserts that nothing changes after the static hold.
fn settles_within_the_hold(elements: &[Element], netlist: &Netlist, random: &mut ChaCha8Rng) {
    let kinds = kinds(netlist, random);
    let hold = Timing::with(netlist, |id| &kinds[&id]).hold as usize;
    let mut delayed = delayed(netlist, &kinds, random);
    let mut inputs = [false; 4];
    delayed.run(&inputs, 2 * hold + 40);
    for _ in 0..16 {
        match random.random_range(0..4) {
            0 | 1 => inputs[CLOCK] ^= true,
            2 => inputs[ENABLE] ^= true,
            _ => (0..2).for_each(|data| inputs[data] ^= random.random_range(0..2) == 1),
        }
        // A cell of one cycle changes in the cycle after the switch.
        let settled = delayed.run(&inputs, hold + 1);
        for cycle in 0..40 {
            assert_eq!(delayed.run(&inputs, 1), settled, "{cycle} after {hold}\n{}{netlist}", text(elements));
        }
    }
}

/// Runs a circuit at the least times of its clock, and asserts that every register stores what it is to.
fn works_at_the_least_times(elements: &[Element], netlist: &Netlist, random: &mut ChaCha8Rng) {
    let kinds = kinds(netlist, random);
    let timing = Timing::with(netlist, |id| &kinds[&id]);
    let all = ClockTimes::all(netlist, &timing.storage, timing.hold, |id| &kinds[&id]);
    let Some(times) = all.iter().find(|times| times.clock == netlist.net_name(netlist.inputs()[CLOCK])) else { return };
    assert!(times.races.is_empty(), "an inverter of at most two cycles is no risk\n{netlist}");
    let data = netlist.net_names(&netlist.inputs()[..2]);
    let most = |of: fn(&nbc_circuit::timing::InputTimes) -> u32| {
        times.inputs.iter().filter(|input| data.contains(&input.input)).map(of).max().unwrap_or(0) as usize
    };
    let (setup, hold) = (most(|input| input.setup), most(|input| input.hold));
    let (high, low) = match random.random_range(0..3) {
        0 => (times.high, times.period - times.high),
        1 => (times.period - times.low, times.low),
        _ => (times.half, times.half),
    };
    let mut delayed = delayed(netlist, &kinds, random);
    let mut inputs = [false; 4];
    let mut state: Vec<bool> = elements.iter().map(|element| element.start).collect();
    next(elements, &inputs, &inputs, &mut state);
    let rest = timing.hold as usize + 40;
    delayed.run(&inputs, rest);
    let switch = |inputs: &mut [bool; 4], input: usize, state: &mut Vec<bool>| {
        let before = *inputs;
        inputs[input] ^= true;
        next(elements, &before, inputs, state);
    };
    if random.random_range(0..2) == 1 {
        switch(&mut inputs, ENABLE, &mut state);
        delayed.run(&inputs, rest);
    }
    for _ in 0..random.random_range(1..20) {
        switch(&mut inputs, CLOCK, &mut state);
        delayed.run(&inputs, high as usize);
        switch(&mut inputs, CLOCK, &mut state);
        match random.random_range(0..3) {
            0 => {
                delayed.run(&inputs, hold);
                switch(&mut inputs, random.random_range(0..2), &mut state);
                delayed.run(&inputs, setup.max((low as usize).saturating_sub(hold)));
            }
            _ => drop(delayed.run(&inputs, low as usize)),
        }
    }
    let found = delayed.run(&inputs, timing.hold as usize);
    assert_eq!(found, state, "{times:?}\n{}{netlist}", text(elements));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rows_settle_within_the_static_hold_and_registers_work_at_the_least_times(elements in elements(), seed: u64) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for library in libraries() {
            let netlist = mapped(&text(&elements), &library);
            for _ in 0..4 {
                settles_within_the_hold(&elements, &netlist, &mut random);
                works_at_the_least_times(&elements, &netlist, &mut random);
            }
        }
    }
}

#[test]
fn a_clock_of_memory_whose_state_depends_on_delays_has_no_times() {
    let body = "circuit memory(d, e) -> (q, r) {\n    q init 0 = if e then d else q\n    r = latch(d, e)\n}\n";
    let [library, ..] = libraries();
    let netlist = mapped(body, &library);
    let timing = Timing::of(&netlist, &library);
    assert!(timing.storage.unphased.iter().any(|unphased| unphased.why == WhyUnphased::Race), "{netlist}");
    let times = ClockTimes::all(&netlist, &timing.storage, timing.hold, library.kinds_of(&netlist));
    assert_eq!(times, []);
}

/// The timing of a circuit called `memory`, mapped onto cells of one cycle, and the names of nets.
#[track_caller]
fn check(body: &str, library: &CellLibrary, latches: usize, flip_flops: usize, unphased: &[WhyUnphased]) -> u32 {
    let netlist = mapped(body, library);
    let timing = Timing::of(&netlist, library);
    let storage = &timing.storage;
    let why: Vec<WhyUnphased> = storage.unphased.iter().map(|unphased| unphased.why).collect();
    assert_eq!(
        (storage.latches.len(), storage.flip_flops.len(), &why[..]),
        (latches, flip_flops, unphased),
        "{netlist}"
    );
    timing.hold
}

#[test]
fn registers_and_latches_are_recognized_in_any_library() {
    for library in libraries() {
        check("circuit memory(a, en) -> (q) {\n    q = latch(a, en)\n}\n", &library, 1, 0, &[]);
        check("circuit memory(a, en) -> (q) {\n    q = latch(a, not en)\n}\n", &library, 1, 0, &[]);
        check("circuit memory(a, clk) -> (q[3]) {\n    q = register({a, q[2..1]}, clk)\n}\n", &library, 6, 3, &[]);
        check("circuit memory(clk) -> (q) {\n    q = register(not q, clk)\n}\n", &library, 2, 1, &[]);
        check("circuit memory(clk) -> (q) {\n    q = register[start = 1](0, clk)\n}\n", &library, 2, 1, &[]);
        check("circuit memory(a, b, clk) -> (q) {\n    q = register(a, clk and b)\n}\n", &library, 2, 1, &[]);
        let paper = "circuit memory(d, e) -> (q) {\n    q init 0 = nand(nand(d, e), nq)\n    nq init 1 = \
                     nand(nand(not d, e), q)\n}\n";
        check(paper, &library, 1, 0, &[]);
    }
}

#[test]
fn other_memory_is_timed_as_a_loop_and_says_why() {
    let nand = &libraries()[0];
    let set_reset = "circuit memory(s, r) -> (q) {\n    q init 0 = nand(s, nq)\n    nq init 1 = nand(r, q)\n}\n";
    assert_eq!(check(set_reset, nand, 0, 0, &[WhyUnphased::NoEnable]), 4);
    let choice = "circuit memory(d, e) -> (q) {\n    q init 0 = if e then d else q\n}\n";
    check(choice, nand, 0, 0, &[WhyUnphased::Race]);
    let ring = "circuit memory() -> (q) {\n    q init 0 = not q\n}\n";
    check(ring, nand, 0, 0, &[WhyUnphased::NoEnable]);
    let open = "circuit memory(en) -> (q) {\n    q = latch(not q, en)\n}\n";
    check(open, nand, 1, 0, &[WhyUnphased::StaysOpen]);
}

#[test]
fn a_glitch_may_change_a_closed_latch() {
    let mut library = libraries()[0].clone();
    library.insert(Function::NAND, CellKind { glitches: true, ..CellKind::uniform(1, 1.0) });
    let netlist = mapped("circuit memory(a, en) -> (q) {\n    q = latch(a, en)\n}\n", &library);
    let timing = Timing::of(&netlist, &library);
    assert!(matches!(timing.storage.unphased[..], [ref one] if matches!(one.why, WhyUnphased::Glitch(_))));
}

#[test]
fn more_enables_than_are_tried_stay_open() {
    let mut body = String::from("circuit memory(a, e[5]) -> (q[5]) {\n");
    (0..5).for_each(|i| body += &format!("    q[{i}] = latch(a, e[{i}])\n"));
    check(&(body + "}\n"), &libraries()[0], 5, 0, &[WhyUnphased::ManyEnables]);
}

#[test]
fn a_slow_inverter_of_the_clock_is_a_race_between_registers() {
    let mut library = libraries()[0].clone();
    let races = |library: &CellLibrary| {
        let netlist = mapped("circuit memory(a, clk) -> (q[2]) {\n    q = register({q[0], a}, clk)\n}\n", library);
        let timing = Timing::of(&netlist, library);
        let times = ClockTimes::all(&netlist, &timing.storage, timing.hold, library.kinds_of(&netlist));
        times.iter().map(|times| times.races.len()).sum::<usize>()
    };
    assert_eq!(races(&library), 0);
    library.insert(Function::NOT, CellKind::uniform(3, 1.0));
    assert_eq!(races(&library), 1);
}

/// The static hold of the first circuit with a test in a file of the gallery, with the shipped robots.
fn hold_of(file: &str) -> u32 {
    let mut session = Session::new(DiskWorld);
    let checked = session.checked(root().join("circuits").join(file).to_str().unwrap());
    let circuit = &checked.program.tests[0].circuit;
    let mapping = checked.map(circuit, &CompileOptions::default()).unwrap();
    Timing::of(&mapping.netlist, &mapping.cells).hold
}

#[test]
fn the_static_holds_of_the_gallery_end_at_closed_latches() {
    let holds = [
        ("counter.nb", 12),
        ("d_flip_flop.nb", 9),
        ("latch.nb", 4),
        ("lfsr.nb", 8),
        ("ripple_adder.nb", 19),
        ("sequence_detector.nb", 11),
        ("sr_latch.nb", 4),
        ("t_flip_flop.nb", 8),
    ];
    for (file, most) in holds {
        let hold = hold_of(file);
        assert!(hold <= most, "{file}: {hold} cycles by static timing, expected {most} at most");
    }
    assert!(hold_of("computer.nb") < 40);
}

#[test]
fn a_path_ends_at_a_closed_latch() {
    let program = program("circuit memory(clk) -> (q) {\n    q = register(not not not q, clk)\n}\n");
    let library = CellLibrary::uniform([Function::NAND, Function::NOT]);
    let netlist = map(&elaborate(&program, &Instance::from("memory")).unwrap(), &library).unwrap();
    let netlist = lower(&netlist, &library, RegisterForm::Nands).unwrap();
    let timing = Timing::of(&netlist, &library);
    let path: Vec<String> = timing.critical_path.iter().map(|&id| netlist.net_name(id)).collect();
    assert_eq!(path.len() as u32, timing.hold + 1, "each cell takes one cycle: {path:?}");
    let nets: std::collections::BTreeSet<&String> = path.iter().collect();
    assert_eq!(nets.len(), path.len(), "a change passes no net twice: {path:?}");
}

const SHIFT: &str = "circuit shift(a, clk) -> (q[3]) {\n    q = register({q[1..0], a}, clk)\n}\n\n\
                     test shift {\n    a clk | q\n    1 0 | 000\n    1 ^ | 001\n}\n";

#[test]
fn the_times_of_a_clock_are_printed() {
    let bench = Bench::with("shift.nb", SHIFT);
    let told = bench.run("build shift.nb --cells nand,not --emit timing").out;
    let expected = "\
        clock    clk: high 4, low 4, period 9 cycles at least\n\
        input    a: stable 3 cycles before clk rises, 1 after\n\
        path     input to register 0 cycles: a\n";
    assert!(told.starts_with("timing   settles within 11 cycles: clk -> "), "{told}");
    assert!(told.contains("\npath     register to register "), "{told}");
    assert!(told.contains(expected), "{told}");
}

#[test]
fn latches_that_are_not_made_of_one_robot_are_reported() {
    let bench = Bench::new();
    let reset = "circuit kept(d, r, clk) -> (q) {\n    q = async_register(d, clk, r)\n}\n";
    bench.file("kept.nb", format!("{reset}swarm s {{ circuit: kept, library: three, registers: mux }}\n"));
    let told = bench.run("build kept.nb --emit timing").out;
    assert!(told.contains("stays as written: it is set or reset without its clock\n"), "{told}");
    let report = validate("build", &bench.run("build kept.nb --format json").out);
    assert!(!report["phases"]["kept"].as_array().unwrap().is_empty());
}

#[test]
fn the_page_and_the_json_of_a_run_have_the_clocks() {
    let bench = Bench::with("shift.nb", SHIFT);
    let ran = bench.run("run shift.nb --format json");
    let report = validate("run", &ran.out);
    assert_eq!(report["tests"][0]["timing"]["phases"]["clocks"][0]["clock"], "clk");
    let page = bench.read("out/shift/report.html");
    assert!(page.contains("clock    clk: high "), "the page has the times of the clock");
}
