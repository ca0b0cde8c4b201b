//! Networks: the combinational part of a netlist as a flat list of gates, made for fast simulation and search.

use std::collections::{BTreeMap, BTreeSet};

use crate::{NetId, Netlist, Node};
use nbc_base::model::Function;

/// A signal: 0 and 1 are the constants, then the inputs, then the gates.
pub type Signal = u32;

/// A two-input gate; a function of one input has the same signal on both pins or ignores pin 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gate {
    pub function: Function,
    pub pins: [Signal; 2],
}

/// Gates of at most two inputs, in topological order, between numbered inputs and outputs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Network {
    /// Their signals are 2, 3, and so on.
    pub inputs: usize,
    pub gates: Vec<Gate>,
    pub outputs: Vec<Signal>,
}

impl Network {
    pub fn new(inputs: usize) -> Self {
        Self { inputs, gates: Vec::new(), outputs: Vec::new() }
    }

    pub fn input(&self, i: usize) -> Signal {
        assert!(i < self.inputs, "the input exists");
        i as Signal + 2
    }

    pub fn add(&mut self, function: Function, pins: [Signal; 2]) -> Signal {
        let signal = self.signals() as Signal;
        assert!(pins.iter().all(|&pin| pin < signal), "a gate listens to earlier signals");
        self.gates.push(Gate { function, pins });
        signal
    }

    pub fn add_function(&mut self, function: Function, pins: &[Signal]) -> Signal {
        let &[a, b, c] = pins else { return self.add(function, [pins[0], pins[1]]) };
        // If `a` is 0, the function is one of `b` and `c`; if it is 1, another.
        let [low, high] = function.halves();
        match (low, high) {
            (Function::ZERO, Function::ONE) => return a,
            (Function::ONE, Function::ZERO) => return self.add(Function::NOT, [a, a]),
            _ if low == high => return self.half(low, [b, c]),
            _ => {}
        }
        if high == low.inverted() {
            let first = self.half(low, [b, c]);
            return self.add(Function::XOR, [a, first]);
        }
        let [absent, present] = [low, high].map(|half| self.half(half, [b, c]));
        let unless = |network: &mut Self| network.add(Function::AND.with_input_inverted(0), [a, absent]);
        let when = |network: &mut Self| network.add(Function::AND, [a, present]);
        match (low, high) {
            (Function::ZERO, _) => when(self),
            (_, Function::ZERO) => unless(self),
            (Function::ONE, _) => self.add(Function::OR.with_input_inverted(0), [a, present]),
            (_, Function::ONE) => self.add(Function::OR, [a, absent]),
            _ => {
                let pins = [unless(self), when(self)];
                self.add(Function::OR, pins)
            }
        }
    }

    fn half(&mut self, function: Function, [b, c]: [Signal; 2]) -> Signal {
        match function {
            Function::ZERO => 0,
            Function::ONE => 1,
            Function::BUF => b,
            Function::BUF_B => c,
            _ => self.add(function, [b, c]),
        }
    }

    pub fn signals(&self) -> usize {
        2 + self.inputs + self.gates.len()
    }

    pub(crate) fn gate(&self, signal: Signal) -> Option<&Gate> {
        (signal as usize).checked_sub(2 + self.inputs).map(|i| &self.gates[i])
    }

    /// The values of all signals in 64 patterns at a time: bit `k` of `inputs[i]` is input `i` in pattern `k`, and bit
    /// `k` of result `s` is signal `s`.
    pub fn simulate(&self, inputs: &[u64]) -> Vec<u64> {
        let mut values = Vec::with_capacity(self.signals());
        self.simulate_into(inputs, &mut values);
        values
    }

    pub fn simulate_into(&self, inputs: &[u64], values: &mut Vec<u64>) {
        values.clear();
        values.extend([0, !0]);
        values.extend(inputs);
        for gate in &self.gates {
            let [a, b] = gate.pins.map(|pin| values[pin as usize]);
            values.push(word(gate.function, a, b));
        }
    }

    pub(crate) fn run(&self, inputs: impl IntoIterator<Item = bool>) -> Vec<bool> {
        let values = self.simulate(&inputs.into_iter().map(u64::from).collect::<Vec<u64>>());
        self.outputs.iter().map(|&output| values[output as usize] & 1 == 1).collect()
    }

    pub(crate) fn include(&mut self, other: &Self, inputs: &[Signal]) -> Vec<Signal> {
        let mut made: Vec<Signal> = [0, 1].into_iter().chain(inputs.iter().copied()).collect();
        for gate in &other.gates {
            made.push(self.add(gate.function, gate.pins.map(|pin| made[pin as usize])));
        }
        other.outputs.iter().map(|&output| made[output as usize]).collect()
    }

    /// Gates that only invert, by equal pins or a constant, become inverters if there is a cell; likewise buffers.
    pub(crate) fn with_plain_inverters(&self, has_cell: impl Fn(Function) -> bool) -> Self {
        let mut plain = self.clone();
        for gate in &mut plain.gates {
            let [a, b] = gate.pins;
            let signal = if a > 1 { a } else { b };
            if signal < 2 || (a > 1 && b > 1 && a != b) {
                continue;
            }
            let pin = |pin: Signal, value: bool| if pin == signal { value } else { pin == 1 };
            let [off, on] = [false, true].map(|value| gate.function.output(pin(a, value), pin(b, value)));
            let function = if off { Function::NOT } else { Function::BUF };
            if off != on && has_cell(function) {
                *gate = Gate { function, pins: [signal; 2] };
            }
        }
        plain
    }

    pub fn swept(&self) -> Self {
        self.swept_signals().0
    }

    /// As [`Network::swept`], and the new number of each signal; one that is left out has that of a constant.
    pub(crate) fn swept_signals(&self) -> (Self, Vec<Signal>) {
        let mut used = vec![false; self.signals()];
        self.outputs.iter().for_each(|&output| used[output as usize] = true);
        let first = 2 + self.inputs;
        for (i, gate) in self.gates.iter().enumerate().rev() {
            if used[first + i] {
                (0..2)
                    .filter(|&pin| gate.function.depends_on(pin))
                    .for_each(|pin| used[gate.pins[pin] as usize] = true);
            }
        }
        let mut swept = Self::new(self.inputs);
        let mut signal: Vec<Signal> = (0..first as Signal).collect();
        for (i, gate) in self.gates.iter().enumerate() {
            let pin =
                |pin: usize| signal[gate.pins[if gate.function.depends_on(pin) { pin } else { 1 - pin }] as usize];
            let made = if used[first + i] && gate.function.arity() > 0 {
                swept.add(gate.function, [pin(0), pin(1)])
            } else {
                constant(gate.function)
            };
            signal.push(made);
        }
        swept.outputs = self.outputs.iter().map(|&output| signal[output as usize]).collect();
        (swept, signal)
    }
}

fn constant(function: Function) -> Signal {
    Signal::from(function == Function::ONE)
}

pub(crate) fn inverted(function: Function, inputs: [bool; 2]) -> Function {
    let pins = (0..2).filter(|&pin| inputs[pin]);
    pins.fold(function, Function::with_input_inverted)
}

pub fn word(function: Function, a: u64, b: u64) -> u64 {
    minterms(rows(function), a, b)
}

pub fn words(function: Function, a: &[u64], b: &[u64]) -> impl Iterator<Item = u64> {
    let rows = rows(function);
    a.iter().zip(b).map(move |(&a, &b)| minterms(rows, a, b))
}

/// Each row of its truth table as a word.
fn rows(function: Function) -> [u64; 4] {
    std::array::from_fn(|row| if function.bits() >> row & 1 == 1 { !0 } else { 0 })
}

fn minterms(rows: [u64; 4], a: u64, b: u64) -> u64 {
    rows[0] & !a & !b | rows[1] & !a & b | rows[2] & a & !b | rows[3] & a & b
}

/// The values of input `i` over all patterns, counted up, in the 64 patterns from `64 * block` on.
pub(crate) fn counting_word(i: usize, block: usize) -> u64 {
    const LOW: [u64; 6] = [
        0xaaaa_aaaa_aaaa_aaaa,
        0xcccc_cccc_cccc_cccc,
        0xf0f0_f0f0_f0f0_f0f0,
        0xff00_ff00_ff00_ff00,
        0xffff_0000_ffff_0000,
        0xffff_ffff_0000_0000,
    ];
    match LOW.get(i) {
        Some(&word) => word,
        None if block >> (i - 6) & 1 == 1 => !0,
        None => 0,
    }
}

/// The combinational view of a netlist whose loops are cut open at some nets.
#[derive(Clone, Debug)]
pub struct View {
    /// The inputs are the ports and then the cuts; the outputs are the ports and then the drivers of the cuts, of a
    /// register those of all its pins.
    pub network: Network,
    /// The signal of each net as its listeners see it: a cut net is an input.
    pub signal: BTreeMap<NetId, Signal>,
}

impl View {
    /// Cuts a netlist open at `cuts`, all registers among them; fails with a net that still lies on a loop.
    pub fn of(netlist: &Netlist, cuts: &[NetId]) -> Result<Self, NetId> {
        let mut network = Network::new(netlist.inputs().len() + cuts.len());
        let mut signal = BTreeMap::new();
        for (i, &id) in netlist.inputs().iter().chain(cuts).enumerate() {
            signal.insert(id, network.input(i));
        }
        let cut: BTreeSet<_> = cuts.iter().copied().collect();
        if let Some((register, _)) = netlist.registers().find(|(id, _)| !cut.contains(id)) {
            return Err(register);
        }
        let mut next = BTreeMap::new();
        for id in order(netlist, &cut)? {
            if let Some(made) = add(netlist, &mut network, &signal, id) {
                if cut.contains(&id) {
                    next.insert(id, made);
                } else {
                    signal.insert(id, made);
                }
            }
        }
        let seen = |id: &NetId| signal[id];
        let outputs = netlist.outputs().iter().map(|&id| seen(&netlist.pins(id)[0]));
        let driver = |cut: &NetId| match netlist.register(*cut) {
            Some(_) => netlist.pins(*cut).iter().map(seen).collect(),
            None => vec![next[cut]],
        };
        network.outputs = outputs.chain(cuts.iter().flat_map(driver)).collect();
        Ok(Self { network, signal })
    }
}

fn add(netlist: &Netlist, network: &mut Network, signal: &BTreeMap<NetId, Signal>, id: NetId) -> Option<Signal> {
    match netlist.node(id) {
        Node::Constant(value) => Some(Signal::from(*value)),
        Node::Cell(cell) => {
            let pins: Vec<Signal> = netlist.operands(id).iter().map(|pin| signal[pin]).collect();
            Some(network.add_function(cell.function, &pins))
        }
        Node::Wire { .. } => Some(signal[&netlist.pins(id)[0]]),
        Node::Input(_) | Node::Output(_) | Node::Register(_) => None,
    }
}

fn order(netlist: &Netlist, cuts: &BTreeSet<NetId>) -> Result<Vec<NetId>, NetId> {
    let mut waiting = BTreeMap::new();
    let mut ready = Vec::new();
    for id in netlist.ids() {
        let count = netlist.pins(id).iter().filter(|pin| !cuts.contains(pin)).count();
        waiting.insert(id, count);
        if count == 0 {
            ready.push(id);
        }
    }
    let mut order = Vec::with_capacity(waiting.len());
    ready.reverse();
    while let Some(id) = ready.pop() {
        waiting.remove(&id);
        order.push(id);
        if cuts.contains(&id) {
            continue;
        }
        for (listener, _) in netlist.fanout(id) {
            let count = waiting.get_mut(&listener).expect("a listener waits for its drivers");
            *count -= 1;
            if *count == 0 {
                ready.push(listener);
            }
        }
    }
    waiting.keys().next().map_or(Ok(order), |&id| Err(id))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::full_adder;

    #[test]
    fn a_full_adder_counts() {
        let view = View::of(&full_adder(), &[]).unwrap();
        let inputs: Vec<_> = (0..3).map(|i| counting_word(i, 0)).collect();
        let values = view.network.simulate(&inputs);
        let [sum, carry] = [0, 1].map(|i| values[view.network.outputs[i] as usize]);
        for pattern in 0..8u64 {
            assert_eq!(u64::from(pattern.count_ones()), (sum >> pattern & 1) + 2 * (carry >> pattern & 1));
        }
    }

    #[test]
    fn gates_that_invert_one_signal_become_inverters() {
        let mut network = Network::new(2);
        let [a, b] = [0, 1].map(|i| network.input(i));
        let from_constant = network.add(Function::parse("nota_or_b").unwrap(), [a, 0]);
        let from_pins = network.add(Function::NOR, [b, b]);
        let copied = network.add(Function::AND, [1, a]);
        let real = network.add(Function::NAND, [a, b]);
        network.outputs = vec![from_constant, from_pins, copied, real];
        let plain = network.with_plain_inverters(|_| true);
        let functions: Vec<Function> = plain.gates.iter().map(|gate| gate.function).collect();
        assert_eq!(functions, [Function::NOT, Function::NOT, Function::BUF, Function::NAND]);
        let inputs: Vec<u64> = (0..2).map(|i| counting_word(i, 0)).collect();
        assert_eq!(plain.simulate(&inputs), network.simulate(&inputs));
        assert_eq!(network.with_plain_inverters(|_| false), network);
    }
}
