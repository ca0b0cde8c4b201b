//! The gates of a step and the nets between them, each with the number of steps by which its listener is later.

use crate::BlockId;
use crate::network::{Network, Signal};
use crate::synth::{CellNetwork, NetworkCell};
use crate::waves::clock_step::ClockStep;
use nbc_base::model::Function;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Driver {
    Constant(bool),
    Input(usize),
    Gate(usize),
}

/// A net as a listener sees it: in step `m`, counted from 0, what its driver shows in step `m - later`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tap {
    pub driver: Driver,
    /// The number of steps; -1 where a port shows what the state of the next step brings forth.
    pub later: i64,
    /// What the listener sees in the first steps, which its driver was too early for.
    pub starts: Vec<bool>,
}

#[derive(Clone, Debug)]
pub struct WaveGate {
    pub function: Function,
    pub pins: Vec<Tap>,
}

#[derive(Clone, Debug)]
pub struct WaveGraph {
    pub inputs: usize,
    /// The gates; along nets that are not later, each listens to earlier gates only.
    pub gates: Vec<WaveGate>,
    pub outputs: Vec<Tap>,
    pub state: Vec<Tap>,
}

/// The logic of a step, made for mapping: outputs that depend on inputs have a copy of the ports one step later, for
/// after an edge they show the new state with the inputs of before.
#[derive(Clone, Debug)]
pub struct WaveLogic {
    /// The ports, the state, and then the late ports; the outputs are those of the step.
    pub network: Network,
    late: Vec<usize>,
    /// The number of ports, of bits of the state, and of outputs.
    counts: [usize; 3],
    starts: Vec<bool>,
}

impl WaveLogic {
    pub fn of(step: &ClockStep) -> Self {
        let counts = [step.inputs.len(), step.state.len(), step.outputs.len()];
        let starts = step.state.iter().map(|bit| bit.start).collect();
        let (network, late) = match step.state.is_empty() {
            true => (step.logic.clone(), Vec::new()),
            false => with_late_ports(&step.logic, counts),
        };
        Self { network, late, counts, starts }
    }

    pub fn graph(&self, mapped: &CellNetwork) -> WaveGraph {
        let [ports, bits, outputs] = self.counts;
        let mut network = mapped.clone();
        self.show_state(&mut network);
        let tap = |signal: Signal| self.tap(&network, signal);
        let gate = |cell: &NetworkCell| {
            let (function, pins) = (cell.function, cell.pins.iter().map(|&pin| tap(pin)));
            match function.inputs() == 2 && function.arity() < 2 && function.depends_on(1) {
                true => WaveGate { function: function.swapped(), pins: pins.skip(1).collect() },
                false => WaveGate { function, pins: pins.collect() },
            }
        };
        let shown = |&output: &Signal| {
            let tap = tap(output);
            Tap { later: tap.later - i64::from(bits > 0), ..tap }
        };
        WaveGraph {
            inputs: ports,
            gates: network.cells.iter().map(gate).collect(),
            outputs: network.outputs[..outputs].iter().map(shown).collect(),
            state: (0..bits).map(|bit| tap((2 + ports + bit) as Signal)).collect(),
        }
    }

    pub fn blocks(&self, step: &ClockStep, mapped: &CellNetwork) -> Vec<BlockId> {
        let mut network = mapped.clone();
        self.show_state(&mut network);
        let ports: Vec<usize> = (0..step.logic.inputs).chain(self.late.iter().copied()).collect();
        step.signal_blocks.of_cells(&step.logic, &network, &ports)
    }

    fn bit(&self, signal: Signal) -> Option<usize> {
        let [ports, bits, _] = self.counts;
        (signal as usize).checked_sub(2 + ports).filter(|&bit| bit < bits)
    }

    fn next(&self, network: &CellNetwork, bit: usize) -> Signal {
        network.outputs[self.counts[2] + bit]
    }

    /// Adds buffers for rings of registers alone and for registers of a port that an output shows: they have no gate.
    fn show_state(&self, network: &mut CellNetwork) {
        let [ports, bits, outputs] = self.counts;
        let add_buffer = |network: &mut CellNetwork, bit: usize| {
            let next = self.next(network, bit);
            network.outputs[outputs + bit] = network.add(Function::BUF, vec![next]);
        };
        for first in 0..bits {
            let mut at = first;
            for _ in 0..bits {
                let Some(before) = self.bit(self.next(network, at)) else { break };
                at = before;
                if at == first {
                    add_buffer(network, first);
                    break;
                }
            }
        }
        for output in 0..outputs {
            let mut last = self.bit(network.outputs[output]);
            while let Some(before) = last.and_then(|bit| self.bit(self.next(network, bit))) {
                last = Some(before);
            }
            let is_port = |signal: Signal| (2..2 + ports as Signal).contains(&signal);
            if let Some(bit) = last.filter(|&bit| is_port(self.next(network, bit))) {
                add_buffer(network, bit);
            }
        }
    }

    fn tap(&self, network: &CellNetwork, signal: Signal) -> Tap {
        let [ports, bits, _] = self.counts;
        let (mut signal, mut starts) = (signal, Vec::new());
        while let Some(bit) = self.bit(signal) {
            starts.push(self.starts[bit]);
            signal = self.next(network, bit);
        }
        let later = starts.len() as i64;
        match (signal as usize).checked_sub(2) {
            None => Tap { driver: Driver::Constant(signal == 1), later, starts },
            Some(at) if at < ports => Tap { driver: Driver::Input(at), later, starts },
            Some(at) => match at.checked_sub(network.inputs) {
                Some(gate) => Tap { driver: Driver::Gate(gate), later, starts },
                None => Tap { driver: Driver::Input(self.late[at - ports - bits]), later: later + 1, starts },
            },
        }
    }
}

fn with_late_ports(logic: &Network, [ports, _, outputs]: [usize; 3]) -> (Network, Vec<usize>) {
    let first_gate = 2 + logic.inputs;
    let mut depends: Vec<bool> = (0..first_gate).map(|signal| (2..2 + ports).contains(&signal)).collect();
    for gate in &logic.gates {
        let reads = |pin: usize| gate.function.depends_on(pin) && depends[gate.pins[pin] as usize];
        depends.push(reads(0) || reads(1));
    }
    let mut shown = vec![false; logic.signals()];
    logic.outputs[..outputs].iter().for_each(|&output| shown[output as usize] = depends[output as usize]);
    for (at, gate) in logic.gates.iter().enumerate().rev() {
        if !shown[first_gate + at] {
            continue;
        }
        let read = (0..2).filter(|&pin| gate.function.depends_on(pin)).map(|pin| gate.pins[pin] as usize);
        read.for_each(|pin| shown[pin] = depends[pin]);
    }
    let late: Vec<usize> = (0..ports).filter(|&port| shown[2 + port]).collect();
    let mut made = Network::new(logic.inputs + late.len());
    let mut now: Vec<Signal> = (0..first_gate as Signal).collect();
    let mut later = now.clone();
    (0..).zip(&late).for_each(|(at, &port)| later[2 + port] = made.input(logic.inputs + at));
    for (at, gate) in logic.gates.iter().enumerate() {
        let signal = made.add(gate.function, gate.pins.map(|pin| now[pin as usize]));
        let copy = match shown[first_gate + at] {
            true => made.add(gate.function, gate.pins.map(|pin| later[pin as usize])),
            false => signal,
        };
        now.push(signal);
        later.push(copy);
    }
    let (shown, next) = logic.outputs.split_at(outputs);
    let shown = shown.iter().map(|&output| later[output as usize]);
    made.outputs = shown.chain(next.iter().map(|&output| now[output as usize])).collect();
    (made.swept(), late)
}
