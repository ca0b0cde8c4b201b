//! Simulation of a netlist at the level of logic: every cell takes one time step, and inputs are held until nothing
//! changes.

use std::collections::VecDeque;

use crate::Oscillation;
use crate::clause::ValuedBit;
use crate::lowering::as_nands;
use crate::netlist::{NetId, Netlist, Node};
use nbc_base::model::Function;

#[derive(Clone, Debug)]
pub struct Logic {
    inputs: Vec<u32>,
    outputs: Vec<u32>,
    cells: Vec<Gate>,
    /// Values of all nets by slot: the inputs, the constants, then the cells.
    values: Vec<bool>,
    next: Vec<bool>,
}

/// The first step whose values are kept, to find the period of an oscillation. Most circuits settle before.
const FIRST_KEPT: usize = 32;

#[derive(Clone, Debug)]
struct Gate {
    function: Function,
    pins: Vec<u32>,
    slot: u32,
}

impl Logic {
    /// Cells without a start value have what follows from inputs of 0, if that settles. Registers are of NAND cells.
    pub fn new(netlist: &Netlist) -> Self {
        if netlist.registers().next().is_some() {
            return Self::new(&as_nands(netlist));
        }
        let slots = netlist.graph().node_indices().map(|id| id.index() as u32 + 1).max().unwrap_or(0);
        let mut logic = Self {
            inputs: netlist.inputs().iter().map(|id| id.index() as u32).collect(),
            outputs: netlist.outputs().iter().map(|&id| driver(netlist, netlist.pins(id)[0])).collect(),
            cells: Vec::new(),
            values: vec![false; slots as usize],
            next: Vec::new(),
        };
        let mut held = Vec::new();
        for id in netlist.ids() {
            match netlist.node(id) {
                Node::Constant(value) => logic.values[id.index()] = *value,
                Node::Cell(cell) => {
                    let pins = netlist.operands(id).into_iter().map(|pin| driver(netlist, pin)).collect();
                    logic.cells.push(Gate { function: cell.function, pins, slot: id.index() as u32 });
                    held.extend(start(netlist, id).map(|start| (id.index(), start)));
                }
                _ => {}
            }
        }
        logic.begin(&held);
        logic
    }

    fn begin(&mut self, held: &[ValuedBit]) {
        for _ in 0..self.cells.len() + 2 {
            for &(slot, start) in held {
                self.values[slot] = start;
            }
            let changed = self.step();
            let moved = held.iter().any(|&(slot, start)| self.values[slot] != start);
            if !changed || (moved && held.len() == self.cells.len()) {
                break;
            }
        }
        for &(slot, start) in held {
            self.values[slot] = start;
        }
    }

    pub fn value(&self, net: NetId) -> bool {
        self.values[net.index()]
    }

    /// Whether any output changed.
    fn step(&mut self) -> bool {
        self.next.clear();
        let value = |slot: u32| self.values[slot as usize];
        let output = |gate: &Gate| gate.function.at(gate.pins.iter().map(|&pin| value(pin)));
        self.next.extend(self.cells.iter().map(output));
        let mut changed = false;
        for (gate, &next) in self.cells.iter().zip(&self.next) {
            changed |= std::mem::replace(&mut self.values[gate.slot as usize], next) != next;
        }
        changed
    }

    pub fn settle(&mut self, inputs: &[bool]) -> Result<Vec<bool>, Oscillation> {
        assert_eq!(inputs.len(), self.inputs.len(), "a value for each input");
        for (&slot, &value) in self.inputs.iter().zip(inputs) {
            self.values[slot as usize] = value;
        }
        self.run(|_| {})?;
        Ok(self.outputs())
    }

    /// `see` is shown the values after each step, but not again those of an oscillation that it has seen completely.
    fn run(&mut self, mut see: impl FnMut(&[bool])) -> Result<(), Oscillation> {
        let limit = self.limit();
        let (mut kept, mut kept_at) = (Vec::new(), 0);
        for step in 1..=limit {
            if !self.step() {
                return Ok(());
            }
            see(&self.values);
            if kept == self.values {
                (0..(limit - step) % (step - kept_at)).for_each(|_| _ = self.step());
                break;
            }
            if step >= FIRST_KEPT && step.is_power_of_two() {
                (kept, kept_at) = (self.values.clone(), step);
            }
        }
        Err(Oscillation)
    }

    /// Without loops the longest path; loops that settle do so within a few rounds.
    fn limit(&self) -> usize {
        16 * self.cells.len() + 16
    }

    pub fn outputs(&self) -> Vec<bool> {
        self.outputs.iter().map(|&slot| self.values[slot as usize]).collect()
    }

    /// Whether each output is constant while the inputs are held, as some may be even if the circuit does not settle.
    pub fn steady_outputs(&mut self) -> Vec<bool> {
        let before = self.outputs();
        let mut steady = vec![true; before.len()];
        let outputs = self.outputs.clone();
        _ = self.run(|values| {
            for ((steady, &slot), before) in steady.iter_mut().zip(&outputs).zip(&before) {
                *steady &= values[slot as usize] == *before;
            }
        });
        steady
    }
}

fn driver(netlist: &Netlist, id: NetId) -> u32 {
    let mut at = id;
    let mut steps = 0;
    while let Node::Wire { .. } = netlist.node(at) {
        at = netlist.pins(at)[0];
        steps += 1;
        assert!(steps <= netlist.graph().node_count(), "a wire does not drive itself");
    }
    at.index() as u32
}

fn start(netlist: &Netlist, id: NetId) -> Option<bool> {
    let own = netlist.cell(id).and_then(|cell| cell.start);
    own.or_else(|| {
        netlist.fanout(id).into_iter().find_map(|(listener, _)| match netlist.node(listener) {
            Node::Wire { start, .. } => *start,
            _ => None,
        })
    })
}

/// A netlist whose cells each answer after their own number of cycles, as robots do.
#[derive(Clone, Debug)]
pub struct Delayed {
    logic: Logic,
    /// The delay of each cell, in cycles.
    delays: Vec<usize>,
    /// The values of all nets by slot in the last cycles, the latest first.
    past: VecDeque<Vec<bool>>,
}

impl Delayed {
    /// In the same state as [`Logic::new`]; `delay` gives the cycles after which each cell reacts, at least one.
    pub fn new(netlist: &Netlist, mut delay: impl FnMut(NetId) -> usize) -> Self {
        let logic = Logic::new(netlist);
        let delays: Vec<usize> = netlist.cells().map(|(id, _)| delay(id)).collect();
        assert!(delays.iter().all(|&delay| delay > 0), "a cell takes one cycle at least");
        let longest = delays.iter().copied().max().unwrap_or(1);
        Self { past: std::iter::repeat_n(logic.values.clone(), longest).collect(), logic, delays }
    }

    pub fn run(&mut self, inputs: &[bool], cycles: usize) -> Vec<bool> {
        let Logic { inputs: ports, outputs, cells, .. } = &self.logic;
        assert_eq!(inputs.len(), ports.len(), "a value for each input");
        for _ in 0..cycles {
            let mut now = self.past[0].clone();
            ports.iter().zip(inputs).for_each(|(&slot, &value)| now[slot as usize] = value);
            for (gate, delay) in cells.iter().zip(&self.delays) {
                let heard = &self.past[delay - 1];
                now[gate.slot as usize] = gate.function.at(gate.pins.iter().map(|&pin| heard[pin as usize]));
            }
            self.past.pop_back();
            self.past.push_front(now);
        }
        outputs.iter().map(|&slot| self.past[0][slot as usize]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set_reset() -> Netlist {
        let mut netlist = Netlist::new("latch");
        let set = netlist.add_input("s");
        let reset = netlist.add_input("r");
        let wire = netlist.add_wire("nq", Some(true), None);
        let q = netlist.add_gate(Function::NAND, &[set, wire]);
        let nq = netlist.add_gate(Function::NAND, &[reset, q]);
        netlist.drive(wire, 0, nq);
        netlist.add_output("q", q);
        netlist
    }

    #[test]
    fn a_latch_remembers() {
        let mut logic = Logic::new(&set_reset());
        let reset = ([true, false], false);
        let rows = [reset, ([true, true], false), ([false, true], true), ([true, true], true), reset];
        for (inputs, expected) in rows {
            assert_eq!(logic.settle(&inputs), Ok(vec![expected]), "after {inputs:?}");
        }
    }

    #[test]
    fn a_ring_oscillates() {
        let mut netlist = Netlist::new("ring");
        let wire = netlist.add_wire("q", Some(false), None);
        let gate = netlist.add_gate(Function::NOT, &[wire]);
        netlist.drive(wire, 0, gate);
        netlist.add_output("q", gate);
        assert_eq!(Logic::new(&netlist).settle(&[]), Err(Oscillation));
    }

    #[test]
    fn an_oscillation_ends_where_all_its_steps_would_end() {
        // Rings of several lengths beside a latch and a chain that settles.
        for lengths in [&[1][..], &[3, 5], &[2, 7, 9], &[11, 13]] {
            let mut netlist = set_reset();
            let [mut tail, reset] = [netlist.inputs()[0], netlist.inputs()[1]];
            for &length in lengths {
                let wire = netlist.add_wire("ring", Some(false), None);
                let ends = (0..length).fold(wire, |net, _| netlist.add_gate(Function::NOT, &[net]));
                let last = netlist.add_gate(Function::NAND, &[ends, reset]);
                netlist.drive(wire, 0, last);
                netlist.add_output("o", last);
                tail = netlist.add_gate(Function::XOR, &[tail, last]);
            }
            netlist.add_output("t", tail);
            let (mut quick, mut whole) = (Logic::new(&netlist), Logic::new(&netlist));
            for row in [[false, true], [true, true], [true, false], [true, true]] {
                let settled = quick.settle(&row).is_ok();
                for (&slot, value) in whole.inputs.clone().iter().zip(row) {
                    whole.values[slot as usize] = value;
                }
                let rests = (0..whole.limit()).any(|_| !whole.step());
                assert_eq!((settled, &quick.values), (rests, &whole.values), "{lengths:?} {row:?}");
                let before = whole.outputs();
                let mut steady = vec![true; before.len()];
                for _ in 0..whole.limit() {
                    whole.step();
                    steady.iter_mut().zip(whole.outputs()).zip(&before).for_each(|((s, now), was)| *s &= now == *was);
                }
                assert_eq!((quick.steady_outputs(), &quick.values), (steady, &whole.values), "{lengths:?} {row:?}");
            }
        }
    }

    #[test]
    fn each_cell_switches_after_its_own_delay() {
        let mut netlist = Netlist::new("two");
        let a = netlist.add_input("a");
        let slow = netlist.add_gate(Function::NOT, &[a]);
        let fast = netlist.add_gate(Function::NOT, &[a]);
        let both = netlist.add_gate(Function::XOR, &[slow, fast]);
        netlist.add_output("q", both);
        let mut delayed = Delayed::new(&netlist, |id| if id == slow { 3 } else { 1 });
        // The fast inverter switches after one cycle, the slow one after three, and the output follows one cycle later.
        let seen: Vec<_> = (0..6).map(|_| delayed.run(&[true], 1)[0]).collect();
        assert_eq!(seen, [false, false, true, true, false, false]);
    }
}
