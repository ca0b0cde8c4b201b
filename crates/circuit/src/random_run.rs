//! Runs of a netlist with registers from its start.
//!
//! A step of a random run changes a clock, an input that forces registers, or other inputs, but never two of these
//! together: what a register takes when its clock and its data change at once is not defined.

use std::collections::BTreeSet;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::network::{Network, Signal, View};
use crate::register::{Forcing, RegisterKind};
use crate::{NetId, Netlist, RegisterNode};

const HABIT: usize = 64;

const TRIES: usize = 64;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DesignRun {
    pub inputs: Vec<Vec<bool>>,
    pub outputs: Vec<Vec<bool>>,
}

impl DesignRun {
    /// `ports` are the input ports, each a list of its bits. None if the netlist has feedback, or does not settle.
    pub(crate) fn random(netlist: &Netlist, ports: &[Vec<usize>], steps: usize, seed: u64) -> Option<Self> {
        let machine = Machine::of(netlist)?;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut now = machine.calm(&mut random)?;
        let mut run = Self::default();
        run.push(&machine, &now);
        let [clocks, forcing] =
            [&machine.clock_inputs, &machine.forcing_inputs].map(|set| set.iter().copied().collect());
        let mut habits = Habits { clocks, forcing, first: now.inputs.clone(), words: Vec::new() };
        for step in 0..steps {
            if step % HABIT == 0 {
                habits.words = ports.iter().map(|_| random.random_range(0..6)).collect();
            }
            let inputs = habits.inputs(&now.inputs, ports, &mut random);
            let next = machine.after(&now, inputs)?;
            if !machine.is_unclear(&now, &next) {
                now = next;
                run.push(&machine, &now);
            }
        }
        Some(run)
    }

    pub(crate) fn with(netlist: &Netlist, inputs: Vec<Vec<bool>>) -> Option<Self> {
        let machine = Machine::of(netlist)?;
        let states = machine.starts();
        let mut now = Values { inputs: inputs[0].clone(), states, outputs: Vec::new() };
        let mut run = Self::default();
        for inputs in inputs {
            now = machine.after(&now, inputs)?;
            run.push(&machine, &now);
        }
        Some(run)
    }

    fn push(&mut self, machine: &Machine, values: &Values) {
        self.inputs.push(values.inputs.clone());
        self.outputs.push(values.outputs[..machine.shown].to_vec());
    }
}

struct Habits {
    clocks: Vec<usize>,
    forcing: Vec<usize>,
    /// The inputs at the start, at which no register is forced if that is possible.
    first: Vec<bool>,
    words: Vec<u8>,
}

impl Habits {
    fn inputs(&self, before: &[bool], ports: &[Vec<usize>], random: &mut ChaCha8Rng) -> Vec<bool> {
        let mut inputs = before.to_vec();
        let mut among = |list: &[usize]| list[random.random_range(0..list.len())];
        let forced: Vec<usize> = self.forcing.iter().copied().filter(|&at| before[at] != self.first[at]).collect();
        let (clock, force) = (
            (!self.clocks.is_empty()).then(|| among(&self.clocks)),
            (!self.forcing.is_empty()).then(|| among(if forced.is_empty() { &self.forcing } else { &forced })),
        );
        let pick = random.random_range(0..100);
        // Most of the time nothing is forced.
        let force = force.filter(|_| pick >= if forced.is_empty() { 97 } else { 70 });
        let clock = clock.filter(|_| pick < 50);
        if let Some(at) = force.or(clock) {
            inputs[at] = !inputs[at];
            return inputs;
        }
        let is_apart = |at: &usize| self.clocks.contains(at) || self.forcing.contains(at);
        for (port, habit) in ports.iter().zip(&self.words) {
            if port.iter().any(is_apart) || random.random_range(0..2) == 0 {
                continue;
            }
            for &at in port {
                let rare = random.random_range(0..16) == 0;
                inputs[at] = match habit {
                    0 | 1 => random.random_range(0..2) == 1,
                    2 => rare,
                    3 => !rare,
                    4 => random.random_range(0..4) == 0,
                    _ => inputs[at] != rare,
                };
            }
        }
        inputs
    }
}

struct Machine {
    registers: Vec<RegisterNode>,
    /// Its inputs are those of the netlist and then the registers, its outputs those of the netlist and then the pins
    /// of the registers.
    network: Network,
    inputs: usize,
    shown: usize,
    clock_inputs: BTreeSet<usize>,
    forcing_inputs: BTreeSet<usize>,
    /// For each register, the first output that is one of its pins.
    places: Vec<usize>,
}

struct Values {
    inputs: Vec<bool>,
    states: Vec<bool>,
    outputs: Vec<bool>,
}

impl Machine {
    fn of(netlist: &Netlist) -> Option<Self> {
        let ids: Vec<NetId> = netlist.registers().map(|(id, _)| id).collect();
        let network = View::of(netlist, &ids).ok()?.network;
        let registers: Vec<RegisterNode> = netlist.registers().map(|(_, register)| register.clone()).collect();
        let (inputs, shown) = (netlist.inputs().len(), netlist.outputs().len());
        let mut at = shown;
        let mut places = Vec::new();
        for register in &registers {
            places.push(at);
            at += register.pins();
        }
        let (clock_inputs, forcing_inputs) = (BTreeSet::new(), BTreeSet::new());
        let mut machine = Self { registers, network, inputs, shown, clock_inputs, forcing_inputs, places };
        let pins = |at: usize| machine.places[at]..machine.places[at] + machine.registers[at].pins();
        let all = || (0..machine.registers.len()).map(pins);
        machine.clock_inputs = machine.inputs_of(all().map(|pins| pins.start + 1));
        machine.forcing_inputs = machine.inputs_of(all().flat_map(|pins| pins.skip(2)));
        Some(machine)
    }

    fn inputs_of(&self, outputs: impl Iterator<Item = usize>) -> BTreeSet<usize> {
        let mut open: Vec<Signal> = outputs.map(|at| self.network.outputs[at]).collect();
        let mut seen: BTreeSet<Signal> = open.iter().copied().collect();
        let mut inputs = BTreeSet::new();
        while let Some(signal) = open.pop() {
            match self.network.gate(signal) {
                Some(gate) => open.extend(gate.pins.into_iter().filter(|&pin| seen.insert(pin))),
                None => inputs.extend((signal as usize).checked_sub(2).filter(|&at| at < self.inputs)),
            }
        }
        inputs
    }

    fn starts(&self) -> Vec<bool> {
        self.registers.iter().map(RegisterNode::starts_at).collect()
    }

    fn calm(&self, random: &mut ChaCha8Rng) -> Option<Values> {
        let states = self.starts();
        let mut best: Option<(usize, Vec<bool>)> = None;
        let single = self.forcing_inputs.iter().map(|&at| vec![at]);
        let random = (0..TRIES).map(|_| {
            self.forcing_inputs.iter().copied().filter(|_| random.random_range(0..2) == 1).collect::<Vec<_>>()
        });
        for ones in std::iter::once(Vec::new()).chain(single).chain(random) {
            let mut inputs = vec![false; self.inputs];
            ones.into_iter().for_each(|at| inputs[at] = true);
            let values = self.simulate(&inputs, &states);
            let count = (0..states.len()).filter(|&at| self.force(at, &values).contains(&true)).count();
            if best.as_ref().is_none_or(|(least, _)| count < *least) {
                best = Some((count, inputs));
            }
            if count == 0 {
                break;
            }
        }
        let (_, inputs) = best?;
        let before = Values { inputs: inputs.clone(), states, outputs: Vec::new() };
        self.after(&before, inputs)
    }

    fn simulate(&self, inputs: &[bool], states: &[bool]) -> Vec<bool> {
        self.network.run(inputs.iter().chain(states).copied())
    }

    fn force<'v>(&self, at: usize, outputs: &'v [bool]) -> &'v [bool] {
        &outputs[self.places[at]..][2..self.registers[at].pins()]
    }

    fn after(&self, before: &Values, inputs: Vec<bool>) -> Option<Values> {
        let count = before.states.len();
        let clocks_of = |outputs: &[bool]| self.places.iter().map(|&place| outputs[place + 1]).collect::<Vec<_>>();
        let mut clocks = clocks_of(&self.simulate(&before.inputs, &before.states));
        let mut states = before.states.clone();
        for _ in 0..count + 2 {
            let outputs = self.simulate(&inputs, &states);
            let now = clocks_of(&outputs);
            let next = |at: usize| {
                let register = &self.registers[at];
                let takes = match register.kind {
                    RegisterKind::Rising => now[at] && !clocks[at],
                    RegisterKind::Falling => !now[at] && clocks[at],
                    RegisterKind::High => now[at],
                    RegisterKind::Low => !now[at],
                };
                match (register.forcing, self.force(at, &outputs)) {
                    (Forcing::ToStart, [true]) => register.starts_at(),
                    (Forcing::SetReset, [_, true]) => false,
                    (Forcing::SetReset, [true, _]) => true,
                    _ if takes => outputs[self.places[at]],
                    _ => states[at],
                }
            };
            let nexts: Vec<bool> = (0..count).map(next).collect();
            if nexts == states {
                return Some(Values { inputs, states, outputs });
            }
            (states, clocks) = (nexts, now);
        }
        None
    }

    /// Whether a step changes what forces a register that was forced before. Sources of hardware describe this by edges
    /// of nets, which are not what a register does then.
    fn is_unclear(&self, before: &Values, after: &Values) -> bool {
        (0..after.states.len()).any(|at| {
            let (one, two) = (self.force(at, &before.outputs), self.force(at, &after.outputs));
            one.len() == 2 && one != two && one.contains(&true) && two.contains(&true)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Function;

    fn toggle(kind: RegisterKind) -> Netlist {
        let mut netlist = Netlist::new("toggle");
        let [clock, reset] = ["clk", "r"].map(|name| netlist.add_input(name));
        let (forcing, name) = (Forcing::ToStart, Some("q".to_owned()));
        let register = RegisterNode { kind, forcing, start: Some(true), name, span: None };
        let state = netlist.add_loose_register(register);
        let next = netlist.add_gate(Function::NOT, &[state]);
        (0..).zip([next, clock, reset]).for_each(|(pin, net)| netlist.connect(state, pin, net));
        netlist.add_output("q", state);
        netlist
    }

    #[test]
    fn a_register_turns_at_its_edges_and_is_reset_without_one() {
        for kind in [RegisterKind::Rising, RegisterKind::Falling] {
            let run = DesignRun::random(&toggle(kind), &[vec![0], vec![1]], 2_000, 1).unwrap();
            assert_eq!((&run.inputs[0], &run.outputs[0]), (&vec![false, false], &vec![true]));
            let (mut turns, mut resets) = (0, 0);
            for (inputs, outputs) in run.inputs.windows(2).zip(run.outputs.windows(2)) {
                let [clock, reset] = [0, 1].map(|at| (inputs[0][at], inputs[1][at]));
                let edge = clock.1 != clock.0 && clock.1 == (kind == RegisterKind::Rising);
                assert_eq!(outputs[1][0], outputs[0][0] != edge || reset.1, "{inputs:?} {outputs:?}");
                turns += usize::from(edge && !reset.1);
                resets += usize::from(reset.1 && !reset.0);
            }
            assert_eq!(DesignRun::with(&toggle(kind), run.inputs.clone()), Some(run));
            assert!(turns > 300 && resets > 10, "{turns} {resets}");
        }
    }

    #[test]
    fn a_latch_that_turns_itself_does_not_settle() {
        assert!(DesignRun::random(&toggle(RegisterKind::High), &[vec![0], vec![1]], 100, 1).is_none());
    }
}
