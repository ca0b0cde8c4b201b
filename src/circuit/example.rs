//! Netlists that the tests of this folder share, and how they answer with delays.

use std::collections::BTreeMap;

use crate::circuit::{NetId, Netlist, Node};
use crate::model::Function;

/// The paper's D latch as elaboration writes it: two wires for the feedback.
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

/// A full adder as a textbook writes it.
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

/// A netlist whose cells each answer after their own number of cycles.
pub struct Delayed {
    netlist: Netlist,
    delay: BTreeMap<NetId, usize>,
    /// The values of all nets, the latest last.
    past: Vec<BTreeMap<NetId, bool>>,
}

impl Delayed {
    /// A netlist at its start values, with a delay drawn for each cell.
    pub fn new(netlist: Netlist, mut draw: impl FnMut() -> usize) -> Self {
        let delay = netlist.cells().map(|(id, _)| (id, draw())).collect();
        let start = |id| netlist.cell(id).and_then(|cell| cell.start).unwrap_or(false);
        let past = vec![netlist.ids().map(|id| (id, start(id))).collect()];
        Self { netlist, delay, past }
    }

    /// Holds the inputs for some cycles, and gives the first output after them.
    pub fn run(&mut self, inputs: &[bool], cycles: usize) -> bool {
        for _ in 0..cycles {
            let ago = |cycles: usize, id: &NetId| self.past[self.past.len().saturating_sub(cycles)][id];
            let mut now: BTreeMap<NetId, bool> = BTreeMap::new();
            for id in self.netlist.ids() {
                let value = match self.netlist.node(id) {
                    Node::Input(_) => inputs[self.netlist.inputs().iter().position(|&input| input == id).unwrap()],
                    Node::Constant(value) => *value,
                    Node::Cell(cell) => {
                        let pins = self.netlist.pins(id);
                        let a = ago(self.delay[&id], &pins[0]);
                        cell.function.output(a, pins.get(1).map_or(a, |pin| ago(self.delay[&id], pin)))
                    }
                    Node::Output(_) | Node::Wire { .. } => ago(1, &self.netlist.pins(id)[0]),
                };
                now.insert(id, value);
            }
            self.past.push(now);
        }
        self.past[self.past.len() - 1][&self.netlist.outputs()[0]]
    }
}
