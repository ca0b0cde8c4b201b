//! Netlists, networks and libraries that the unit tests of this crate share.

use rand::Rng;
use rand_chacha::ChaCha8Rng;

use crate::network::{Network, Signal};
use crate::register::{Forcing, RegisterKind};
use crate::{CellLibrary, NetId, Netlist, RegisterNode};
use nbc_base::model::Function;

pub fn latch() -> Netlist {
    let mut netlist = Netlist::new("d_latch");
    let d = netlist.add_input("d");
    let e = netlist.add_input("e");
    let q = netlist.add_wire("q", Some(false), None);
    let nq = netlist.add_wire("nq", Some(true), None);
    let set = netlist.add_gate(Function::NAND, &[d, e]);
    let not_d = netlist.add_gate(Function::NOT, &[d]);
    let reset = netlist.add_gate(Function::NAND, &[not_d, e]);
    let q_cell = netlist.add_gate(Function::NAND, &[set, nq]);
    let nq_cell = netlist.add_gate(Function::NAND, &[reset, q]);
    netlist.drive(q, 0, q_cell);
    netlist.drive(nq, 0, nq_cell);
    netlist.add_output("q", q);
    netlist.add_output("nq", nq);
    netlist
}

pub fn register(
    netlist: &mut Netlist,
    kind: RegisterKind,
    name: &str,
    [data, clock]: [NetId; 2],
    start: bool,
) -> NetId {
    let (forcing, name) = (Forcing::Never, Some(name.to_owned()));
    netlist.add_register(RegisterNode { kind, forcing, start: Some(start), name, span: None }, &[data, clock])
}

pub fn flip_flop(netlist: &mut Netlist, name: &str, data: NetId, clock: NetId, start: bool) -> NetId {
    register(netlist, RegisterKind::Rising, name, [data, clock], start)
}

pub fn full_adder() -> Netlist {
    let mut netlist = Netlist::new("full_adder");
    let [a, b, c] = ["a", "b", "cin"].map(|name| netlist.add_input(name));
    let half = netlist.add_gate(Function::XOR, &[a, b]);
    let sum = netlist.add_gate(Function::XOR, &[half, c]);
    let both = netlist.add_gate(Function::AND, &[a, b]);
    let carried = netlist.add_gate(Function::AND, &[half, c]);
    let carry = netlist.add_gate(Function::OR, &[both, carried]);
    netlist.add_output("sum", sum);
    netlist.add_output("carry", carry);
    netlist
}

pub fn library(names: &str) -> CellLibrary {
    CellLibrary::uniform(names.split_whitespace().map(|name| Function::parse(name).unwrap()))
}

pub fn multiplexer_library() -> CellLibrary {
    let cells = Function::all().filter(|function| function.arity() == 2 || *function == Function::NOT);
    CellLibrary::uniform(cells.chain(Function::MUX.arrangements()))
}

/// The gates have the functions of these bits and read any earlier signals; the outputs show the last six.
pub fn network(inputs: usize, gates: &[(u8, u16, u16)]) -> Network {
    let mut network = Network::new(inputs);
    for &(bits, a, b) in gates {
        let pins = [a, b].map(|pin| Signal::from(pin) % network.signals() as Signal);
        network.add(Function::new(bits % 16), pins);
    }
    let signals = network.signals() as Signal;
    network.outputs = (signals - 6..signals).collect();
    network
}

pub fn random_machine(random: &mut ChaCha8Rng) -> Netlist {
    let mut draw = |bound: usize| (random.next_u32() as usize) % bound;
    let mut netlist = Netlist::new("machine");
    let ports: Vec<NetId> = (0..draw(3)).map(|at| netlist.add_input(format!("i{at}"))).collect();
    let clock = netlist.add_input("clk");
    let bits = draw(5);
    let wires: Vec<NetId> = (0..bits).map(|at| netlist.add_wire(format!("w{at}"), None, None)).collect();
    let mut nets: Vec<NetId> = ports.iter().chain(&wires).copied().collect();
    if nets.is_empty() {
        nets.push(netlist.add_constant(true));
    }
    for _ in 0..draw(12) {
        let function = Function::all().filter(|function| function.depends_on(0)).nth(draw(12)).unwrap();
        let pins = [nets[draw(nets.len())], nets[draw(nets.len())]];
        nets.push(netlist.add_gate(function, &pins[..function.arity()]));
    }
    for (at, &wire) in wires.iter().enumerate() {
        let data = nets[draw(nets.len())];
        let q = flip_flop(&mut netlist, &format!("q{at}"), data, clock, draw(2) == 1);
        netlist.drive(wire, 0, q);
    }
    for at in 0..1 + draw(3) {
        let net = nets[draw(nets.len())];
        netlist.add_output(format!("o{at}"), net);
    }
    netlist
}
