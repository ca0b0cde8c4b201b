//! Circuits as transition systems: their steps, monitors, comparison, and environments.

use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::elaborate::MemoryPorts;
use crate::example::flip_flop;
use crate::passes::dissolve_wires;
use crate::properties::system::is_on;
use crate::waves::{ClockRun, ClockStep};
use crate::{Environment, Logic, NetId, Netlist, Settled};
use nbc_base::model::{Function, Property, PropertyKind};
use nbc_base::source::{CancelFlag, Sources, Span};

fn property(kind: PropertyKind, has_condition: bool, within: Option<usize>, before: usize) -> Property {
    let span = Span::new(Sources::default().add("a.nb", ""), 0, 0);
    Property { kind, text: String::new(), span, line: 1, has_condition, within, before }
}

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
fn found(made: Monitored) -> Vec<PropertyVerdict> {
    PropertySearch::new(made.system, SearchBudget::default(), CancelFlag::default()).finish()
}

fn refused(circuit: &Netlist, monitor: &Netlist, property: Property) -> NoSteps {
    Monitored::of(circuit, monitor, &[property], None, &CancelFlag::default()).unwrap_err()
}

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
    let found = found(made);
    assert!(matches!(found[0], PropertyVerdict::Proved(_)), "{found:?}");
    let PropertyVerdict::Refuted(run) = &found[1] else { panic!("the output follows at once") };
    assert_eq!(run.inputs.len(), 2);
    let PropertyVerdict::Refuted(run) = &found[2] else { panic!("it stores a 1") };
    assert_eq!(run.inputs, [[false], [true]]);
}

#[test]
fn a_property_cannot_read_the_clock() {
    let reads = monitor(3, |_, p| vec![p[1]]);
    let error = refused(&stored(), &reads, property(PropertyKind::Always, false, None, 0));
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
    let found = found(monitored(&netlist, &follows, &properties));
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
    let found = found(made);
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
    let error = refused(&netlist, &shows, property(PropertyKind::Never, false, None, 0));
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
    let found = found(monitored(&netlist, &says, &[assume, never]));
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
    let found = found(made);
    let PropertyVerdict::Refuted(run) = &found[0] else { panic!("three is both") };
    assert_eq!(run.inputs, [[true, true, true]]);
}

fn compared(one: &Netlist, two: &Netlist) -> PropertyVerdict {
    found(Monitored::of_two([one, two], &CancelFlag::default()).unwrap()).remove(0)
}

fn agree(one: &Netlist, two: &Netlist, random: &mut ChaCha8Rng) -> bool {
    let inputs = one.inputs().len();
    let [mut one, mut two] = [one, two].map(Logic::new);
    (0..300).all(|_| {
        let mut row: Vec<bool> = (0..inputs).map(|_| random.random()).collect();
        [false, true].into_iter().all(|clock| {
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
        dissolve_wires(&mut plain).unwrap();
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
        let found = found(made);
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
        found(made).remove(0)
    };
    assert!(matches!(verdict(true), PropertyVerdict::Proved(_)));
    assert!(matches!(verdict(false), PropertyVerdict::Refuted(_)));
}
