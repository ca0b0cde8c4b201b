//! Runs of a design from its start.
//!
//! A step of a random run changes a clock, an input that forces registers, or other inputs, but never two of these
//! together: what a register takes when its clock and its data change at once is not defined.

use std::collections::BTreeSet;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::formats::{Design, Forcing, RegisterKind};
use crate::network::{Network, Signal, View};

const HABIT: usize = 64;

const TRIES: usize = 64;

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DesignRun {
    pub inputs: Vec<Vec<bool>>,
    pub outputs: Vec<Vec<bool>>,
}

impl DesignRun {
    /// `ports` are the input ports, each a list of its bits. None if the design has feedback, or does not settle.
    pub(crate) fn random(design: &Design, ports: &[Vec<usize>], steps: usize, seed: u64) -> Option<Self> {
        let machine = Machine::of(design)?;
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

    pub(crate) fn with(design: &Design, inputs: Vec<Vec<bool>>) -> Option<Self> {
        let machine = Machine::of(design)?;
        let states = design.registers.iter().map(|register| register.starts_at()).collect();
        let mut now = Values { inputs: inputs[0].clone(), states, outputs: Vec::new() };
        let mut run = Self::default();
        for inputs in inputs {
            now = machine.after(&now, inputs)?;
            run.push(&machine, &now);
        }
        Some(run)
    }

    fn push(&mut self, machine: &Machine<'_>, values: &Values) {
        self.inputs.push(values.inputs.clone());
        self.outputs.push(values.outputs[..machine.design.outputs()].to_vec());
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

struct Machine<'d> {
    design: &'d Design,
    network: Network,
    /// The input of the network that clocks each register: a port or the value of a register.
    clocks: Vec<usize>,
    clock_inputs: BTreeSet<usize>,
    forcing_inputs: BTreeSet<usize>,
    /// For each register, the first of the outputs of the network that force it.
    forced: Vec<usize>,
}

struct Values {
    inputs: Vec<bool>,
    states: Vec<bool>,
    outputs: Vec<bool>,
}

impl<'d> Machine<'d> {
    fn of(design: &'d Design) -> Option<Self> {
        let network = View::of(&design.logic, &[]).ok()?.network;
        let names: Vec<String> = design.logic.inputs().iter().map(|&id| design.logic.net_name(id)).collect();
        let clock = |name: &str| names.iter().position(|known| known == name);
        let clocks: Vec<usize> =
            design.registers.iter().map(|register| clock(register.clock_name())).collect::<Option<_>>()?;
        let mut at = design.outputs() + design.registers.len();
        let mut forced = Vec::new();
        for register in &design.registers {
            forced.push(at);
            at += register.forcing.nets().len();
        }
        let mut machine = Self {
            design,
            clock_inputs: clocks.iter().copied().filter(|&at| at < design.inputs()).collect(),
            clocks,
            forcing_inputs: BTreeSet::new(),
            forced,
            network,
        };
        machine.forcing_inputs = machine.forcing_inputs();
        Some(machine)
    }

    fn forcing_inputs(&self) -> BTreeSet<usize> {
        let first = self.design.outputs() + self.design.registers.len();
        let mut open: Vec<Signal> = self.network.outputs[first..].to_vec();
        let mut seen: BTreeSet<Signal> = open.iter().copied().collect();
        let mut inputs = BTreeSet::new();
        while let Some(signal) = open.pop() {
            match self.network.gate(signal) {
                Some(gate) => open.extend(gate.pins.into_iter().filter(|&pin| seen.insert(pin))),
                None => inputs.extend((signal as usize).checked_sub(2).filter(|&at| at < self.design.inputs())),
            }
        }
        inputs
    }

    fn calm(&self, random: &mut ChaCha8Rng) -> Option<Values> {
        let states: Vec<bool> = self.design.registers.iter().map(|register| register.starts_at()).collect();
        let mut best: Option<(usize, Vec<bool>)> = None;
        let single = self.forcing_inputs.iter().map(|&at| vec![at]);
        let random = (0..TRIES).map(|_| {
            self.forcing_inputs.iter().copied().filter(|_| random.random_range(0..2) == 1).collect::<Vec<_>>()
        });
        for ones in std::iter::once(Vec::new()).chain(single).chain(random) {
            let mut inputs = vec![false; self.design.inputs()];
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
        &outputs[self.forced[at]..][..self.design.registers[at].forcing.nets().len()]
    }

    fn after(&self, before: &Values, inputs: Vec<bool>) -> Option<Values> {
        let count = before.states.len();
        let mut clocks: Vec<bool> = (0..count).map(|at| self.clock(at, &before.inputs, &before.states)).collect();
        let mut states = before.states.clone();
        for _ in 0..count + 2 {
            let outputs = self.simulate(&inputs, &states);
            let now: Vec<bool> = (0..count).map(|at| self.clock(at, &inputs, &states)).collect();
            let next = |at: usize| {
                let register = &self.design.registers[at];
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
                    _ if takes => outputs[self.design.outputs() + at],
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

    fn clock(&self, at: usize, inputs: &[bool], states: &[bool]) -> bool {
        let at = self.clocks[at];
        at.checked_sub(inputs.len()).map_or_else(|| inputs[at], |state| states[state])
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
    use crate::Netlist;
    use crate::formats::Register;
    use nbc_base::model::Function;

    fn toggle(kind: RegisterKind) -> Design {
        let mut logic = Netlist::new("toggle");
        let [_, reset, state] = ["clk", "r", "q"].map(|name| logic.add_input(name));
        let next = logic.add_gate(Function::NOT, &[state]);
        let outputs = [("q", state), ("q_next", next), ("q_reset", reset)];
        outputs.into_iter().for_each(|(name, net)| _ = logic.add_output(name, net));
        let clock = Some("clk".to_owned());
        let register = Register { name: "q".to_owned(), kind, clock, start: Some(true), forcing: Forcing::ToStart };
        Design::new(logic, vec![register])
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
