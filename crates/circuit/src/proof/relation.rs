//! Proof by a relation between the states of two circuits: if it holds before a step, outputs are equal and it holds
//! after the step.
//!
//! The relation may come from anywhere. One that is wrong only makes the proof fail, so whoever made the result may
//! propose it.

use crate::formats::{Forcing, Register};
use crate::known::{TernaryBit, answer};
use crate::network::{Network, Signal, View};
use crate::proof::compare::equal;
use crate::proof::method::Method;
use crate::{NetId, Netlist, ProofError};
use nbc_base::model::Function;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counterpart {
    /// The register or the cut of the result with this number.
    Same(usize),
    /// What an earlier register or cut of the reference, with this number, is.
    Like(usize),
    Constant(bool),
    Unused,
}

pub struct Side<'a> {
    pub logic: &'a Netlist,
    pub registers: &'a [Register],
    pub cuts: Vec<NetId>,
}

impl Side<'_> {
    fn ports(&self) -> usize {
        self.logic.inputs().len() - self.registers.len()
    }

    fn states(&self) -> impl Iterator<Item = String> {
        let registers = self.registers.iter().map(|register| register.name.clone());
        registers.chain(self.cuts.iter().map(|&cut| self.logic.net_name(cut)))
    }

    fn start(&self, cell: NetId) -> Option<bool> {
        self.logic.cell(cell).and_then(|cell| cell.start)
    }

    /// The known start values, and those that follow from them with all inputs 0, whatever the delays.
    fn starts(&self, network: &Network) -> Vec<TernaryBit> {
        let mut starts: Vec<TernaryBit> = self.cuts.iter().map(|&cut| self.start(cut)).collect();
        let first = network.outputs.len() - self.cuts.len();
        while starts.contains(&None) {
            let mut values: Vec<TernaryBit> = [0, 1].map(|value| Some(value == 1)).to_vec();
            values.extend(vec![Some(false); self.ports()]);
            values.extend(self.registers.iter().map(|register| Some(register.starts_at())));
            values.extend(&starts);
            for gate in &network.gates {
                values.push(answer(gate.function, &gate.pins.map(|pin| values[pin as usize])));
            }
            let after = |(start, &output): (&TernaryBit, &Signal)| start.or(values[output as usize]);
            let next: Vec<TernaryBit> = starts.iter().zip(&network.outputs[first..]).map(after).collect();
            if next == starts {
                break;
            }
            starts = next;
        }
        starts
    }
}

/// Two circuits, and what each register and then each cut of the first is in the second.
pub struct StateRelation<'a> {
    pub reference: Side<'a>,
    pub result: Side<'a>,
    pub registers: Vec<Counterpart>,
    pub cuts: Vec<Counterpart>,
}

type Pair = (String, Signal, Signal);

impl StateRelation<'_> {
    pub fn prove(&self) -> Result<Method, ProofError> {
        self.starts()?;
        let Self { reference, result, .. } = self;
        let [one, two] = [reference, result].map(|side| {
            let view = View::of(side.logic, &side.cuts);
            view.map(|view| view.network).map_err(|id| ProofError::NewLoop(side.logic.net_name(id)))
        });
        let (one, two) = (one?, two?);
        self.cuts_start(&one, &two)?;
        let ports = reference.ports();
        // The inputs of both: the ports, the state of the result, and what the result does without.
        let mut names: Vec<String> =
            reference.logic.inputs()[..ports].iter().map(|&id| reference.logic.net_name(id)).collect();
        names.extend(result.states());
        let mut inputs: Vec<Signal> = (0..ports).map(|port| port as Signal + 2).collect();
        for (&counterpart, name) in self.registers.iter().chain(&self.cuts).zip(reference.states()) {
            inputs.push(match counterpart {
                Counterpart::Same(at) => (ports + at) as Signal + 2,
                Counterpart::Like(register) => inputs[ports + register],
                Counterpart::Constant(value) => Signal::from(value),
                Counterpart::Unused => {
                    names.push(name);
                    names.len() as Signal + 1
                }
            });
        }
        let all: Vec<Signal> = (0..two.inputs).map(|input| input as Signal + 2).collect();
        let (mut one, two) = (over(&one, names.len(), &inputs), over(&two, names.len(), &all));
        let pairs = self.pairs(&mut one, &two);
        let [mut first, mut second] = [one, two];
        first.outputs = pairs.iter().map(|&(_, signal, _)| signal).collect();
        second.outputs = pairs.iter().map(|&(_, _, signal)| signal).collect();
        equal(&first, &second).map_err(|(output, values)| ProofError::Different {
            output: pairs[output].0.clone(),
            inputs: names.into_iter().zip(values).collect(),
        })
    }

    fn starts(&self) -> Result<(), ProofError> {
        let Self { reference, result, .. } = self;
        for (register, &counterpart) in reference.registers.iter().zip(&self.registers) {
            let change = |register: &Register| (register.kind, register.forcing, register.clock.clone());
            let alike =
                |other: &Register| register.starts_at() == other.starts_at() && change(register) == change(other);
            let is_alike = match counterpart {
                Counterpart::Same(at) => alike(&result.registers[at]),
                Counterpart::Like(at) => alike(&reference.registers[at]),
                Counterpart::Constant(value) => register.starts_at() == value,
                Counterpart::Unused => true,
            };
            if !is_alike {
                return Err(ProofError::Start(register.name.clone()));
            }
        }
        Ok(())
    }

    /// Compares the start values of both sides, where both are known.
    fn cuts_start(&self, one: &Network, two: &Network) -> Result<(), ProofError> {
        let Self { reference, result, .. } = self;
        let [starts, others] = [(reference, one), (result, two)].map(|(side, network)| side.starts(network));
        for ((&cut, &counterpart), &start) in reference.cuts.iter().zip(&self.cuts).zip(&starts) {
            let other = match counterpart {
                Counterpart::Same(at) => others[at - result.registers.len()],
                Counterpart::Like(at) => starts[at - reference.registers.len()],
                Counterpart::Constant(_) | Counterpart::Unused => continue,
            };
            let is_declared = reference.start(cut).is_some();
            if start.is_some() && start != other && (is_declared || other.is_some()) {
                return Err(ProofError::Start(reference.logic.net_name(cut)));
            }
        }
        Ok(())
    }

    fn pairs(&self, one: &mut Network, two: &Network) -> Vec<Pair> {
        let Self { reference, result, .. } = self;
        let ports = |side: &Side<'_>| side.logic.outputs().len() - Register::outputs(side.registers);
        let (shown, others) = (ports(reference), ports(result));
        let name = |at: usize| reference.logic.net_name(reference.logic.outputs()[at]);
        let mut pairs: Vec<Pair> = (0..shown).map(|at| (name(at), one.outputs[at], two.outputs[at])).collect();
        let forcing = |registers: &[Register], first: usize| -> Vec<usize> {
            let mut next = first + registers.len();
            let count = |register: &Register| {
                next += register.forcing.nets().len();
                next - register.forcing.nets().len()
            };
            registers.iter().map(count).collect()
        };
        let (forced, others_forced) = (forcing(reference.registers, shown), forcing(result.registers, others));
        for (at, register) in reference.registers.iter().enumerate() {
            let (next, nets) = (one.outputs[shown + at], forced[at]..forced[at] + register.forcing.nets().len());
            match self.registers[at] {
                Counterpart::Same(other) => {
                    pairs.push((register.name.clone(), next, two.outputs[others + other]));
                    let nets = nets.zip(others_forced[other]..);
                    pairs.extend(nets.map(|(net, other)| (name(net), one.outputs[net], two.outputs[other])));
                }
                Counterpart::Like(other) => {
                    let nets = nets.zip(forced[other]..);
                    for (net, other) in nets.chain([(shown + at, shown + other)]) {
                        let differs = one.add(Function::XOR, [one.outputs[net], one.outputs[other]]);
                        pairs.push((name(net), differs, 0));
                    }
                }
                Counterpart::Constant(value) => {
                    let nets: Vec<Signal> = nets.map(|net| one.outputs[net]).collect();
                    for before in [next, Signal::from(value)] {
                        let after = forced_value(one, register, before, &nets);
                        pairs.push((register.name.clone(), after, Signal::from(value)));
                    }
                }
                Counterpart::Unused => {}
            }
        }
        let (first, second) = (reference.logic.outputs().len(), result.logic.outputs().len());
        for (at, &counterpart) in self.cuts.iter().enumerate() {
            let name = reference.logic.net_name(reference.cuts[at]);
            let next = one.outputs[first + at];
            match counterpart {
                Counterpart::Same(other) => {
                    pairs.push((name, next, two.outputs[second + other - result.registers.len()]));
                }
                Counterpart::Like(other) => {
                    let other = one.outputs[first + other - reference.registers.len()];
                    pairs.push((name, one.add(Function::XOR, [next, other]), 0));
                }
                Counterpart::Constant(_) | Counterpart::Unused => {}
            }
        }
        pairs
    }
}

fn forced_value(network: &mut Network, register: &Register, value: Signal, nets: &[Signal]) -> Signal {
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
