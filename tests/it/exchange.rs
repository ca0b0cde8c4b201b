//! Files for other tools read back, and proved to be the circuit that was written.

use std::collections::BTreeMap;

use nbc::circuit::formats::{CircuitFormat, Design, Register, RegisterKind, aiger, blif, dot};
use nbc::circuit::{Cell, Logic, Loops, NetId, Netlist, elaborate, prove};
use nbc::model::{Function, Instance};
use nbc::source::FileId;
use nbc::store::{self, DiskWorld};
use proptest::prelude::*;
use regex::Regex;

use crate::language::programs;
use crate::synth::has_yosys;
use crate::written::same;

/// Every circuit of the gallery that has a test, as it is written.
fn gallery() -> Vec<Netlist> {
    let mut found = Vec::new();
    for path in programs("circuits") {
        let checked = nbc::Session::new(DiskWorld).checked(path.to_str().unwrap());
        let tested: std::collections::BTreeSet<Instance> =
            checked.program.tests.iter().map(|test| test.circuit.clone()).collect();
        found.extend(tested.iter().map(|circuit| elaborate(&checked.program, circuit).unwrap()));
    }
    assert!(found.len() > 10, "the gallery has circuits");
    found
}

fn without_memory() -> Vec<Netlist> {
    let mut found = gallery();
    found.retain(|netlist| Loops::of(netlist).cores().is_empty());
    assert!(found.len() > 5, "the gallery has circuits without memory");
    found
}

fn alone(logic: Netlist) -> Design {
    Design { logic, registers: Vec::new() }
}

#[track_caller]
fn proved(one: &Netlist, two: &Netlist, text: &str) {
    prove(one, two).unwrap_or_else(|error| panic!("{error}\n{text}"));
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
                let function = Function::parse(label.split("\\n").next().unwrap()).unwrap();
                netlist.add_loose_cell(Cell { function, name: None, start: None, span: None })
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
    for netlist in without_memory() {
        let text = dot::write(&netlist);
        proved(&netlist, &undrawn(&text), &text);
    }
}

#[test]
fn the_gallery_reads_back_from_blif_and_aiger() {
    for netlist in without_memory() {
        let design = alone(netlist);
        let text = blif::write(&design);
        proved(&design.logic, &blif::read(&text, FileId(0), None).unwrap().logic, &text);
        for binary in [false, true] {
            let again = aiger::read(&aiger::write(&design, binary), None).unwrap();
            proved(&design.logic, &again.logic, "AIGER");
        }
    }
}

/// Reads Verilog that was written, through Yosys.
fn through_yosys(design: &Design) -> Design {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.v");
    std::fs::write(&path, CircuitFormat::Verilog.encode(design).unwrap()).unwrap();
    store::read_circuit(&path, None).unwrap_or_else(|faults| panic!("{:?}", faults.list))
}

#[test]
fn the_gallery_reads_back_from_verilog() {
    if !has_yosys() {
        return;
    }
    for netlist in without_memory().into_iter().filter(|netlist| netlist.cells().count() < 40) {
        let again = through_yosys(&alone(netlist.clone()));
        proved(&netlist, &again.logic, &netlist.name);
    }
}

/// Registers of these kinds, each of which takes a function of all registers and an input.
fn registers(kinds: &[(u8, Option<bool>)]) -> Design {
    let mut logic = Netlist::new("machine");
    let ports = ["d", "clk"].map(|name| logic.add_input(name));
    let states: Vec<_> = (0..kinds.len()).map(|at| logic.add_input(format!("s[{at}]"))).collect();
    let mut sum = ports[0];
    let mut nexts = Vec::new();
    for &state in &states {
        sum = logic.add_gate(Function::XOR, &[sum, state]);
        nexts.push(logic.add_gate(Function::NAND, &[sum, ports[0]]));
    }
    logic.add_output("y", sum);
    nexts.iter().enumerate().for_each(|(at, &next)| _ = logic.add_output(format!("s[{at}]_next"), next));
    let word = [RegisterKind::Rising, RegisterKind::Falling, RegisterKind::High, RegisterKind::Low];
    let register = |(at, &(kind, start)): (usize, &(u8, Option<bool>))| Register {
        name: format!("s[{at}]"),
        kind: word[usize::from(kind)],
        clock: Some("clk".to_owned()),
        start,
    };
    Design { logic, registers: kinds.iter().enumerate().map(register).collect() }
}

fn kinds(most: u8) -> impl Strategy<Value = Vec<(u8, Option<bool>)>> {
    proptest::collection::vec((0..most, proptest::option::of(any::<bool>())), 1..6)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn registers_read_back_from_blif(kinds in kinds(4)) {
        let design = registers(&kinds);
        let text = blif::write(&design);
        let again = blif::read(&text, FileId(0), None).unwrap();
        prop_assert_eq!(&again.registers, &design.registers);
        proved(&design.logic, &again.logic, &text);
    }

    #[test]
    fn registers_read_back_from_aiger(kinds in kinds(1)) {
        let design = registers(&kinds);
        for binary in [false, true] {
            let again = aiger::read(&aiger::write(&design, binary), None).unwrap();
            prop_assert_eq!(&again.registers, &design.registers);
            same(&design.logic, &again.logic, "AIGER");
        }
    }
}

#[test]
fn registers_read_back_from_verilog() {
    if !has_yosys() {
        return;
    }
    let design = registers(&[(0, Some(true)), (0, None), (1, Some(false)), (2, None), (3, None)]);
    let again = through_yosys(&design);
    let registers = |design: &Design| {
        let all = design.registers.iter().map(|register| (register.name.clone(), format!("{register:?}")));
        all.collect::<BTreeMap<_, _>>()
    };
    assert_eq!(registers(&again), registers(&design));
    let mut both = [Logic::new(&design.logic), Logic::new(&again.logic)];
    let names: Vec<_> = design.logic.inputs().iter().map(|&id| design.logic.net_name(id)).collect();
    for pattern in 0..1u32 << names.len() {
        let value = |name: &String| pattern >> names.iter().position(|known| known == name).unwrap() & 1 == 1;
        let mut shown = [&design, &again].into_iter().zip(&mut both).map(|(design, logic)| {
            let name = |&id: &NetId| design.logic.net_name(id);
            let inputs: Vec<bool> = design.logic.inputs().iter().map(|id| value(&name(id))).collect();
            design.logic.outputs().iter().map(name).zip(logic.settle(&inputs).unwrap()).collect::<BTreeMap<_, _>>()
        });
        assert_eq!(shown.next(), shown.next(), "{pattern:b}");
    }
}
