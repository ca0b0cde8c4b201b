//! A wave machine at the level of logic: each cell shows in a beat its function of what its pins read.

use crate::waves::machine::{Reading, WaveMachine};
use crate::{NetId, Node};

impl WaveMachine {
    /// What the output ports show of each row in each thread, by thread, row and port, if every thread gets these
    /// rows of input bits.
    pub fn run(&self, rows: &[Vec<bool>]) -> Vec<Vec<Vec<bool>>> {
        let beat = self.beat as usize;
        let netlist = &self.netlist;
        let slots = netlist.ids().map(|id| id.index() + 1).max().unwrap_or(0);
        let mut shown = vec![false; slots];
        for id in netlist.ids() {
            if let Node::Constant(value) = netlist.node(id) {
                shown[id.index()] = *value;
            }
        }
        let cells: Vec<_> = netlist.cells().map(|(id, cell)| (id, cell.function, netlist.pins(id))).collect();
        let held_bits = |id: NetId, pins: &[NetId]| (0..).zip(pins).map(|(pin, _)| self.held_bits(id, pin)).collect();
        let held: Vec<Vec<Vec<bool>>> = cells.iter().map(|(id, _, pins)| held_bits(*id, pins)).collect();
        let ports: Vec<NetId> = netlist.outputs().iter().map(|&id| netlist.pins(id)[0]).collect();
        let mut past: Vec<Vec<bool>> = Vec::new();
        for at in 0..self.cycles(rows.len()) / beat {
            for (input, id) in netlist.inputs().iter().enumerate() {
                shown[id.index()] = rows[self.row_at(input, at * beat, rows.len())][input];
            }
            let next: Vec<bool> = cells
                .iter()
                .zip(&held)
                .map(|((_, function, pins), held)| {
                    let bit = |pin: usize| held[pin].get(at * beat).copied().unwrap_or(shown[pins[pin].index()]);
                    function.at((0..function.inputs()).map(|input| bit(input.min(pins.len() - 1))))
                })
                .collect();
            for ((id, ..), next) in cells.iter().zip(next) {
                shown[id.index()] = next;
            }
            past.push(ports.iter().map(|net| shown[net.index()]).collect());
        }
        let value = |thread: usize, row: usize, output: usize| match self.reading(output, row, thread) {
            Reading::Start(start) => start,
            Reading::Cycle(cycle) => past[cycle / beat][output],
        };
        let row = |thread: usize, row: usize| (0..ports.len()).map(|output| value(thread, row, output)).collect();
        (0..self.period as usize).map(|thread| (0..rows.len()).map(|at| row(thread, at)).collect()).collect()
    }
}
