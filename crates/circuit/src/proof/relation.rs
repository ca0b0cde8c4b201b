//! Proof by a relation between the states of two circuits: if it holds before a step, outputs are equal and it holds
//! after the step.
//!
//! The relation may come from anywhere. One that is wrong only makes the proof fail, so whoever made the result may
//! propose it.

use crate::known::{TernaryBit, answer};
use crate::network::{Network, Signal, View};
use crate::proof::compare::equal;
use crate::proof::method::Method;
use crate::register::{Forcing, RegisterKind};
use crate::{NetId, Netlist, ProofError, RegisterNode};
use nbc_base::model::Function;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counterpart {
    /// The state of the result with this number.
    Same(usize),
    /// What an earlier state of the reference, with this number, is.
    Like(usize),
    Constant(bool),
    Unused,
}

pub struct Side<'a> {
    pub logic: &'a Netlist,
    /// Registers and cells of loops; no loop is without one.
    pub states: Vec<NetId>,
}

impl Side<'_> {
    fn ports(&self) -> usize {
        self.logic.inputs().len()
    }

    fn name(&self, state: usize) -> String {
        self.logic.net_name(self.states[state])
    }

    fn register(&self, state: usize) -> Option<&RegisterNode> {
        self.logic.register(self.states[state])
    }

    fn start(&self, state: usize) -> TernaryBit {
        let net = self.states[state];
        match self.logic.register(net) {
            Some(register) => Some(register.starts_at()),
            None => self.logic.cell(net).and_then(|cell| cell.start),
        }
    }

    /// For each state, the first output of the network that is one of its pins, or its next value.
    fn places(&self) -> Vec<usize> {
        let mut next = self.logic.outputs().len();
        let place = |&state: &NetId| {
            let first = next;
            next += self.logic.register(state).map_or(1, RegisterNode::pins);
            first
        };
        self.states.iter().map(place).collect()
    }

    /// The known start values, and those that follow from them with all inputs 0, whatever the delays.
    fn starts(&self, network: &Network) -> Vec<TernaryBit> {
        let mut starts: Vec<TernaryBit> = (0..self.states.len()).map(|state| self.start(state)).collect();
        let places = self.places();
        while starts.contains(&None) {
            let mut values: Vec<TernaryBit> = [0, 1].map(|value| Some(value == 1)).to_vec();
            values.extend(vec![Some(false); self.ports()]);
            values.extend(&starts);
            for gate in &network.gates {
                values.push(answer(gate.function, &gate.pins.map(|pin| values[pin as usize])));
            }
            let after = |(start, &place): (&TernaryBit, &usize)| start.or(values[network.outputs[place] as usize]);
            let next: Vec<TernaryBit> = starts.iter().zip(&places).map(after).collect();
            if next == starts {
                break;
            }
            starts = next;
        }
        starts
    }
}

/// Two circuits, and what each state of the first is in the second.
pub struct StateRelation<'a> {
    pub reference: Side<'a>,
    pub result: Side<'a>,
    pub counterparts: Vec<Counterpart>,
}

type Pair = (String, Signal, Signal);

impl StateRelation<'_> {
    pub fn prove(&self) -> Result<Method, ProofError> {
        let Self { reference, result, .. } = self;
        let [one, two] = [reference, result].map(|side| {
            let view = View::of(side.logic, &side.states);
            view.map(|view| view.network).map_err(|id| ProofError::NewLoop(side.logic.net_name(id)))
        });
        let (one, two) = (one?, two?);
        self.starts(&one, &two)?;
        let ports = reference.ports();
        // The inputs of both: the ports, the state of the result, and what the result does without.
        let mut names: Vec<String> = reference.logic.inputs().iter().map(|&id| reference.logic.net_name(id)).collect();
        names.extend((0..result.states.len()).map(|state| result.name(state)));
        let mut inputs: Vec<Signal> = (0..ports).map(|port| port as Signal + 2).collect();
        for (state, &counterpart) in self.counterparts.iter().enumerate() {
            inputs.push(match counterpart {
                Counterpart::Same(at) => (ports + at) as Signal + 2,
                Counterpart::Like(first) => inputs[ports + first],
                Counterpart::Constant(value) => Signal::from(value),
                Counterpart::Unused => {
                    names.push(reference.name(state));
                    names.len() as Signal + 1
                }
            });
        }
        let all: Vec<Signal> = (0..two.inputs).map(|input| input as Signal + 2).collect();
        let (mut one, mut two) = (over(&one, names.len(), &inputs), over(&two, names.len(), &all));
        let pairs = self.pairs(&mut one, &mut two);
        let [mut first, mut second] = [one, two];
        first.outputs = pairs.iter().map(|&(_, signal, _)| signal).collect();
        second.outputs = pairs.iter().map(|&(_, _, signal)| signal).collect();
        equal(&first, &second).map_err(|(output, values)| ProofError::Different {
            output: pairs[output].0.clone(),
            inputs: names.into_iter().zip(values).collect(),
        })
    }

    /// Compares the kinds of registers, and the start values of both sides where both are known.
    fn starts(&self, one: &Network, two: &Network) -> Result<(), ProofError> {
        let Self { reference, result, .. } = self;
        let [starts, others] = [(reference, one), (result, two)].map(|(side, network)| side.starts(network));
        for (state, &counterpart) in self.counterparts.iter().enumerate() {
            let (side, at, other) = match counterpart {
                Counterpart::Same(at) => (result, at, others[at]),
                Counterpart::Like(at) => (reference, at, starts[at]),
                Counterpart::Constant(value) => (reference, state, Some(value)),
                Counterpart::Unused => continue,
            };
            let kind = |register: &RegisterNode| (register.kind.is_edge(), register.forcing);
            let is_alike = reference.register(state).map(kind) == side.register(at).map(kind);
            let is_declared = reference.start(state).is_some();
            let differs = starts[state].is_some() && starts[state] != other && (is_declared || other.is_some());
            if !is_alike || differs {
                return Err(ProofError::Start(reference.name(state)));
            }
        }
        Ok(())
    }

    fn pairs(&self, one: &mut Network, two: &mut Network) -> Vec<Pair> {
        let Self { reference, result, .. } = self;
        let name = |at: usize| reference.logic.net_name(reference.logic.outputs()[at]);
        let shown = reference.logic.outputs().len();
        let mut pairs: Vec<Pair> = (0..shown).map(|at| (name(at), one.outputs[at], two.outputs[at])).collect();
        let (places, others) = (reference.places(), result.places());
        for (state, &counterpart) in self.counterparts.iter().enumerate() {
            let name = reference.name(state);
            let seen = seen(one, reference.register(state), places[state]);
            match counterpart {
                Counterpart::Same(at) => {
                    let other = self::seen(two, result.register(at), others[at]);
                    pairs.extend(seen.into_iter().zip(other).map(|(one, other)| (name.clone(), one, other)));
                }
                Counterpart::Like(at) => {
                    let other = self::seen(one, reference.register(at), places[at]);
                    for (own, other) in seen.into_iter().zip(other) {
                        pairs.push((name.clone(), one.add(Function::XOR, [own, other]), 0));
                    }
                }
                Counterpart::Constant(value) => {
                    let register = reference.register(state).expect("only registers are known to be constant");
                    let pins = one.outputs[places[state]..][..register.pins()].to_vec();
                    for before in [pins[0], Signal::from(value)] {
                        let after = forced_value(one, register, before, &pins[2..]);
                        pairs.push((name.clone(), after, Signal::from(value)));
                    }
                }
                Counterpart::Unused => {}
            }
        }
        pairs
    }
}

/// What decides the next value of a state: of a cell, that value; of a register, its clock as if it were rising or
/// high, what forces it, and its data while it is not forced.
fn seen(network: &mut Network, register: Option<&RegisterNode>, place: usize) -> Vec<Signal> {
    let Some(register) = register else { return vec![network.outputs[place]] };
    let pins = network.outputs[place..place + register.pins()].to_vec();
    let clock = match register.kind {
        RegisterKind::Rising | RegisterKind::High => pins[1],
        RegisterKind::Falling | RegisterKind::Low => network.add(Function::NOT, [pins[1]; 2]),
    };
    let unless = Function::AND.with_input_inverted(1);
    let data = pins[2..].iter().fold(pins[0], |data, &force| network.add(unless, [data, force]));
    [data, clock].iter().chain(&pins[2..]).copied().collect()
}

fn forced_value(network: &mut Network, register: &RegisterNode, value: Signal, nets: &[Signal]) -> Signal {
    let unless = Function::AND.with_input_inverted(1);
    match (register.forcing, nets) {
        (Forcing::SetReset, &[set, reset]) => {
            let set = network.add(Function::OR, [value, set]);
            network.add(unless, [set, reset])
        }
        (Forcing::ToStart, &[reset]) if register.starts_at() => network.add(Function::OR, [value, reset]),
        (Forcing::ToStart, &[reset]) => network.add(unless, [value, reset]),
        _ => value,
    }
}

fn over(network: &Network, inputs: usize, signals: &[Signal]) -> Network {
    let mut other = Network::new(inputs);
    other.outputs = other.include(network, signals);
    other
}
