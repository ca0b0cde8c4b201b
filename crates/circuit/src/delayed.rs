//! A netlist whose cells each answer after their own number of cycles, as robots do: [`crate::Logic`] with
//! delays.

use std::collections::VecDeque;

use crate::{Logic, NetId, Netlist, Node};
use nbc_base::model::Function;

#[derive(Clone, Debug)]
pub struct Delayed {
    inputs: Vec<usize>,
    outputs: Vec<usize>,
    cells: Vec<DelayedCell>,
    /// The values of all nets by slot in the last cycles, the latest first.
    past: VecDeque<Vec<bool>>,
}

#[derive(Clone, Debug)]
struct DelayedCell {
    function: Function,
    pins: Vec<usize>,
    slot: usize,
    delay: usize,
}

impl Delayed {
    /// A netlist before its first cycle, in the same state as [`Logic::new`]; `delay` gives the cycles after which each
    /// cell reacts.
    pub fn new(netlist: &Netlist, mut delay: impl FnMut(NetId) -> usize) -> Self {
        let before = Logic::new(netlist);
        let slots = netlist.ids().map(|id| id.index() + 1).max().unwrap_or(0);
        let mut start = vec![false; slots];
        let mut cells = Vec::new();
        for id in netlist.ids() {
            match netlist.node(id) {
                Node::Output(_) => {}
                Node::Wire { name, .. } => panic!("wire `{name}` should have been dissolved"),
                Node::Input(_) | Node::Constant(_) => start[id.index()] = before.value(id),
                Node::Cell(cell) => {
                    start[id.index()] = before.value(id);
                    let pins = netlist.operands(id).into_iter().map(|pin| pin.index()).collect();
                    cells.push(DelayedCell { function: cell.function, pins, slot: id.index(), delay: delay(id) });
                }
            }
        }
        let longest = cells.iter().map(|cell| cell.delay).max().unwrap_or(1);
        assert!(cells.iter().all(|cell| cell.delay > 0), "a cell takes one cycle at least");
        Self {
            inputs: netlist.inputs().iter().map(|id| id.index()).collect(),
            outputs: netlist.outputs().iter().map(|&id| netlist.pins(id)[0].index()).collect(),
            cells,
            past: std::iter::repeat_n(start, longest).collect(),
        }
    }

    /// Holds the inputs, in order of the ports, for some cycles, and returns the outputs after them.
    pub fn run(&mut self, inputs: &[bool], cycles: usize) -> Vec<bool> {
        assert_eq!(inputs.len(), self.inputs.len(), "a value for each input");
        for _ in 0..cycles {
            let mut now = self.past[0].clone();
            self.inputs.iter().zip(inputs).for_each(|(&slot, &value)| now[slot] = value);
            for cell in &self.cells {
                let heard = &self.past[cell.delay - 1];
                now[cell.slot] = cell.function.at(cell.pins.iter().map(|&pin| heard[pin]));
            }
            self.past.pop_back();
            self.past.push_front(now);
        }
        self.outputs.iter().map(|&slot| self.past[0][slot]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
