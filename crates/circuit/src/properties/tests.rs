//! Random machines: what a search says against a search through all their states.

use std::collections::BTreeSet;

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::and_graph::AndGraph;
use crate::elaborate::MemoryPorts;
use crate::passes::DissolveWires;
use crate::properties::bounded::{Bounded, Induction};
use crate::properties::cubes::Cube;
use crate::properties::frames::{Found, Frames};
use crate::properties::needed::needed;
use crate::properties::pairs::never_together;
use crate::properties::system::is_on;
use crate::registers::flip_flop;
use crate::waves::{ClockRun, ClockStep};
use crate::{Environment, Logic, NetId, Netlist, Settled};
use nbc_base::model::{Function, Property, PropertyKind};
use nbc_base::source::{CancelFlag, Sources, Span};

/// A random machine of one to eight registers.
fn random_system(random: &mut ChaCha8Rng) -> TransitionSystem {
    let mut draw = |bound: usize| (random.next_u32() as usize) % bound;
    let (inputs, registers) = (draw(4), 1 + draw(8));
    let mut graph = AndGraph::new(inputs + registers);
    let mut literals: Vec<usize> = (0..inputs + registers).map(|at| graph.source(at)).collect();
    for _ in 0..3 + draw(30) {
        let pins = [literals[draw(literals.len())] ^ draw(2), literals[draw(literals.len())] ^ draw(2)];
        let made = match draw(3) {
            0 => graph.function(Function::XOR, pins),
            _ => graph.and(pins[0], pins[1]),
        };
        literals.push(made);
    }
    let starts: Vec<Option<bool>> = (0..registers)
        .map(|_| match draw(12) {
            0 => None,
            value => Some(value % 4 == 1),
        })
        .collect();
    // Late literals depend on much.
    let late = |random: &mut ChaCha8Rng| {
        let back = (random.next_u32() as usize % literals.len()).min(random.next_u32() as usize % literals.len());
        literals[literals.len() - 1 - back] ^ (random.next_u32() & 1) as usize
    };
    let register = |(at, start): (usize, Option<bool>)| SystemRegister { name: format!("r{at}"), start, next: 0 };
    let mut registers: Vec<SystemRegister> = starts.into_iter().enumerate().map(register).collect();
    registers.iter_mut().for_each(|register| register.next = late(random));
    let mut rare = |random: &mut ChaCha8Rng, parts: usize| {
        let parts: Vec<usize> = (0..parts).map(|_| late(random)).collect();
        parts.into_iter().fold(1, |all, one| graph.and(all, one))
    };
    let bad = (0..1 + random.next_u32() % 3).map(|_| rare(random, 3)).collect();
    let constraints = (0..random.next_u32() % 2).map(|_| rare(random, 2) ^ 1).collect();
    TransitionSystem {
        inputs: (0..inputs).map(|at| format!("i{at}")).collect(),
        registers,
        ands: graph.ands.clone(),
        bad,
        constraints,
    }
}

fn bits(number: usize, count: usize) -> Vec<bool> {
    (0..count).map(|bit| number >> bit & 1 == 1).collect()
}

/// For each property, the number of steps of a shortest violation, found by going through all states.
fn exhaustive(system: &TransitionSystem) -> Vec<Option<usize>> {
    explored(system).0
}

/// The number of steps of a shortest violation of each property, and all states that are reached.
fn explored(system: &TransitionSystem) -> (Vec<Option<usize>>, BTreeSet<Vec<bool>>) {
    let all = |state: &Vec<bool>| -> Vec<Vec<bool>> {
        (0..1 << system.inputs.len()).map(|inputs| system.values(&bits(inputs, system.inputs.len()), state)).collect()
    };
    let states = (0..1 << system.registers.len()).map(|state| bits(state, system.registers.len()));
    let mut front: BTreeSet<Vec<bool>> = states.filter(|state| system.may_start(state)).collect();
    let mut seen = front.clone();
    let mut found = vec![None; system.bad.len()];
    let mut steps = 0;
    while !front.is_empty() {
        steps += 1;
        let mut next = BTreeSet::new();
        for values in front.iter().flat_map(all) {
            if !system.constraints.iter().all(|&constraint| is_on(&values, constraint)) {
                continue;
            }
            for (found, &bad) in found.iter_mut().zip(&system.bad) {
                if found.is_none() && is_on(&values, bad) {
                    *found = Some(steps);
                }
            }
            let state = system.next(&values);
            if seen.insert(state.clone()) {
                next.insert(state);
            }
        }
        front = next;
    }
    (found, seen)
}

fn check(system: &TransitionSystem, what: &str) {
    let expected = exhaustive(system);
    let search = PropertySearch::new(system.clone(), SearchBudget::default(), CancelFlag::default());
    for (property, (verdict, expected)) in search.finish().into_iter().zip(&expected).enumerate() {
        match verdict {
            PropertyVerdict::Refuted(run) => {
                assert_eq!(Some(run.inputs.len()), *expected, "{what}: {system:?}");
                assert_eq!(system.violation(property, &run), Some(run.inputs.len() - 1), "{what}: {system:?}");
            }
            PropertyVerdict::Proved(_) => assert_eq!(*expected, None, "{what}: {system:?}"),
            PropertyVerdict::Undecided { .. } => panic!("{what} is undecided: {system:?}"),
        }
    }
    for (property, expected) in expected.into_iter().enumerate() {
        let mut frames = Frames::new(system, property, (Vec::new(), Vec::new()), CancelFlag::default());
        let found = loop {
            match frames.advance(system) {
                Found::Nothing => {}
                Found::Violation(run) => break Some(system.violation(property, &run).unwrap() + 1),
                Found::Invariant(_) => break None,
            }
        };
        assert_eq!(found.is_some(), expected.is_some(), "the invariant of {what}: {system:?}");
        assert!(found >= expected, "the run of {what}: {system:?}");
    }
}

#[test]
fn ten_thousand_random_machines_are_decided_as_by_their_states() {
    let mut random = ChaCha8Rng::seed_from_u64(60);
    let (mut proved, mut refuted) = (0, 0);
    for machine in 0..10_000 {
        let system = random_system(&mut random);
        check(&system, &format!("machine {machine}"));
        let found = exhaustive(&system);
        refuted += found.iter().flatten().count();
        proved += found.iter().filter(|found| found.is_none()).count();
    }
    assert!(proved > 10_000 && refuted > 5_000, "{proved} properties proved, {refuted} refuted");
}

#[test]
fn induction_alone_decides_what_it_says_it_does() {
    let mut random = ChaCha8Rng::seed_from_u64(61);
    let mut proved = 0;
    for _ in 0..300 {
        let system = random_system(&mut random);
        let expected = exhaustive(&system);
        let mut bounded = Bounded::new(&system, CancelFlag::default());
        let mut induction = Induction::new(&system, CancelFlag::default());
        let mut open: BTreeSet<usize> = (0..system.bad.len()).collect();
        while induction.steps < 10 {
            induction.extend(&system);
            while bounded.step < induction.steps {
                if let Some((property, run)) = bounded.advance(&system, &open, u64::MAX) {
                    assert_eq!(Some(run.inputs.len()), expected[property]);
                    open.remove(&property);
                }
            }
            for property in induction.proved(&system, &open, u64::MAX).unwrap() {
                assert_eq!(expected[property], None, "{system:?}");
                open.remove(&property);
                proved += 1;
            }
        }
    }
    assert!(proved > 100, "{proved} were proved");
}

#[test]
fn registers_that_never_have_some_values_together_have_them_in_no_state() {
    let mut random = ChaCha8Rng::seed_from_u64(65);
    let mut found = [0; 2];
    for _ in 0..300 {
        let system = random_system(&mut random);
        let (_, states) = explored(&system);
        for cube in never_together(&system, &CancelFlag::default()).0 {
            let is_in = |state: &Vec<bool>| cube.iter().all(|&(at, value)| state[at] == value);
            assert!(!states.iter().any(is_in), "{cube:?}: {system:?}");
            found[cube.len() - 1] += 1;
        }
    }
    assert!(found.iter().all(|&count| count > 100), "{found:?} cubes of one and two registers");
}

#[test]
fn an_invariant_has_only_the_clauses_that_it_needs() {
    // The last place of a ring with one 1 excludes the first; the places between them matter, and the counter does not.
    let mut system = counter(4, 9, 15);
    let registers = system.registers.len();
    let place = |at: usize| 2 * (registers + 1 + at % 4);
    let ring = (0..4).map(|at| SystemRegister { name: format!("r{at}"), start: Some(at == 0), next: place(at + 3) });
    let shifted = |literal: usize| if literal / 2 > registers { literal + 8 } else { literal };
    system.ands.iter_mut().flatten().for_each(|pin| *pin = shifted(*pin));
    system.registers.iter_mut().for_each(|register| register.next = shifted(register.next));
    system.registers.extend(ring);
    system.ands.push([place(3), place(0)]);
    system.bad = vec![2 * (registers + 4 + system.ands.len())];
    let pairs = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
    let mut cubes: Vec<Cube> =
        pairs.iter().map(|pair| pair.iter().map(|at| (registers + at, true)).collect()).collect();
    cubes.insert(2, vec![(0, true), (1, true), (2, true), (3, true)]);
    let kept = needed(&system, 0, &[], cubes, &CancelFlag::default());
    let expected: Vec<Cube> =
        [[0, 1], [0, 3], [1, 2], [2, 3]].iter().map(|pair| pair.map(|at| (registers + at, true)).to_vec()).collect();
    assert_eq!(kept, expected);
}

#[test]
fn a_wrong_proof_is_found() {
    let mut random = ChaCha8Rng::seed_from_u64(62);
    let mut wrong = 0;
    for _ in 0..300 {
        let system = random_system(&mut random);
        let violated: Vec<usize> =
            exhaustive(&system).iter().enumerate().filter(|(_, found)| found.is_some()).map(|(at, _)| at).collect();
        for property in violated {
            let together = BTreeSet::from([property]);
            for steps in 1..4 {
                assert!(!InductiveProof::Steps { steps, together: together.clone() }.proves(&system, property));
            }
            let clauses =
                system.registers.iter().enumerate().filter_map(|(at, register)| Some(vec![(at, register.start?)]));
            for clauses in [Vec::new(), clauses.collect()] {
                let given = BTreeSet::new();
                assert!(!InductiveProof::Invariant { clauses, given }.proves(&system, property), "{system:?}");
            }
            wrong += 1;
        }
    }
    assert!(wrong > 50, "{wrong} properties are violated");
}

/// A counter of so many bits that begins again after `last`.
fn counter(bits: usize, last: usize, wrong: usize) -> TransitionSystem {
    let mut graph = AndGraph::new(bits);
    let state: Vec<usize> = (0..bits).map(|at| graph.source(at)).collect();
    let is = |graph: &mut AndGraph, number: usize| {
        state
            .iter()
            .enumerate()
            .fold(1, |all, (bit, &literal)| graph.and(all, literal ^ usize::from(number >> bit & 1 == 0)))
    };
    let (end, bad) = (is(&mut graph, last), is(&mut graph, wrong));
    let mut carry = 1;
    let mut registers = Vec::new();
    for (bit, &literal) in state.iter().enumerate() {
        let sum = graph.function(Function::XOR, [literal, carry]);
        carry = graph.and(literal, carry);
        registers.push(SystemRegister { name: format!("c{bit}"), start: Some(false), next: graph.and(sum, end ^ 1) });
    }
    TransitionSystem { inputs: Vec::new(), registers, ands: graph.ands, bad: vec![bad], constraints: Vec::new() }
}

#[test]
fn counters_stay_below_their_end_and_reach_it() {
    let decide =
        |system| PropertySearch::new(system, SearchBudget::default(), CancelFlag::default()).finish().remove(0);
    assert!(matches!(decide(counter(8, 99, 200)), PropertyVerdict::Proved(_)));
    let PropertyVerdict::Refuted(run) = decide(counter(8, 99, 99)) else { panic!("it is reached") };
    assert_eq!(run.inputs.len(), 100);
}

#[test]
fn a_search_ends_with_its_budget_and_does_the_same_again() {
    let budget = SearchBudget { steps: 20, work: 300 };
    let search = || {
        let mut search = PropertySearch::new(counter(16, 40_000, 39_999), budget, CancelFlag::default());
        while !search.is_done() {
            search.advance();
        }
        (search.work(), search.verdicts())
    };
    let (work, verdicts) = search();
    assert!(matches!(verdicts[0], PropertyVerdict::Undecided { steps } if steps > 0), "{verdicts:?}");
    assert_eq!(search(), (work, verdicts));
}

fn property(kind: PropertyKind, has_condition: bool, within: Option<usize>, before: usize) -> Property {
    let span = Span::new(Sources::default().add("a.nb", ""), 0, 0);
    Property { kind, text: String::new(), span, line: 1, has_condition, within, before }
}

/// A monitor of a circuit: `said` adds gates to its inputs, the ports and a clock, and returns its outputs.
fn monitor(ports: usize, said: impl Fn(&mut Netlist, &[NetId]) -> Vec<NetId>) -> Netlist {
    let mut netlist = Netlist::new("monitor");
    let inputs: Vec<NetId> = (0..=ports).map(|at| netlist.add_input(format!("p{at}"))).collect();
    for (at, net) in said(&mut netlist, &inputs).into_iter().enumerate() {
        netlist.add_output(format!("o{at}"), net);
    }
    netlist
}

fn monitored(circuit: &Netlist, monitor: &Netlist, properties: &[Property]) -> Monitored {
    Monitored::of(circuit, monitor, properties, None, &CancelFlag::default()).unwrap()
}

/// A register of one bit that stores `d`.
fn stored() -> Netlist {
    let mut netlist = Netlist::new("stored");
    let [d, clock] = ["d", "clk"].map(|name| netlist.add_input(name));
    let q = flip_flop(&mut netlist, "q", d, clock, false);
    netlist.add_output("q", q);
    netlist
}

#[test]
fn steps_of_a_clocked_circuit_are_rows_of_a_test() {
    // After the first step, the output is the input of the same step: a rise has stored it.
    let same = monitor(3, |netlist, p| {
        let before = flip_flop(netlist, "before", p[0], p[3], false);
        let differs = netlist.add_gate(Function::XOR, &[p[0], p[2]]);
        let stays = netlist.add_gate(Function::XOR, &[before, p[2]]);
        vec![differs, stays, p[2]]
    });
    let kinds = [(PropertyKind::Never, 1), (PropertyKind::Never, 1), (PropertyKind::Never, 0)];
    let properties = kinds.map(|(kind, before)| property(kind, false, None, before));
    let made = monitored(&stored(), &same, &properties);
    assert_eq!((&made.ports[..], made.clock), (&[0][..], Some(StepClock { input: 1, rises: true })));
    let found = PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish();
    assert!(matches!(found[0], PropertyVerdict::Proved(_)), "{found:?}");
    let PropertyVerdict::Refuted(run) = &found[1] else { panic!("the output follows at once") };
    assert_eq!(run.inputs.len(), 2);
    let PropertyVerdict::Refuted(run) = &found[2] else { panic!("it stores a 1") };
    assert_eq!(run.inputs, [[false], [true]]);
}

#[test]
fn a_property_cannot_read_the_clock() {
    let reads = monitor(3, |_, p| vec![p[1]]);
    let always = [property(PropertyKind::Always, false, None, 0)];
    let error = Monitored::of(&stored(), &reads, &always, None, &CancelFlag::default()).unwrap_err();
    assert_eq!(error, NoSteps::ClockHasNoValue { clock: "p1".to_owned() });
}

#[test]
fn what_must_follow_within_some_steps_may_follow_in_the_last_one() {
    // A chain of three registers: what goes in comes out after three rises.
    let mut netlist = Netlist::new("chain");
    let [d, clock] = ["d", "clk"].map(|name| netlist.add_input(name));
    let q = (0..3).fold(d, |data, at| flip_flop(&mut netlist, &format!("q{at}"), data, clock, false));
    netlist.add_output("q", q);
    let follows = monitor(3, |_, p| vec![p[0], p[2], p[0], p[2]]);
    let properties = [2, 1].map(|steps| property(PropertyKind::Always, true, Some(steps), 1));
    let made = monitored(&netlist, &follows, &properties);
    let found = PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish();
    assert!(matches!(found[0], PropertyVerdict::Proved(_)), "{found:?}");
    let PropertyVerdict::Refuted(run) = &found[1] else { panic!("it takes two steps more") };
    assert_eq!(run.inputs, [[false], [true], [false]]);
}

#[test]
fn steps_without_a_clock_are_settled_rows() {
    let netlist = crate::example::latch();
    // `d`, `e`, `q`, `nq`, and the clock: `q` follows `d` while `e` is 1, and stays while it is 0.
    let says = monitor(4, |netlist, p| {
        let before = flip_flop(netlist, "before", p[2], p[4], false);
        let differs = netlist.add_gate(Function::XOR, &[p[0], p[2]]);
        let follows = netlist.add_gate(Function::AND, &[differs, p[1]]);
        let changes = netlist.add_gate(Function::XOR, &[before, p[2]]);
        let closed = netlist.add_gate(Function::NOT, &[p[1]]);
        let escapes = netlist.add_gate(Function::AND, &[changes, closed]);
        let both = netlist.add_gate(Function::XNOR, &[p[2], p[3]]);
        vec![follows, escapes, both]
    });
    let properties = [0, 1, 0].map(|before| property(PropertyKind::Never, false, None, before));
    let made = monitored(&netlist, &says, &properties);
    assert_eq!(made.clock, None);
    let found = PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish();
    assert!(matches!(found[..], [PropertyVerdict::Proved(_), _, PropertyVerdict::Proved(_)]), "{found:?}");
    // When `d` and `e` change in one row, the cells decide, as in a test at the level of logic.
    let mut logic = Logic::new(&netlist);
    if let PropertyVerdict::Refuted(run) = &found[1] {
        let shown: Vec<bool> = run.inputs.iter().map(|row| logic.settle(row).unwrap()[0]).collect();
        assert_ne!(shown[shown.len() - 2], shown[shown.len() - 1], "{run:?}");
    }
}

#[test]
fn a_ring_has_no_steps() {
    let mut netlist = Netlist::new("ring");
    let wire = netlist.add_wire("q", Some(false), None);
    let gate = netlist.add_gate(Function::NOT, &[wire]);
    netlist.drive(wire, 0, gate);
    netlist.add_output("q", gate);
    let shows = monitor(1, |_, p| vec![p[0]]);
    let never = [property(PropertyKind::Never, false, None, 0)];
    let error = Monitored::of(&netlist, &shows, &never, None, &CancelFlag::default()).unwrap_err();
    assert!(matches!(error, NoSteps::Unsettled { .. }), "{error:?}");
}

#[test]
fn a_latch_that_must_not_be_set_and_reset_has_steps_where_that_is_assumed() {
    let mut netlist = Netlist::new("set_reset");
    let [ns, nr] = ["ns", "nr"].map(|name| netlist.add_input(name));
    let wires = [("q", false), ("nq", true)].map(|(name, start)| netlist.add_wire(name, Some(start), None));
    let q = netlist.add_gate(Function::NAND, &[ns, wires[1]]);
    let nq = netlist.add_gate(Function::NAND, &[nr, wires[0]]);
    [q, nq].into_iter().zip(wires).for_each(|(net, wire)| netlist.drive(wire, 0, net));
    [q, nq].into_iter().for_each(|net| _ = netlist.add_output("q", net));
    let says = monitor(4, |netlist, p| {
        let both = netlist.add_gate(Function::NOR, &[p[0], p[1]]);
        vec![both, netlist.add_gate(Function::XNOR, &[p[2], p[3]])]
    });
    let [never, assume] = [PropertyKind::Never, PropertyKind::Assume].map(|kind| property(kind, false, None, 0));
    let error =
        Monitored::of(&netlist, &says, &[never.clone(), never.clone()], None, &CancelFlag::default()).unwrap_err();
    assert!(matches!(error, NoSteps::Unsettled { .. }), "{error:?}");
    let says = monitor(4, |netlist, p| {
        let one = netlist.add_gate(Function::OR, &[p[0], p[1]]);
        vec![one, netlist.add_gate(Function::XNOR, &[p[2], p[3]])]
    });
    let made = monitored(&netlist, &says, &[assume, never]);
    let found = PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish();
    assert!(matches!(found[..], [PropertyVerdict::Proved(_)]), "{found:?}");
}

#[test]
fn the_steps_of_random_circuits_are_what_their_cells_do() {
    let mut random = ChaCha8Rng::seed_from_u64(63);
    for _ in 0..60 {
        let source = crate::example::random_machine(&mut random);
        let outputs = source.outputs().len();
        let inputs = source.inputs().len();
        let shows = monitor(inputs + outputs, |_, p| p[inputs..inputs + outputs].to_vec());
        let properties: Vec<Property> = (0..outputs).map(|_| property(PropertyKind::Never, false, None, 0)).collect();
        let made = monitored(&source, &shows, &properties);
        let system = &made.system;
        let mut state: Vec<bool> = system.registers.iter().map(|register| register.start.unwrap()).collect();
        let step = ClockStep::of(&source).unwrap();
        let (clock, mut run) = (step.clock, ClockRun::new(step));
        let mut logic = Logic::new(&source);
        for at in 0..12 {
            let row: Vec<bool> = (0..inputs).map(|_| random.random()).collect();
            let free: Vec<bool> = made.ports.iter().map(|&port| row[port]).collect();
            let values = system.values(&free, &state);
            let shown: Vec<bool> = system.bad.iter().map(|&bad| is_on(&values, bad)).collect();
            run.apply(&row.iter().map(|&bit| if bit { !0 } else { 0 }).collect::<Vec<u64>>());
            let with_clock = |value: bool| -> Vec<bool> {
                row.iter().enumerate().map(|(port, &bit)| if Some(port) == clock { value } else { bit }).collect()
            };
            let mut expected = logic.settle(&with_clock(false)).unwrap();
            if at > 0 {
                run.advance();
                expected = logic.settle(&with_clock(true)).unwrap();
            }
            assert_eq!(shown, expected, "step {at} of\n{source}");
            let also: Vec<bool> = (0..outputs).map(|port| run.output(port) & 1 == 1).collect();
            assert_eq!(shown, also);
            state = system.next(&values);
        }
    }
}

#[test]
fn circuits_without_memory_have_no_state() {
    let netlist = crate::example::full_adder();
    let mut settled = Settled::new(&netlist);
    assert_eq!(settled.apply(&[&[true, true, false]])[0].outputs, [false, true]);
    let both = monitor(5, |netlist, p| vec![netlist.add_gate(Function::AND, &[p[3], p[4]])]);
    let made = monitored(&netlist, &both, &[property(PropertyKind::Never, false, None, 0)]);
    assert!(made.system.registers.is_empty() && made.clock.is_none());
    let found = PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish();
    let PropertyVerdict::Refuted(run) = &found[0] else { panic!("three is both") };
    assert_eq!(run.inputs, [[true, true, true]]);
}

/// What is known of the equality of two circuits.
fn compared(one: &Netlist, two: &Netlist) -> PropertyVerdict {
    let made = Monitored::of_two([one, two], &CancelFlag::default()).unwrap();
    PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish().remove(0)
}

/// Whether two circuits show the same in random steps.
fn agree(one: &Netlist, two: &Netlist, random: &mut ChaCha8Rng) -> bool {
    let inputs = one.inputs().len();
    let [mut one, mut two] = [one, two].map(Logic::new);
    (0..300).all(|_| {
        let mut row: Vec<bool> = (0..inputs).map(|_| random.random()).collect();
        [false, true].into_iter().all(|clock| {
            // The clock is the last input of a random machine.
            row[inputs - 1] = clock;
            one.settle(&row) == two.settle(&row)
        })
    })
}

#[test]
fn random_circuits_are_equal_to_themselves_without_wires_and_rarely_to_others() {
    let mut random = ChaCha8Rng::seed_from_u64(64);
    let mut different = 0;
    for _ in 0..150 {
        let source = crate::example::random_machine(&mut random);
        let mut plain = source.clone();
        DissolveWires.run_on(&mut plain).unwrap();
        assert!(matches!(compared(&source, &plain), PropertyVerdict::Proved(_)), "{source}");
        let other = crate::example::random_machine(&mut random);
        if other.inputs().len() != source.inputs().len() || other.outputs().len() != source.outputs().len() {
            continue;
        }
        match compared(&source, &other) {
            PropertyVerdict::Proved(_) => assert!(agree(&source, &other, &mut random), "{source}{other}"),
            PropertyVerdict::Refuted(_) => different += 1,
            verdict @ PropertyVerdict::Undecided { .. } => panic!("{verdict:?}: {source}{other}"),
        }
    }
    assert!(different > 10, "{different} are different");
}

#[test]
fn circuits_of_different_steps_are_not_compared() {
    let inverted = |rises: bool| {
        let mut netlist = Netlist::new("one");
        let [d, clock] = ["d", "clk"].map(|name| netlist.add_input(name));
        let edge = if rises { clock } else { netlist.add_gate(Function::NOT, &[clock]) };
        let q = flip_flop(&mut netlist, "q", d, edge, false);
        netlist.add_output("q", q);
        netlist
    };
    let reads = {
        let mut netlist = Netlist::new("and");
        let [d, clock] = ["d", "clk"].map(|name| netlist.add_input(name));
        let q = netlist.add_gate(Function::AND, &[d, clock]);
        netlist.add_output("q", q);
        netlist
    };
    let compare = |one: &Netlist, two: &Netlist| Monitored::of_two([one, two], &CancelFlag::default());
    for two in [inverted(false), reads] {
        assert_eq!(compare(&inverted(true), &two).unwrap_err(), (1, NoSteps::OtherSteps));
    }
    // A circuit that stores when its clock falls is compared with another one of that kind.
    let falls = compare(&inverted(false), &inverted(false)).unwrap();
    assert_eq!(falls.clock, Some(StepClock { input: 1, rises: false }));
    let mut constant = Netlist::new("zero");
    let _ = ["d", "clk"].map(|name| constant.add_input(name));
    let zero = constant.add_constant(false);
    constant.add_output("q", zero);
    let PropertyVerdict::Refuted(run) = compared(&stored(), &constant) else { panic!("it stores a 1") };
    assert_eq!(run.inputs, [[false], [true]]);
}

/// An environment of a random machine: a memory of four bits, which gives `i0`. The outputs are addresses and data.
fn memory_beside(circuit: &Netlist, random: &mut ChaCha8Rng) -> (Netlist, Vec<MemoryPorts>) {
    let mut netlist = Netlist::new("memory");
    let outputs = 0..circuit.outputs().len();
    let mut nets: Vec<NetId> = outputs.map(|at| netlist.add_input(format!("o{at}"))).collect();
    let clock = netlist.add_input("clk");
    let word = netlist.add_input("word");
    let first = nets[0];
    nets.push(flip_flop(&mut netlist, "stored", first, clock, false));
    let read = netlist.add_gate(Function::XOR, &[word, nets[nets.len() - 1]]);
    netlist.add_output("i0", if random.random() { read } else { word });
    for at in 0..6 {
        let net = nets[random.next_u32() as usize % nets.len()];
        netlist.add_output(format!("memory {at}"), net);
    }
    netlist.add_output("memory clk", clock);
    let word = nets.len()..nets.len() + 1;
    let (reads, writes) = (vec![[1..3, word]], vec![[3..5, 5..6, 6..7, 7..8]]);
    (netlist, vec![MemoryPorts { memory: 0, words: 3, width: 1, reads, writes }])
}

/// Whether a circuit and its environment violate a property in random steps: each is said of an input or output port.
fn is_violated(
    circuit: &Netlist,
    beside: &(Netlist, Vec<MemoryPorts>),
    said: &[(usize, bool)],
    random: &mut ChaCha8Rng,
) -> bool {
    let mut run = ClockRun::new(ClockStep::of(circuit).unwrap());
    let mut environment = Environment::new(&beside.0, beside.1.clone(), vec![Vec::new()]).unwrap();
    let inputs = circuit.inputs().len();
    (0..60).any(|step| {
        let mut row: Vec<u64> = (0..inputs).map(|_| if random.random() { u64::MAX } else { 0 }).collect();
        row[inputs - 1] = 0;
        let shown = |run: &ClockRun| (0..circuit.outputs().len()).map(|at| run.output(at) & 1 == 1).collect::<Vec<_>>();
        for _ in 0..9 {
            run.apply(&row);
            environment.apply(&[shown(&run), vec![false]].concat()).unwrap();
            row[0] = if environment.outputs().next().unwrap() { u64::MAX } else { 0 };
        }
        if step > 0 {
            environment.advance();
            run.advance();
        }
        let values = [row.iter().map(|&word| word & 1 == 1).collect(), shown(&run)].concat();
        said.iter().all(|&(port, value)| values[port] == value)
    })
}

#[test]
fn what_is_proved_beside_a_memory_holds_for_what_it_stores() {
    let mut random = ChaCha8Rng::seed_from_u64(66);
    let (mut proved, mut refuted, mut seen) = (0, 0, 0);
    while proved < 300 {
        let circuit = crate::example::random_machine(&mut random);
        let is_clocked = ClockStep::of(&circuit).is_ok_and(|step| step.clock.is_some());
        if !is_clocked || circuit.inputs().len() < 2 {
            continue;
        }
        let beside = memory_beside(&circuit, &mut random);
        let environment = EnvironmentStep::new(&beside.0, beside.1.clone(), vec![true]).unwrap();
        let inputs = circuit.inputs().len();
        let ports = inputs + circuit.outputs().len();
        let free: Vec<usize> = (0..ports).filter(|&port| port != inputs - 1).collect();
        let pairs = free.iter().flat_map(|&a| free.iter().map(move |&b| [a, b]));
        let said: Vec<[(usize, bool); 2]> =
            pairs.map(|ports| ports.map(|port| (port, random.random()))).take(8).collect();
        let says = monitor(ports, |netlist, p| {
            let inverted = p.iter().map(|&net| netlist.add_gate(Function::NOT, &[net])).collect::<Vec<_>>();
            let on = |(port, value): (usize, bool)| if value { p[port] } else { inverted[port] };
            said.iter().map(|&[a, b]| netlist.add_gate(Function::AND, &[on(a), on(b)])).collect()
        });
        let properties = vec![property(PropertyKind::Never, false, None, 0); said.len()];
        let cancel = CancelFlag::default();
        let made = match Monitored::of(&circuit, &says, &properties, Some(&environment), &cancel) {
            Ok(made) => made,
            Err(why) => {
                assert_eq!(why, NoSteps::Circle);
                continue;
            }
        };
        let found = PropertySearch::new(made.system, SearchBudget::default(), cancel).finish();
        for (verdict, said) in found.iter().zip(&said) {
            let is_violated = (0..20).any(|_| is_violated(&circuit, &beside, said, &mut random));
            match verdict {
                PropertyVerdict::Proved(_) => {
                    assert!(!is_violated, "{said:?} of\n{circuit}{}", beside.0);
                    proved += 1;
                }
                _ => {
                    refuted += 1;
                    seen += usize::from(is_violated);
                }
            }
        }
    }
    // Words that nothing could have stored refute some.
    assert!(seen * 10 > refuted * 8, "{seen} of {refuted} were seen");
}

#[test]
fn a_memory_that_begins_with_zeros_shows_them_until_others_are_stored() {
    let mut netlist = Netlist::new("reader");
    let [i, clock] = ["i0", "clk"].map(|name| netlist.add_input(name));
    let o = flip_flop(&mut netlist, "o", i, clock, false);
    netlist.add_output("o0", o);
    let mut beside = Netlist::new("memory");
    let [o, clock, word] = ["o0", "clk", "word"].map(|name| beside.add_input(name));
    for (name, net) in [("i0", word), ("read", o), ("at", o), ("data", o), ("enable", o), ("clk", clock)] {
        beside.add_output(name, net);
    }
    let (reads, writes) = (vec![[1..2, 2..3]], vec![[2..3, 3..4, 4..5, 5..6]]);
    let memories = vec![MemoryPorts { memory: 0, words: 2, width: 1, reads, writes }];
    let says = monitor(3, |_, p| vec![p[0]]);
    let never = [property(PropertyKind::Never, false, None, 0)];
    let verdict = |is_empty: bool| {
        let environment = EnvironmentStep::new(&beside, memories.clone(), vec![is_empty]).unwrap();
        let made = Monitored::of(&netlist, &says, &never, Some(&environment), &CancelFlag::default()).unwrap();
        PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish().remove(0)
    };
    assert!(matches!(verdict(true), PropertyVerdict::Proved(_)));
    assert!(matches!(verdict(false), PropertyVerdict::Refuted(_)));
}
