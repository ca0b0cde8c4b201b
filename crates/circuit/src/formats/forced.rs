//! Latches as synthesizers write them: opened by logic of a clock and of what sets and resets them.

use crate::network::{Network, Signal, View};
use crate::proof::equal;
use crate::{Forcing, NetId, Netlist, Node, RegisterKind, RegisterNode};
use nbc_base::model::Function;

/// The outputs of the logic of a latch.
const DATA: usize = 0;
const OPEN: usize = 1;

/// An input of the logic, and a value of it.
type Case = (Signal, bool);

/// What opens a latch by itself; what forces it and to what value, the strongest first; and its data when it is open.
struct Parts {
    clock: Case,
    forces: Vec<(Case, bool)>,
    data: Network,
}

/// Gives each of these latches one net as its clock and nets that force it; returns those that have no such nets.
pub fn force(logic: &mut Netlist, latches: &[NetId]) -> Vec<NetId> {
    if latches.is_empty() {
        return Vec::new();
    }
    let registers: Vec<NetId> = logic.registers().map(|(id, _)| id).collect();
    // A loop of cells has no such view.
    let Ok(view) = View::of(logic, &registers) else { return latches.to_vec() };
    let mut nets = [false, true].map(|value| logic.add_constant(value)).to_vec();
    nets.extend(logic.inputs().iter().chain(&registers));
    let mut left = Vec::new();
    for &latch in latches {
        let [data, clock] = [RegisterNode::DATA, RegisterNode::CLOCK].map(|pin| logic.pins(latch)[usize::from(pin)]);
        let is_low = logic.register(latch).is_some_and(|latch| latch.kind == RegisterKind::Low);
        let mut whole = view.network.clone();
        let function = if is_low { Function::NOT } else { Function::BUF };
        let open = whole.add(function, [view.signal[&clock]; 2]);
        whole.outputs = vec![view.signal[&data], open];
        match Parts::of(whole.swept()) {
            Some(parts) => parts.connect(logic, latch, &nets),
            None => left.push(latch),
        }
    }
    left
}

impl Parts {
    fn of(mut rest: Network) -> Option<Self> {
        let mut forces = Vec::new();
        loop {
            let mut opening = Vec::new();
            for input in support(&rest) {
                let cases = [false, true].map(|value| with(&rest, (input, value)));
                let opens = [0, 1].map(|value| constant(&cases[value], OPEN));
                let [at_0, at_1] = cases;
                match opens {
                    [Some(false), Some(true)] => return Some(Self { clock: (input, true), forces, data: at_1 }),
                    [Some(true), Some(false)] => return Some(Self { clock: (input, false), forces, data: at_0 }),
                    [Some(true), _] => opening.push(((input, false), at_0)),
                    [_, Some(true)] => opening.push(((input, true), at_1)),
                    _ => {}
                }
            }
            let (force, value) = opening.iter().find_map(|(case, at)| Some((*case, constant(at, DATA)?)))?;
            forces.push((force, value));
            rest = with(&rest, (force.0, !force.1));
        }
    }

    /// `nets` are those of the constants and of the inputs of the logic.
    fn connect(self, logic: &mut Netlist, latch: NetId, nets: &[NetId]) {
        let net = |logic: &mut Netlist, (source, value): Case| match value {
            true => nets[source as usize],
            false => logic.add_gate(Function::NOT, &[nets[source as usize]]),
        };
        let start = logic.register(latch).and_then(|latch| latch.start);
        let (forcing, start, forced) = match self.forces[..] {
            [] => (Forcing::Never, start, vec![]),
            [(case, value)] if start.is_none_or(|start| start == value) => {
                (Forcing::ToStart, Some(value), vec![net(logic, case)])
            }
            _ => {
                let [mut set, mut reset] = [None; 2];
                let or = |logic: &mut Netlist, one: NetId, two: Option<NetId>| {
                    Some(two.map_or(one, |two| logic.add_gate(Function::OR, &[one, two])))
                };
                for &(case, value) in self.forces.iter().rev() {
                    let one = net(logic, case);
                    if value {
                        set = or(logic, one, set);
                        reset = reset.map(|reset| logic.add_gate(Function::AND.with_input_inverted(0), &[one, reset]));
                    } else {
                        reset = or(logic, one, reset);
                    }
                }
                (Forcing::SetReset, start, [set, reset].map(|net| net.unwrap_or(nets[0])).to_vec())
            }
        };
        let data = add(logic, &self.data, nets);
        if let Node::Register(register) = logic.node_mut(latch) {
            let kind = if self.clock.1 { RegisterKind::High } else { RegisterKind::Low };
            (register.kind, register.forcing, register.start) = (kind, forcing, start);
        }
        let pins = [data, nets[self.clock.0 as usize]].into_iter().chain(forced);
        (0..).zip(pins).for_each(|(pin, net)| logic.drive(latch, pin, net));
    }
}

/// The inputs that may open a latch.
fn support(network: &Network) -> Vec<Signal> {
    let opening = Network { outputs: vec![network.outputs[OPEN]], ..network.clone() }.swept();
    let is_read = |input: &Signal| opening.gates.iter().any(|gate| gate.pins.contains(input));
    (0..opening.inputs).map(|at| opening.input(at)).filter(is_read).collect()
}

fn with(network: &Network, (source, value): Case) -> Network {
    let mut made = Network::new(network.inputs);
    let input = |at| Some(made.input(at)).filter(|&input| input != source).unwrap_or(Signal::from(value));
    let inputs: Vec<Signal> = (0..network.inputs).map(input).collect();
    made.outputs = made.include(network, &inputs);
    made
}

fn constant(network: &Network, output: usize) -> Option<bool> {
    let shown = Network { outputs: vec![network.outputs[output]], ..network.clone() }.swept();
    [false, true].into_iter().find(|&value| {
        let constant = Network { outputs: vec![Signal::from(value)], ..Network::new(network.inputs) };
        equal(&shown, &constant).is_ok()
    })
}

fn add(logic: &mut Netlist, network: &Network, nets: &[NetId]) -> NetId {
    let network = Network { outputs: vec![network.outputs[DATA]], ..network.clone() }.swept();
    let mut nets = nets.to_vec();
    for gate in &network.gates {
        let pins = gate.pins.map(|pin| nets[pin as usize]);
        let inverts = gate.function.output(false, false);
        nets.push(match gate.function.arity() {
            1 => logic.add_gate(if inverts { Function::NOT } else { Function::BUF }, &pins[..1]),
            _ => logic.add_gate(gate.function, &pins),
        });
    }
    nets[network.outputs[0] as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A latch with its clock in input 0 and its data in input 1, forced by others, the strongest of them first.
    fn latch(low: bool, forces: &[(usize, bool, bool)]) -> (Netlist, NetId) {
        let mut logic = Netlist::new("m");
        let inputs: Vec<NetId> = (0..5).map(|at| logic.add_input(format!("i{at}"))).collect();
        let (mut open, mut data) = (inputs[0], inputs[1]);
        if low {
            open = logic.add_gate(Function::NOT, &[open]);
        }
        for &(input, at, value) in forces.iter().rev() {
            let case = logic.add_gate(if at { Function::BUF } else { Function::NOT }, &[inputs[input]]);
            open = logic.add_gate(Function::OR, &[case, open]);
            data = match value {
                true => logic.add_gate(Function::OR, &[case, data]),
                false => logic.add_gate(Function::AND.with_input_inverted(0), &[case, data]),
            };
        }
        let node = RegisterNode {
            kind: RegisterKind::High,
            forcing: Forcing::Never,
            start: None,
            name: Some("q".to_owned()),
            span: None,
        };
        let latch = logic.add_register(node, &[data, open]);
        logic.add_output("q", latch);
        (logic, latch)
    }

    /// What a latch is after each pattern of the inputs, from 0 and from 1.
    fn next(logic: &Netlist, latch: NetId) -> Vec<bool> {
        let network = View::of(logic, &[latch]).unwrap().network;
        let register = logic.register(latch).unwrap();
        let patterns =
            (0..1 << network.inputs).map(|pattern: u32| (0..network.inputs).map(move |at| pattern >> at & 1 == 1));
        patterns
            .map(|mut pattern| {
                let pins = network.run(pattern.clone());
                let is_open = pins[2] == (register.kind == RegisterKind::High);
                let kept = if is_open { pins[1] } else { pattern.next_back().unwrap() };
                match (register.forcing, &pins[3..]) {
                    (Forcing::ToStart, [true]) => register.starts_at(),
                    (Forcing::SetReset, &[set, reset]) => (kept || set) && !reset,
                    _ => kept,
                }
            })
            .collect()
    }

    #[test]
    fn a_latch_that_is_forced_does_what_it_did() {
        let forces = [(2, true, false), (3, true, true), (4, false, false), (2, true, true)];
        let chosen =
            [&forces[..0], &forces[..1], &forces[1..2], &forces[..2], &forces[1..3], &forces[..3], &forces[1..]];
        for (forces, low) in chosen.iter().flat_map(|forces| [(forces, false), (forces, true)]) {
            let (mut logic, latch) = latch(low, forces);
            let before = next(&logic, latch);
            assert_eq!(force(&mut logic, &[latch]), []);
            assert_eq!(next(&logic, latch), before, "{forces:?} {low}");
            assert_eq!(logic.pins(latch)[1], logic.inputs()[0]);
        }
    }

    #[test]
    fn a_latch_that_two_inputs_open_together_has_no_clock() {
        let (mut logic, latch) = latch(false, &[(2, true, false)]);
        let both = logic.add_gate(Function::AND, &[logic.inputs()[0], logic.inputs()[3]]);
        logic.drive(latch, RegisterNode::CLOCK, both);
        assert_eq!(force(&mut logic, &[latch]), [latch]);
    }
}
