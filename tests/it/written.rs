//! Files written for other tools and in the language: valid unique names, formatted programs, the same function.

use nbc_base::model::{Function, Instance};
use nbc_base::source::{FileId, MemoryWorld, Sources};
use nbc_circuit::formats::{CircuitFormat, Design, Forcing, RegisterKind, aiger, blif, buses};
use nbc_circuit::{Logic, NetId, Netlist, RegisterNode, elaborate};
use nbc_lang::{check, syntax};
use nbc_session::store;
use proptest::prelude::*;

/// Names that some format cannot read, or that become equal when they are made valid.
const NAMES: &[&str] = &[
    "a", "b", "a b", "a_b", "a\tb", "", "_", "__", "n_", "net", "log2", "if", "init", "and", "circuit", "test", "use",
    "wire", "always", "logic", "1", "1'b1", "$true", "$false", "q[0]", "q[1]", "q_0_", "\u{1b}[m", "l\nb", "größe",
    "#", "\\", "x=y", "NIL", "\"", "a/b", "register", "all", "begin", "module", "n5", "n6", "*/", "`define",
];

/// A network of gates with two inputs, whose nets have names of the list.
fn netlists() -> impl Strategy<Value = Netlist> {
    let name = || 0..NAMES.len();
    let gate = (0..16u8, 0..100usize, 0..100usize, proptest::option::of(name()));
    let gates = proptest::collection::vec(gate, 0..12);
    let outputs = proptest::collection::vec((0..100usize, name()), 1..5);
    (name(), proptest::collection::vec(name(), 1..5), gates, outputs).prop_map(|(title, inputs, gates, outputs)| {
        let mut netlist = Netlist::new(NAMES[title]);
        let mut nets: Vec<_> = inputs.into_iter().map(|name| netlist.add_input(NAMES[name])).collect();
        for (bits, a, b, name) in gates {
            let net = netlist.add_gate(Function::new(bits), &[nets[a % nets.len()], nets[b % nets.len()]]);
            name.into_iter().for_each(|name| netlist.rename(net, NAMES[name]));
            nets.push(net);
        }
        for (net, name) in outputs {
            netlist.add_output(NAMES[name], nets[net % nets.len()]);
        }
        netlist
    })
}

/// Whether two netlists give the same outputs, port by port, for every input.
pub fn same(one: &Netlist, two: &Netlist, text: &str) {
    let orders = [one.inputs(), one.outputs()].map(|ports| (0..ports.len()).collect::<Vec<_>>());
    same_in_order(one, two, &orders, text);
}

/// Like [`same`], where the ports of the second are those of the first in these orders.
pub fn same_in_order(one: &Netlist, two: &Netlist, [ins, outs]: &[Vec<usize>; 2], text: &str) {
    let bits = one.inputs().len();
    let (mut first, mut second) = (Logic::new(one), Logic::new(two));
    for pattern in 0..1u32 << bits {
        let inputs: Vec<bool> = (0..bits).map(|bit| pattern >> bit & 1 == 1).collect();
        let moved: Vec<bool> = ins.iter().map(|&place| inputs[place]).collect();
        let expected = first.settle(&inputs).map(|found| outs.iter().map(|&place| found[place]).collect::<Vec<_>>());
        assert_eq!(expected, second.settle(&moved), "at {inputs:?}\n{text}");
    }
}

/// The order of ports in a program, whose buses have their highest bit first.
pub fn order(netlist: &Netlist, ports: &[NetId]) -> Vec<usize> {
    let names: Vec<String> = ports.iter().map(|&id| netlist.net_name(id)).collect();
    buses::buses(&names, &std::collections::BTreeSet::new())
        .into_iter()
        .flat_map(|bus| bus.bits.into_iter().rev())
        .collect()
}

/// The text of a design as a program, checked to be formatted, and its circuit.
fn as_program(design: &Design) -> (String, Netlist) {
    let text = String::from_utf8(store::encode_circuit(design, CircuitFormat::Nb).unwrap()).unwrap();
    let mut sources = Sources::default();
    let file = sources.add("written.nb", text.clone());
    let parsed = syntax::parse(&sources, file);
    assert_eq!(parsed.errors, [], "{text}");
    assert_eq!(syntax::format(&sources, file, &parsed.tree), text);
    let checked = check::check(&MemoryWorld::default(), &mut sources, file);
    assert!(!checked.has_errors(), "{:?}\n{text}", checked.diagnostics);
    let own = checked.program.circuits.iter().find(|circuit| circuit.span.file == file).unwrap();
    let netlist = elaborate(&checked.program, &Instance::from(own.name.as_str())).unwrap();
    (text, netlist)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn written_programs_are_formatted_and_equivalent(netlist in netlists()) {
        let design = Design::new(netlist);
        let (text, again) = as_program(&design);
        let orders = [design.netlist.inputs(), design.netlist.outputs()].map(|ports| order(&design.netlist, ports));
        same_in_order(&design.netlist, &again, &orders, &text);
    }

    #[test]
    fn blif_and_aiger_with_any_names_read_back_the_same(netlist in netlists()) {
        let design = Design::new(netlist);
        let text = blif::write(&design);
        let again = blif::read(&text, FileId(0), None).unwrap_or_else(|faults| panic!("{faults:?}\n{text}"));
        same(&design.netlist, &again.netlist, &text);
        for binary in [false, true] {
            let bytes = aiger::write(&design, binary);
            let again = aiger::read(&bytes, None).unwrap_or_else(|fault| panic!("{fault:?}"));
            same(&design.netlist, &again.netlist, "AIGER");
        }
    }

    #[test]
    fn verilog_names_are_legal_and_different(netlist in netlists()) {
        let ports = netlist.inputs().len() + netlist.outputs().len();
        let design = Design::new(netlist);
        let text = String::from_utf8(CircuitFormat::Verilog.encode(&design).unwrap()).unwrap();
        assert!(text.chars().all(|c| c == '\n' || c == ' ' || c.is_ascii_graphic()), "{text}");
        let head = text.lines().next().unwrap();
        // An escaped name and the plain one are the same name.
        let mut names = std::collections::BTreeSet::new();
        let mut bits = 0;
        for port in head.split_once('(').unwrap().1.split("put ").skip(1) {
            let (range, name) = port.strip_prefix('[').and_then(|port| port.split_once("] ")).unwrap_or(("0:0", port));
            let (high, low) = range.split_once(':').unwrap();
            bits += high.parse::<usize>().unwrap() + 1 - low.parse::<usize>().unwrap();
            let name = name.trim_start_matches('\\').split([' ', ',']).next().unwrap();
            assert!(names.insert(name.trim_end_matches(");").to_owned()), "{head}");
        }
        assert_eq!(bits, ports, "{head}");
    }
}

#[test]
fn a_model_without_outputs_is_not_a_program() {
    let mut logic = Netlist::new("silent");
    logic.add_input("a");
    let fault = store::encode_circuit(&Design::new(logic), CircuitFormat::Nb).unwrap_err();
    assert_eq!(fault.message, "`silent` has no outputs, but a circuit of a .nb file needs one");
}

/// Four registers of one clock after an inverting shift, and one bit of each other kind.
fn with_registers() -> Design {
    let mut netlist = Netlist::new("shift");
    let ports = ["d", "clk"].map(|name| netlist.add_input(name));
    let names = ["q[0]", "q[1]", "q[2]", "q[3]", "falling", "high", "low"];
    let kinds = [RegisterKind::Falling, RegisterKind::High, RegisterKind::Low];
    let mut states = Vec::new();
    for (at, name) in names.iter().enumerate() {
        states.push(netlist.add_loose_register(RegisterNode {
            kind: at.checked_sub(4).map_or(RegisterKind::Rising, |at| kinds[at]),
            forcing: Forcing::Never,
            start: Some(at % 2 == 1),
            name: Some((*name).to_owned()),
            span: None,
        }));
    }
    (0..4).for_each(|bit| _ = netlist.add_output(format!("q[{bit}]"), states[bit]));
    (4..7).for_each(|at| _ = netlist.add_output(format!("{}_out", names[at]), states[at]));
    let before = [ports[0], states[0], states[1], states[2], states[3], ports[0], ports[0]];
    for (&state, before) in states.iter().zip(before) {
        let next = netlist.add_gate(Function::NOT, &[before]);
        (0..).zip([next, ports[1]]).for_each(|(pin, net)| netlist.connect(state, pin, net));
    }
    Design::new(netlist)
}

#[test]
fn registers_become_calls_that_do_the_same() {
    let design = with_registers();
    let (text, again) = as_program(&design);
    let head = "circuit shift(d, clk) -> (q[4], falling_out, high_out, low_out) {\n";
    assert!(text.starts_with(head), "{text}");
    for call in
        [" = register[start = 10](q_next, clk)", "= register(falling_next, not clk)", "= latch[start = 1](", "= latch("]
    {
        assert!(text.contains(call), "`{call}` is not in\n{text}");
    }
    let made = &design.netlist;
    let (mut first, mut second) = (Logic::new(made), Logic::new(&again));
    let outs = order(made, made.outputs());
    for row in 0..40u32 {
        // The data changes while the clock is 0, a row after it falls.
        let inputs = [(row / 4).wrapping_mul(0x9e37_79b9) >> 16 & 1 == 1, matches!(row % 4, 1 | 2)];
        let expected = first.settle(&inputs).unwrap();
        let expected: Vec<bool> = outs.iter().map(|&place| expected[place]).collect();
        assert_eq!(second.settle(&inputs).unwrap(), expected, "row {row}\n{text}");
    }
}
