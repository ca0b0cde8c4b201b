//! The proof of a wave machine, from its cells and the phases that it claims for them alone.
//!
//! The phases say by how many steps each pin reads later than its driver shows: a pin whose phase does not fit its
//! driver modulo the period would mix machines. With these numbers the cells are a circuit of steps again, whose state
//! is what pins read later. By induction over the steps it equals the source: where both have the same state and
//! inputs, they show the same outputs and have the same state in the next step, and they start alike.

use std::collections::BTreeMap;

use crate::network::{Network, Signal};
use crate::proof::{self, Method};
use crate::waves::clock_step::ClockStep;
use crate::waves::machine::{WaveMachine, WaveState};
use crate::waves::wording::{has_other_starts, is_different, is_mixed, reads_no_state};
use crate::{NetId, Node};
use nbc_base::model::Function;

/// A net or a constant as a listener reads it, by steps later.
type Place = (Result<NetId, bool>, i64);

pub fn certify(step: &ClockStep, machine: &WaveMachine) -> Result<Method, String> {
    let checker = Checker::new(step, machine)?;
    checker.check_starts()?;
    let needed = checker.needed_bits();
    let (one, two) = (checker.source(&needed), checker.machine(&needed)?);
    proof::equal(&one, &two).map_err(|(output, _)| {
        let bit = |at: usize| step.state[needed[at]].name.clone();
        let net = step.outputs.get(output).cloned();
        is_different(&net.unwrap_or_else(|| bit(output - step.outputs.len())))
    })
}

struct Checker<'a> {
    step: &'a ClockStep,
    machine: &'a WaveMachine,
    /// By how many steps each pin of a cell reads later than its driver shows.
    later: BTreeMap<(NetId, u8), i64>,
    bits: BTreeMap<(Place, &'a [bool]), usize>,
}

impl<'a> Checker<'a> {
    fn new(step: &'a ClockStep, machine: &'a WaveMachine) -> Result<Self, String> {
        let mut checker = Self { step, machine, later: BTreeMap::new(), bits: BTreeMap::new() };
        for (id, _) in machine.netlist.cells() {
            for (pin, net) in (0..).zip(machine.netlist.pins(id)) {
                let phase = *machine.phase.get(&id).ok_or_else(|| checker.mixed(id))?;
                if let Some(shown) = checker.shown(net)? {
                    checker.later.insert((id, pin), checker.steps(shown - phase, id)?);
                }
            }
        }
        for (bit, state) in machine.state.iter().enumerate() {
            let place = checker.place(state.net, state.later);
            checker.bits.entry((place, &state.starts)).or_insert(bit);
        }
        Ok(checker)
    }

    fn mixed(&self, id: NetId) -> String {
        is_mixed(&self.machine.netlist.net_name(id))
    }

    /// The first beat of a step in which a net shows the step; `None` for constants.
    fn shown(&self, net: NetId) -> Result<Option<i64>, String> {
        Ok(match self.machine.netlist.node(net) {
            Node::Constant(_) => None,
            Node::Input(_) => {
                let port = self.machine.netlist.inputs().iter().position(|&input| input == net);
                Some(port.and_then(|port| self.machine.inputs[port]).ok_or_else(|| self.mixed(net))?)
            }
            _ => Some(self.machine.phase.get(&net).ok_or_else(|| self.mixed(net))? + 1),
        })
    }

    fn steps(&self, beats: i64, id: NetId) -> Result<i64, String> {
        let period = i64::from(self.machine.period);
        (beats % period == 0).then(|| beats / period).ok_or_else(|| self.mixed(id))
    }

    fn place(&self, net: Result<NetId, bool>, mut later: i64) -> Place {
        let Ok(mut net) = net else { return (net, later) };
        while let Some(cell) = self.machine.netlist.cell(net) {
            let pins = self.machine.netlist.pins(net);
            let [low, high] = [false, true].map(|value| cell.function.at(vec![value; cell.function.inputs()]));
            let is_one_net = pins.iter().all(|&pin| pin == pins[0]);
            let Some(&steps) = self.later.get(&(net, 0)) else { break };
            let reads_state = (0..).zip(&pins).any(|(pin, _)| self.machine.held.contains_key(&(net, pin)));
            if !is_one_net || low || !high || reads_state {
                break;
            }
            (net, later) = (pins[0], later + steps);
        }
        (Ok(net), later)
    }

    /// What drives a pin, and by how many steps the pin is later; a pin that reads a constant is as late as it starts.
    fn read(&self, net: NetId, later: Option<i64>, starts: &[bool]) -> Place {
        match self.machine.netlist.node(net) {
            Node::Constant(value) => (Err(*value), starts.len() as i64),
            _ => (Ok(net), later.unwrap_or(0)),
        }
    }

    fn bit(&self, (net, later): Place, starts: &[bool], reader: NetId) -> Result<usize, String> {
        let missing = || reads_no_state(&self.machine.netlist.net_name(reader));
        self.bits.get(&(self.place(net, later), starts)).copied().ok_or_else(missing)
    }

    /// The first bit of the state that is equal to it in every step, or the constant that it always is.
    fn equal(&self, bit: usize) -> Result<usize, bool> {
        let state = &self.machine.state[bit];
        match state.net {
            Err(value) if state.starts.iter().all(|&start| start == value) => Err(value),
            net => Ok(self.bits[&(self.place(net, state.later), &state.starts[..])]),
        }
    }

    fn check_starts(&self) -> Result<(), String> {
        for (bit, state) in self.step.state.iter().zip(&self.machine.state) {
            let first = state.starts.first().copied();
            if first != Some(bit.start) || state.starts.len() as i64 != state.later {
                return Err(has_other_starts(&bit.name));
            }
        }
        for (&(id, pin), starts) in &self.machine.held {
            let net = self.machine.netlist.pins(id)[usize::from(pin)];
            self.bit(self.read(net, self.later.get(&(id, pin)).copied(), starts), starts, id)?;
        }
        Ok(())
    }

    fn needed_bits(&self) -> Vec<usize> {
        let (ports, outputs) = (self.step.inputs.len(), self.step.outputs.len());
        let logic = &self.step.logic;
        let mut needed = vec![false; self.step.state.len()];
        let mut roots: Vec<Signal> = logic.outputs[..outputs].to_vec();
        let mut seen = vec![false; logic.signals()];
        while let Some(signal) = roots.pop() {
            if std::mem::replace(&mut seen[signal as usize], true) {
                continue;
            }
            if let Some(gate) = logic.gate(signal) {
                roots.extend((0..2).filter(|&pin| gate.function.depends_on(pin)).map(|pin| gate.pins[pin]));
            } else if let Some(bit) = (signal as usize).checked_sub(2 + ports) {
                needed[bit] = true;
                roots.push(logic.outputs[outputs + bit]);
            }
        }
        (0..needed.len()).filter(|&bit| needed[bit]).collect()
    }

    /// The number of inputs of both networks: the ports now and one step before, and the state.
    fn inputs(&self) -> usize {
        2 * self.step.inputs.len() + self.step.state.len()
    }

    fn port(&self, port: usize, is_late: bool) -> usize {
        if is_late { self.step.inputs.len() + port } else { port }
    }

    /// The source: its outputs with the ports of the step before, as after an edge, and the next state.
    fn source(&self, needed: &[usize]) -> Network {
        let (ports, outputs) = (self.step.inputs.len(), self.step.outputs.len());
        let mut made = Network::new(self.inputs());
        let mut copy = |is_late: bool| {
            let port = |port| made.input(self.port(port, is_late));
            let bit = |bit| self.equal(bit).map_or_else(Signal::from, |bit| made.input(2 * ports + bit));
            let inputs: Vec<Signal> = (0..ports).map(port).chain((0..self.step.state.len()).map(bit)).collect();
            made.include(&self.step.logic, &inputs)
        };
        let is_clocked = self.machine.clock.is_some();
        let (shown, next) = (copy(is_clocked), copy(false));
        made.outputs = shown[..outputs].iter().copied().chain(needed.iter().map(|&bit| next[outputs + bit])).collect();
        made
    }

    fn machine(&self, needed: &[usize]) -> Result<Network, String> {
        let mut steps = Steps { checker: self, made: Network::new(self.inputs()), signals: BTreeMap::new() };
        let mut outputs = Vec::new();
        let is_clocked = i64::from(self.machine.clock.is_some());
        for (&id, output) in self.machine.netlist.outputs().iter().zip(&self.machine.outputs) {
            let net = self.machine.netlist.pins(id)[0];
            let later = match self.shown(net)? {
                None => None,
                Some(shown) => {
                    // A cell shows a step at the end of the beat before its listeners read it.
                    let shown = shown - i64::from(self.machine.netlist.cell(net).is_some());
                    // After an edge an output shows what pins of the next step would read.
                    Some(self.steps(shown - output.phase, id)? + is_clocked)
                }
            };
            outputs.push(steps.signal(self.read(net, later, &output.starts), &output.starts, id)?);
        }
        for &bit in needed {
            // In the next step it is what a pin reads that is one step less late.
            let WaveState { net, later, starts } = &self.machine.state[bit];
            let reader = net.unwrap_or_default();
            outputs.push(steps.signal((*net, later - 1), &starts[1..], reader)?);
        }
        steps.made.outputs = outputs;
        Ok(steps.made)
    }
}

struct Steps<'a> {
    checker: &'a Checker<'a>,
    made: Network,
    signals: BTreeMap<NetId, Signal>,
}

impl Steps<'_> {
    fn signal(&mut self, (net, later): Place, starts: &[bool], reader: NetId) -> Result<Signal, String> {
        let checker = self.checker;
        if !starts.is_empty() {
            let bit = checker.equal(checker.bit((net, later), starts, reader)?);
            return Ok(bit.map_or_else(Signal::from, |bit| self.made.input(2 * checker.step.inputs.len() + bit)));
        }
        let (net, later) = match checker.place(net, later) {
            (Ok(net), later) => (net, later),
            (Err(value), _) => return Ok(Signal::from(value)),
        };
        match checker.machine.netlist.node(net) {
            Node::Input(_) if (0..=1).contains(&later) => {
                let port = checker.machine.netlist.inputs().iter().position(|&input| input == net);
                Ok(self.made.input(checker.port(port.expect("an input is listed"), later == 1)))
            }
            Node::Cell(_) if later == 0 => self.cell(net),
            _ => Err(reads_no_state(&checker.machine.netlist.net_name(reader))),
        }
    }

    fn cell(&mut self, root: NetId) -> Result<Signal, String> {
        let mut waiting = vec![root];
        while let Some(&id) = waiting.last() {
            if self.signals.contains_key(&id) {
                waiting.pop();
                continue;
            }
            let netlist = &self.checker.machine.netlist;
            let function = netlist.cell(id).map_or(Function::ZERO, |cell| cell.function);
            let mut pins = Vec::new();
            let mut missing = None;
            for (pin, net) in (0..).zip(netlist.pins(id)) {
                let starts = self.checker.machine.held.get(&(id, pin)).map_or(&[][..], |starts| starts);
                let read = self.checker.read(net, self.checker.later.get(&(id, pin)).copied(), starts);
                let before = match self.checker.place(read.0, read.1) {
                    (Ok(before), 0) if starts.is_empty() && netlist.cell(before).is_some() => Some(before),
                    _ => None,
                };
                match before.map(|before| (before, self.signals.get(&before))) {
                    Some((_, Some(&signal))) => pins.push(signal),
                    Some((before, None)) => missing = Some(before),
                    None => pins.push(self.signal(read, starts, id)?),
                }
            }
            match missing {
                Some(before) if waiting.contains(&before) => {
                    return Err(is_mixed(&netlist.net_name(before)));
                }
                Some(before) => waiting.push(before),
                None => {
                    // A cell of one pin reads it as both inputs.
                    pins.resize(function.inputs(), pins[0]);
                    let signal = self.made.add_function(function, &pins);
                    self.signals.insert(id, signal);
                }
            }
        }
        Ok(self.signals[&root])
    }
}
