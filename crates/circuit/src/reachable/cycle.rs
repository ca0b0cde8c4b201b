//! One cycle of a design of flip-flops, as a network: from the inputs and the state to the next state.

use std::collections::{BTreeMap, BTreeSet};

use crate::formats::Design;
use crate::network::{Gate, Network, Signal, counting_word};
use nbc_base::model::Function;

pub(super) struct Cycle {
    /// Its inputs are the input ports, the registers, and an input for each of several clock edges; its outputs are the
    /// next values of the registers.
    pub(super) network: Network,
    pub(super) ports: usize,
    pub(super) start: Vec<bool>,
}

impl Cycle {
    pub(super) fn of(design: &Design, logic: &Network) -> Self {
        let mut edges: BTreeMap<(u8, &str), usize> = BTreeMap::new();
        for register in &design.registers {
            let fresh = edges.len();
            edges.entry((register.kind as u8, register.clock_name())).or_insert(fresh);
        }
        let ticks = if edges.len() > 1 { edges.len() } else { 0 };
        let mut network = with_inputs(logic, ticks);
        let nexts = network.outputs.split_off(design.outputs());
        network.outputs.clear();
        for (at, register) in design.registers.iter().enumerate() {
            let next = match ticks {
                0 => nexts[at],
                _ => {
                    let tick = network.input(logic.inputs + edges[&(register.kind as u8, register.clock_name())]);
                    let state = network.input(design.inputs() + at);
                    let taken = network.add(Function::AND, [nexts[at], tick]);
                    let kept = network.add(Function::AND.with_input_inverted(1), [state, tick]);
                    network.add(Function::OR, [taken, kept])
                }
            };
            network.outputs.push(next);
        }
        let start = design.registers.iter().map(|register| register.starts_at()).collect();
        Self { network, ports: design.inputs(), start }
    }

    fn free(&self) -> usize {
        self.network.inputs - self.start.len()
    }

    pub(super) fn register(&self, at: usize) -> usize {
        self.ports + at
    }

    pub(super) fn is_register(&self, input: usize) -> bool {
        (self.ports..self.ports + self.start.len()).contains(&input)
    }

    pub(super) fn next(&self, inputs: &[u64]) -> Vec<u64> {
        let values = self.network.simulate(inputs);
        self.network.outputs.iter().map(|&next| values[next as usize]).collect()
    }

    /// All states that can be reached from the start, register `i` being bit `i`, unless there may be too many.
    pub(super) fn reachable(&self) -> Option<BTreeSet<u64>> {
        if self.start.len() > MOST_REGISTERS || self.free() > MOST_FREE {
            return None;
        }
        let start = number(&self.start);
        let mut reached = BTreeSet::from([start]);
        let mut pending = vec![start];
        while let Some(state) = pending.pop() {
            let new = self.successors(state).into_iter().filter(|&next| reached.insert(next));
            pending.extend(new.collect::<Vec<_>>());
        }
        Some(reached)
    }

    fn successors(&self, state: u64) -> BTreeSet<u64> {
        let lanes = 64.min(1 << self.free());
        let mut found = BTreeSet::new();
        for block in 0..(1usize << self.free()).div_ceil(64) {
            let mut free = 0..;
            let inputs: Vec<u64> = (0..self.network.inputs)
                .map(|input| match input.checked_sub(self.ports).filter(|_| self.is_register(input)) {
                    Some(at) => filled(state >> at & 1 == 1),
                    None => counting_word(free.next().expect("numbers do not end"), block),
                })
                .collect();
            let next = self.next(&inputs);
            let lane = |lane: usize| next.iter().rev().fold(0, |state, word| state << 1 | word >> lane & 1);
            found.extend((0..lanes).map(lane));
        }
        found
    }
}

/// The most registers and other inputs of a design whose states are enumerated.
const MOST_REGISTERS: usize = 12;
const MOST_FREE: usize = 10;

fn with_inputs(network: &Network, more: usize) -> Network {
    let first = 2 + network.inputs as Signal;
    let moved = |signal: Signal| if signal < first { signal } else { signal + more as Signal };
    Network {
        inputs: network.inputs + more,
        gates: network.gates.iter().map(|gate| Gate { pins: gate.pins.map(moved), ..*gate }).collect(),
        outputs: network.outputs.iter().map(|&output| moved(output)).collect(),
    }
}

fn number(bits: &[bool]) -> u64 {
    bits.iter().rev().fold(0, |number, &bit| number << 1 | u64::from(bit))
}

pub(super) fn filled(value: bool) -> u64 {
    if value { !0 } else { 0 }
}
