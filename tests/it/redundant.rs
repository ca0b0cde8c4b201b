//! Registers that a design does not need are removed, and the outputs stay the same.

use nbc_base::model::Function;
use nbc_circuit::correspondence::reduce;
use nbc_circuit::formats::{Design, Forcing, RegisterKind};
use nbc_circuit::network::View;
use nbc_circuit::{NetId, Netlist, RegisterNode};
use proptest::prelude::*;

use crate::support::*;

/// Two bits that count twice, a bit that stays 0, and a bit that nothing reads.
const REDUNDANT: &str = "\
INPUT(en)
OUTPUT(q1)
OUTPUT(q3)
OUTPUT(q4)
q0 = DFF(n0)
q1 = DFF(n1)
n0 = XOR(q0, en)
c = AND(q0, en)
n1 = XOR(q1, c)
q2 = DFF(n2)
q3 = DFF(n3)
n2 = XOR(en, q2)
d = NAND(q2, en)
nd = NOT(d)
n3 = XOR(nd, q3)
q4 = DFF(n4)
n4 = AND(q4, en)
q5 = DFF(n5)
n5 = OR(q5, en)
";

#[test]
fn synthesis_names_the_registers_that_it_removes() {
    let bench = Bench::with("twice.bench", REDUNDANT);
    let arguments = ["synth", "twice.bench", "-o", "once.blif", "--cells", "nand,not"];
    let ran = bench.run(&arguments);
    let lines = ["that never change: q4 = 0\n", "that equal another: q2 = q0, q3 = q1\n", "that no output needs: q5\n"];
    for line in lines {
        assert!(ran.out.contains(&format!("registers {line}")), "{}", ran.out);
    }
    let report = bench.run(&[&arguments[..], &["--format", "json"]].concat()).expect_json();
    assert_eq!(report["latches"], 2);
    assert_eq!(
        report["removed"],
        json!({ "constant": { "q4": 0 }, "equal": { "q2": "q0", "q3": "q1" }, "unused": ["q5"] })
    );
    abc_agrees(&bench, "dsec", "twice.bench", "once.blif");
}

#[test]
fn a_program_uses_a_circuit_without_them() {
    let bench = Bench::with("twice.bench", REDUNDANT);
    bench.file("once.nb", "use \"twice.bench\"\n");
    let cells = |circuit: &str| {
        let built = bench.run(&["build", "once.nb", "--circuit", circuit, "--cells", "nand,not", "--format", "json"]);
        built.expect_json()["cells"].as_array().unwrap().len()
    };
    // Two registers of nine cells each, and two exclusive ors and an and: the other registers would need 36 more.
    assert!(cells("twice") < 32, "{}", cells("twice"));
}

/// A machine of registers, each given by a function and the two nets that it reads: an input, or a register, whose
/// clock and start.
type Recipe = Vec<(u8, usize, usize, bool, Option<bool>)>;

fn recipe() -> impl Strategy<Value = Recipe> {
    let register = (0u8..16, 0usize..9, 0usize..9, any::<bool>(), any::<Option<bool>>());
    proptest::collection::vec(register, 1..8)
}

fn machine(recipe: &Recipe) -> Design {
    let mut netlist = Netlist::new("machine");
    let mut nets: Vec<NetId> = ["x", "y"].map(|name| netlist.add_input(name)).to_vec();
    for (at, &(.., falls, start)) in recipe.iter().enumerate() {
        let kind = if falls { RegisterKind::Falling } else { RegisterKind::Rising };
        let (forcing, name) = (Forcing::Never, Some(format!("s{at}")));
        nets.push(netlist.add_loose_register(RegisterNode { kind, forcing, start, name, span: None }));
    }
    let net = |at: usize| nets[at % nets.len()];
    let nexts: Vec<NetId> =
        recipe.iter().map(|&(bits, a, b, ..)| netlist.add_gate(Function::new(bits), &[net(a), net(b)])).collect();
    let parity = nets[2..].iter().copied().reduce(|sum, state| netlist.add_gate(Function::XOR, &[sum, state]));
    netlist.add_output("parity", parity.unwrap());
    netlist.add_output("last", *nets.last().unwrap());
    let clock = netlist.add_input("clk");
    for (&state, next) in nets[2..].iter().zip(nexts) {
        (0..).zip([next, clock]).for_each(|(pin, net)| netlist.connect(state, pin, net));
    }
    Design { clocks: 1, ..Design::new(netlist) }
}

/// The outputs over time for these inputs in 64 runs; registers of both edges change in turns.
fn outputs(design: &Design, inputs: &[[u64; 2]]) -> Vec<Vec<u64>> {
    let ids: Vec<NetId> = design.netlist.registers().map(|(id, _)| id).collect();
    let network = View::of(&design.netlist, &ids).unwrap().network;
    let filled = |value: bool| if value { !0 } else { 0 };
    let mut states: Vec<u64> = design.netlist.registers().map(|(_, register)| filled(register.starts_at())).collect();
    let mut shown = Vec::new();
    for (at, inputs) in inputs.iter().enumerate() {
        let values = network.simulate(&inputs.iter().chain(&[0]).chain(&states).copied().collect::<Vec<_>>());
        let output: Vec<u64> = network.outputs.iter().map(|&output| values[output as usize]).collect();
        let (ports, pins) = output.split_at(design.netlist.outputs().len());
        shown.push(ports.to_vec());
        for ((state, (_, register)), pins) in states.iter_mut().zip(design.netlist.registers()).zip(pins.chunks(2)) {
            if (register.kind == RegisterKind::Falling) == (at % 2 == 1) {
                *state = pins[0];
            }
        }
    }
    shown
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn outputs_stay_the_same(
        recipe in recipe(),
        inputs in proptest::collection::vec(any::<[u64; 2]>(), 40),
        copies in 1usize..3,
    ) {
        // Copies read the same registers, so that many are equal.
        let recipe: Recipe = recipe.iter().cycle().take(recipe.len() * copies).cloned().collect();
        let design = machine(&recipe);
        let (reduced, removed) = reduce(&design);
        let count = removed.constant.len() + removed.equal.len() + removed.unused.len();
        let [left, all] = [&reduced, &design].map(|design| design.netlist.registers().count());
        prop_assert_eq!(left + count, all);
        prop_assert!(copies == 1 || left <= all / 2);
        prop_assert_eq!(outputs(&reduced, &inputs), outputs(&design, &inputs));
        prop_assert!(reduce(&reduced).1.is_empty());
    }
}

#[test]
fn the_circuit_is_shown_after_each_pass_that_changes_it() {
    let bench = Bench::with("a.nb", "circuit a(x, y) -> (q, r) {\n    q = x and (y or 1)\n    r = not (x and y)\n}\n");
    let told = bench.run("build a.nb --emit passes").out;
    insta::assert_snapshot!(told, @r"
    as written: 4 cells
    netlist a(x, y) -> (q, r) {
        n3 = or(y, 1)
        q = and(x, n3)
        n5 = and(x, y)
        r = not(n5)
    }

    dissolve-wires (replaces wires by their drivers): no change

    turn-clocks (removes inverters before clocks): no change

    fold-constants (simplifies cells with constant or repeated pins): 2 cells
    netlist a(x, y) -> (q, r) {
        n5 = and(x, y)
        r = not(n5)
        q = x
    }

    share (merges cells that compute the same): no change

    merge-registers (merges registers that always store the same bit): no change

    sweep (removes what no output depends on): no change
    ");
}
