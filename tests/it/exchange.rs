//! Files for other tools read back, and proved to be the circuit that was written.

use std::collections::{BTreeMap, BTreeSet};

use nbc_base::model::{Function, Instance};
use nbc_base::source::FileId;
use nbc_circuit::formats::{CircuitFormat, Design, Forcing, RegisterKind, aiger, blif, buses, dot, pla};
use nbc_circuit::passes::{self, dissolve_wires};
use nbc_circuit::{Cell, Guarded, Logic, Loops, NetId, Netlist, RegisterNode, as_nands, elaborate, prove};
use nbc_session::store::{self, CircuitFile, DiskWorld, TopModule};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use regex::Regex;

use crate::support::*;
use crate::written::same;

fn gallery() -> Vec<Netlist> {
    let mut found = Vec::new();
    for path in programs("circuits") {
        let checked = nbc::Session::new(DiskWorld).checked(path.to_str().unwrap());
        let tested: std::collections::BTreeSet<Instance> =
            checked.program.tests.iter().map(|test| test.circuit.clone()).collect();
        found.extend(tested.iter().map(|circuit| as_nands(&elaborate(&checked.program, circuit).unwrap())));
    }
    assert!(found.len() > 10, "the gallery has circuits");
    found
}

fn by_memory() -> (Vec<Netlist>, Vec<Netlist>) {
    let (without, mut with): (Vec<_>, Vec<_>) =
        gallery().into_iter().partition(|netlist| Loops::of(netlist).cores().is_empty());
    // Without constants and buffers, as netlists are written: Yosys would give their nets the names of others.
    with.iter_mut().for_each(|netlist| passes::run(netlist).unwrap());
    assert!(without.len() > 5 && with.len() > 5, "the gallery has circuits with and without memory");
    (without, with)
}

#[test]
fn a_pla_that_was_written_is_the_same_circuit() {
    let small = |netlist: &Netlist| netlist.inputs().len() <= 12;
    let found: Vec<Netlist> = by_memory().0.into_iter().filter(small).collect();
    assert!(found.len() > 3, "the gallery has small circuits");
    for netlist in found {
        let text = String::from_utf8(CircuitFormat::Pla.encode(&alone(netlist.clone())).unwrap()).unwrap();
        let read = pla::read(&text, FileId(0)).unwrap_or_else(|faults| panic!("{faults:?}\n{text}"));
        proved(&netlist, &read.netlist, &text);
    }
    let (_, with) = by_memory();
    let message = CircuitFormat::Pla.encode(&alone(with[0].clone())).unwrap_err().message;
    assert_eq!(message, "PLA is logic without state, but the circuit has registers or loops");
}

fn alone(logic: Netlist) -> Design {
    Design::new(logic)
}

#[track_caller]
fn proved(one: &Netlist, two: &Netlist, text: &str) {
    prove(one, two).unwrap_or_else(|error| panic!("{error}\n{text}"));
}

/// Proves the logic between loops equal, and compares the loops themselves: their cells and guards, their start values,
/// and what they store over random inputs.
#[track_caller]
fn same_loops(one: &Netlist, mut two: Netlist, text: &str) {
    dissolve_wires(&mut two).unwrap();
    let proof = prove(one, &two).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(proof.cuts.len(), Loops::memory(one).cores().concat().len(), "{text}");
    assert_eq!(stored(&two), stored(one), "{text}");
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut both = [Logic::new(one), Logic::new(&two)];
    for _ in 0..100 {
        let inputs: Vec<bool> = one.inputs().iter().map(|_| random.random_range(0..2) == 1).collect();
        let [one, two] = &mut both;
        assert_eq!(one.settle(&inputs), two.settle(&inputs), "{text}");
    }
}

/// The cells that stay as written: how many there are of each role and function, and the names of those on loops with
/// their start values.
fn stored(netlist: &Netlist) -> (BTreeMap<String, usize>, BTreeMap<String, bool>) {
    let guarded = Guarded::of(netlist);
    let mut counts = BTreeMap::new();
    for (id, cell) in netlist.cells() {
        if let Some(role) = guarded.role(id) {
            *counts.entry(format!("{role:?} {}", cell.function)).or_default() += 1;
        }
    }
    let before = Logic::new(netlist);
    let on_loops = netlist.ids().filter(|&id| guarded.memory().contains(id));
    (counts, on_loops.map(|id| (netlist.net_name(id), before.value(id))).collect())
}

/// The netlist of a drawing: a node is its shape and label, an edge its ends and its pin.
fn undrawn(text: &str) -> Netlist {
    let quoted = |text: &str| text.replace("\\\"", "\"").replace("\\\\", "\\");
    let node = Regex::new(r#"(?m)^    n(\d+) \[label="((?:[^"\\]|\\.)*)"(?:, shape=(\w+))?.*\];$"#).unwrap();
    let edge = Regex::new(r#"(?m)^    n(\d+) -> n(\d+)(?: \[headlabel="(\d)"\])?;$"#).unwrap();
    let mut netlist = Netlist::new("drawn");
    let mut ids: BTreeMap<&str, NetId> = BTreeMap::new();
    let mut shown = Vec::new();
    for found in node.captures_iter(text) {
        let (key, label) = (found.get(1).unwrap().as_str(), &found[2]);
        let id = match found.get(3).map(|shape| shape.as_str()) {
            Some("triangle") => netlist.add_input(quoted(label)),
            Some("circle") => {
                shown.push((key, quoted(label)));
                continue;
            }
            Some(_) => netlist.add_constant(label == "1"),
            None => {
                let mut lines = label.split("\\n");
                let function = Function::parse(lines.next().unwrap()).unwrap();
                let name = lines.next().map(quoted);
                let start = lines.next().map(|start| start == "init 1");
                netlist.add_loose_cell(Cell { function, name, start, span: None })
            }
        };
        ids.insert(key, id);
    }
    for found in edge.captures_iter(text) {
        let pin = found.get(3).map_or(0, |pin| pin.as_str().parse().unwrap());
        match ids.get(&found[2]) {
            Some(&listener) => netlist.connect(listener, pin, ids[&found[1]]),
            None => {
                let (_, name) = shown.iter().find(|(key, _)| *key == &found[2]).unwrap();
                netlist.add_output(name.clone(), ids[&found[1]]);
            }
        }
    }
    netlist
}

#[test]
fn a_drawing_has_all_of_the_circuit() {
    for netlist in by_memory().0 {
        let text = dot::write(&netlist);
        proved(&netlist, &undrawn(&text), &text);
    }
}

#[test]
fn a_drawing_has_all_of_the_loops() {
    for netlist in by_memory().1 {
        let text = dot::write(&netlist);
        same_loops(&netlist, undrawn(&text), &text);
    }
}

#[test]
fn loops_of_the_gallery_read_back_from_blif() {
    for netlist in by_memory().1 {
        let text = blif::write(&alone(netlist.clone()));
        same_loops(&netlist, blif::read(&text, FileId(0), None).unwrap().netlist, &text);
    }
}

#[test]
fn loops_of_the_gallery_are_rejected_in_aiger() {
    for netlist in by_memory().1 {
        for format in [CircuitFormat::AigerBinary, CircuitFormat::AigerText] {
            let fault = format.encode(&alone(netlist.clone())).unwrap_err();
            assert_eq!(fault.message, "AIGER has no feedback loops");
            assert!(fault.help.unwrap().contains("write BLIF"));
        }
    }
}

/// The netlist with the bits of each port in the order of Yosys: the lowest first.
fn low_bits_first(netlist: &Netlist) -> Netlist {
    let ordered = |line: &str| {
        let names: Vec<String> = line.split(' ').skip(1).map(str::to_owned).collect();
        let places = buses::buses(&names, &BTreeSet::new()).into_iter().flat_map(|bus| bus.bits);
        let names: String = places.map(|place| format!(" {}", names[place])).collect();
        format!("{}{names}", line.split(' ').next().unwrap())
    };
    let text = blif::write(&alone(netlist.clone()));
    let is_port = |line: &str| line.starts_with(".inputs ") || line.starts_with(".outputs ");
    let lines = text.lines().map(|line| if is_port(line) { ordered(line) } else { line.to_owned() });
    let mut netlist = blif::read(&lines.collect::<Vec<_>>().join("\n"), FileId(0), None).unwrap().netlist;
    passes::run(&mut netlist).unwrap();
    netlist
}

fn through_verilog(design: &Design) -> Design {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.v");
    fs::write(&path, CircuitFormat::Verilog.encode(design).unwrap()).unwrap();
    let (top, clock) = (&TopModule::default(), None);
    let read = store::read_circuit(&CircuitFile { path: &path, others: &[], clock, top });
    let store::CircuitRead { design, warnings, .. } = read.unwrap_or_else(|faults| panic!("{:?}", faults.list));
    // A latch is written for Verilog 2005, which has no word for it.
    assert!(warnings.list.iter().all(|warning| warning.message.ends_with("is a latch")), "{:?}", warnings.list);
    design
}

#[test]
fn the_gallery_reads_back_from_verilog() {
    let Some(_) = SLANG.find() else { return };
    for netlist in by_memory().0.into_iter().filter(|netlist| netlist.cells().count() < 12) {
        let again = through_verilog(&alone(netlist.clone()));
        proved(&low_bits_first(&netlist), &again.netlist, &netlist.name);
    }
}

/// The netlist with the names that its loops have in Verilog: a cell that drives outputs has the name of the first.
fn named_for_verilog(mut netlist: Netlist) -> Netlist {
    let loops = Loops::memory(&netlist);
    let outputs: Vec<NetId> = netlist.outputs().iter().rev().copied().collect();
    for output in outputs {
        let (driver, name) = (netlist.pins(output)[0], netlist.net_name(output));
        if loops.contains(driver) {
            netlist.rename(driver, &name);
        }
    }
    netlist
}

#[test]
fn loops_of_the_gallery_read_back_from_verilog() {
    let Some(_) = SLANG.find() else { return };
    // Outputs of loops stay single bits, so only inputs can have another order.
    let has_buses = |netlist: &Netlist| netlist.inputs().iter().any(|&id| netlist.net_name(id).ends_with(']'));
    let ordered = |netlist: Netlist| if has_buses(&netlist) { low_bits_first(&netlist) } else { netlist };
    // A few: each takes Yosys a second.
    let even = by_memory().1.into_iter().filter(|netlist| netlist.cells().count() < 50).take(4);
    for netlist in even.map(ordered).map(named_for_verilog) {
        let text = String::from_utf8(CircuitFormat::Verilog.encode(&alone(netlist.clone())).unwrap()).unwrap();
        same_loops(&netlist, through_verilog(&alone(netlist.clone())).netlist, &text);
    }
}

/// Registers of these kinds, each of which takes a function of all registers and an input. Kinds from 4 on have a
/// reset, and those from 8 on a set, too.
fn registers(kinds: &[(u8, Option<bool>)]) -> Design {
    let mut netlist = Netlist::new("machine");
    let ports = ["d", "clk"].map(|name| netlist.add_input(name));
    let word = [RegisterKind::Rising, RegisterKind::Falling, RegisterKind::High, RegisterKind::Low];
    let forcing = [Forcing::Never, Forcing::ToStart, Forcing::SetReset];
    let node = |(at, &(kind, start)): (usize, &(u8, Option<bool>))| RegisterNode {
        kind: word[usize::from(kind % 4)],
        forcing: forcing[usize::from(kind / 4)],
        start: if kind / 4 == 1 { start.or(Some(false)) } else { start },
        name: Some(format!("s[{at}]")),
        span: None,
    };
    let states: Vec<_> = kinds.iter().enumerate().map(|kind| netlist.add_loose_register(node(kind))).collect();
    let mut sum = ports[0];
    let mut nexts = Vec::new();
    for &state in &states {
        sum = netlist.add_gate(Function::XOR, &[sum, state]);
        nexts.push(netlist.add_gate(Function::NAND, &[sum, ports[0]]));
    }
    netlist.add_output("y", sum);
    for ((&state, next), (kind, _)) in states.iter().zip(nexts).zip(kinds) {
        let forces = [vec![], vec![ports[0]], vec![sum, ports[0]]][usize::from(kind / 4)].clone();
        let pins = [next, ports[1]].into_iter().chain(forces);
        (0..).zip(pins).for_each(|(pin, net)| netlist.connect(state, pin, net));
    }
    Design::new(netlist)
}

/// Each register by its name, with the net that clocks it.
fn described(design: &Design) -> BTreeMap<String, (RegisterNode, String)> {
    let netlist = &design.netlist;
    let clock = |id: NetId| netlist.net_name(netlist.pins(id)[1]);
    netlist.registers().map(|(id, node)| (netlist.net_name(id), (node.clone(), clock(id)))).collect()
}

fn kinds(most: u8) -> impl Strategy<Value = Vec<(u8, Option<bool>)>> {
    proptest::collection::vec((0..most, proptest::option::of(any::<bool>())), 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn registers_read_back_from_blif(kinds in kinds(12)) {
        let design = registers(&kinds);
        let text = blif::write(&design);
        let again = blif::read(&text, FileId(0), None).unwrap();
        prop_assert_eq!(described(&again), described(&design));
        proved(&design.opened(), &again.opened(), &text);
    }

    #[test]
    fn registers_read_back_from_aiger(kinds in kinds(1)) {
        let design = registers(&kinds);
        for binary in [false, true] {
            let again = aiger::read(&aiger::write(&design, binary), None).unwrap();
            prop_assert_eq!(described(&again), described(&design));
            same(&design.opened(), &again.opened(), "AIGER");
        }
    }
}

#[test]
fn registers_read_back_from_verilog() {
    let Some(_) = SLANG.find() else { return };
    let kinds = [(0, Some(true)), (0, None), (1, Some(false)), (2, None), (3, None)];
    // Slang reads no register with a set and a reset.
    let forced = [(4, Some(true)), (5, Some(false))];
    let design = registers(&[&kinds[..], &forced].concat());
    let again = through_verilog(&design);
    // What starts anyhow starts at 0 in Verilog; BLIF has no start for a register with a set and a reset.
    let mut written = described(&design);
    for (register, _) in written.values_mut() {
        register.start = (register.forcing != Forcing::SetReset).then_some(register.starts_at());
    }
    assert_eq!(described(&again), written);
    let opened = [&design, &again].map(Design::opened);
    let mut both = [0, 1].map(|at| Logic::new(&opened[at]));
    let names = opened[0].net_names(opened[0].inputs());
    for pattern in 0..1u32 << names.len() {
        let value = |name: &String| pattern >> names.iter().position(|known| known == name).unwrap() & 1 == 1;
        let mut shown = opened.iter().zip(&mut both).map(|(opened, logic)| {
            let inputs: Vec<bool> = opened.net_names(opened.inputs()).iter().map(value).collect();
            let outputs = opened.net_names(opened.outputs()).into_iter();
            let mut shown: BTreeMap<_, _> = outputs.zip(logic.settle(&inputs).unwrap()).collect();
            // A reset is stronger than a set, which need not be the same then.
            let reset = |name: &String| shown.get(&name.replace("_set", "_reset")).copied().unwrap_or(false);
            let hidden: Vec<_> = shown.keys().filter(|&name| name.ends_with("_set") && reset(name)).cloned().collect();
            hidden.iter().for_each(|name| _ = shown.insert(name.clone(), false));
            shown
        });
        assert_eq!(shown.next(), shown.next(), "{pattern:b}");
    }
}
