//! The graph that the search changes: gates of a library with their values in every pattern and their fan-out.

use crate::index::ListIndex;
use crate::network::{Network, Signal, counting_word, word};
use crate::recipes::Operand;
use crate::synth::prices::Prices;
use nbc_base::model::Function;

#[derive(Clone, Debug)]
pub struct GraphNode {
    /// Its function; meaningless for sources.
    pub function: Function,
    /// The signals of its pins; the same twice for functions of one input.
    pub pins: [Signal; 2],
    pub refs: u32,
    /// Whether it is a gate in use, as opposed to a source or a free place.
    pub alive: bool,
    /// The latest loop that it may depend on, counted in topological order.
    pub stage: u32,
    /// Cycles after which it is correct, if each cell takes its clock.
    pub arrival: u32,
}

#[derive(Clone, Debug, Default)]
struct Scratch {
    pending: Vec<Signal>,
    touched: Vec<Signal>,
    stale: Vec<bool>,
}

/// Gates with their values; places of dead gates are used again.
#[derive(Clone, Debug)]
pub struct Graph<'p> {
    pub prices: &'p Prices,
    inputs: usize,
    /// 64-bit words of values of each signal.
    pub width: usize,
    pub nodes: Vec<GraphNode>,
    pub all_values: Vec<u64>,
    fanout: Vec<Vec<Signal>>,
    pub outputs: Vec<Signal>,
    /// The gates in use, drivers first.
    pub order: Vec<Signal>,
    position: Vec<Option<ListIndex>>,
    free: Vec<Signal>,
    pub cost: u32,
    /// The gate that is about to be removed, which no new gate may read.
    pub leaving: Option<Signal>,
    scratch: Scratch,
}

impl<'p> Graph<'p> {
    /// The graph of a network with the given patterns, `width` words for each input.
    pub fn new(network: &Network, prices: &'p Prices, stages: &[u32], patterns: &[Vec<u64>]) -> Self {
        let width = patterns.first().map_or(1, Vec::len);
        let mut graph = Self {
            prices,
            inputs: network.inputs,
            width,
            nodes: Vec::new(),
            all_values: Vec::new(),
            fanout: Vec::new(),
            outputs: Vec::new(),
            order: Vec::new(),
            position: Vec::new(),
            free: Vec::new(),
            cost: 0,
            leaving: None,
            scratch: Scratch::default(),
        };
        let zero = vec![0; width];
        let one = vec![!0; width];
        graph.source(0, &zero);
        graph.source(0, &one);
        for i in 0..network.inputs {
            graph.source(stages.get(i).copied().unwrap_or(0), patterns.get(i).unwrap_or(&zero));
        }
        let mut made: Vec<Signal> = (0..2 + network.inputs as Signal).collect();
        for gate in &network.gates {
            let signal = graph.make(gate.function, gate.pins.map(|pin| made[pin as usize]));
            made.push(signal);
        }
        for &output in &network.outputs {
            let signal = made[output as usize];
            graph.nodes[signal as usize].refs += 1;
            graph.outputs.push(signal);
        }
        graph.drop_unused();
        graph.sort();
        graph
    }

    fn source(&mut self, stage: u32, values: &[u64]) {
        self.nodes.push(GraphNode { function: Function::BUF, pins: [0; 2], refs: 0, alive: false, stage, arrival: 0 });
        self.all_values.extend(values);
        self.fanout.push(Vec::new());
    }

    pub fn position(&self, signal: Signal) -> usize {
        self.position[signal as usize].expect("a gate in use has a place in the order").get() as usize
    }

    pub fn node(&self, signal: Signal) -> &GraphNode {
        &self.nodes[signal as usize]
    }

    pub fn first_gate(&self) -> Signal {
        2 + self.inputs as Signal
    }

    pub fn fanout(&self, signal: Signal) -> &[Signal] {
        &self.fanout[signal as usize]
    }

    pub fn values(&self, signal: Signal) -> &[u64] {
        &self.all_values[signal as usize * self.width..][..self.width]
    }

    pub fn make(&mut self, function: Function, pins: [Signal; 2]) -> Signal {
        let pins = match (function.depends_on(0), function.depends_on(1)) {
            (true, true) => pins,
            (true, false) => [pins[0]; 2],
            (false, true) => [pins[1]; 2],
            (false, false) => return Signal::from(function == Function::ONE),
        };
        if function == Function::BUF || function == Function::BUF_B {
            return pins[0];
        }
        self.find(function, pins).unwrap_or_else(|| self.make_new(function, pins))
    }

    fn find(&self, function: Function, pins: [Signal; 2]) -> Option<Signal> {
        if function == Function::NOT && self.nodes[pins[0] as usize].function == Function::NOT {
            return Some(self.nodes[pins[0] as usize].pins[0]);
        }
        let [a, b] = pins;
        let shorter = if self.fanout[a as usize].len() <= self.fanout[b as usize].len() { a } else { b };
        let equal = |node: &GraphNode| {
            node.function == function && node.pins == pins
                || node.pins == [b, a] && node.function == function.swapped() && a != b
        };
        let stays = |gate: Signal| Some(gate) != self.leaving;
        self.fanout[shorter as usize].iter().copied().find(|&gate| equal(&self.nodes[gate as usize]) && stays(gate))
    }

    pub fn make_new(&mut self, function: Function, pins: [Signal; 2]) -> Signal {
        let stage = pins.map(|pin| self.nodes[pin as usize].stage).into_iter().max().unwrap_or(0);
        let node = GraphNode { function, pins, refs: 0, alive: true, stage, arrival: self.arrival(function, pins) };
        let signal = match self.free.pop() {
            Some(place) => {
                self.nodes[place as usize] = node;
                place
            }
            None => {
                self.nodes.push(node);
                self.all_values.resize(self.all_values.len() + self.width, 0);
                self.fanout.push(Vec::new());
                (self.nodes.len() - 1) as Signal
            }
        };
        self.simulate(signal);
        for pin in distinct(pins) {
            self.nodes[pin as usize].refs += 1;
            self.fanout[pin as usize].push(signal);
        }
        self.cost += self.prices.cell(function);
        signal
    }

    fn arrival(&self, function: Function, pins: [Signal; 2]) -> u32 {
        let latest = pins.map(|pin| self.nodes[pin as usize].arrival).into_iter().max().unwrap_or(0);
        latest + self.prices.clock(function)
    }

    pub fn depth(&self) -> u32 {
        self.outputs.iter().map(|&output| self.nodes[output as usize].arrival).max().unwrap_or(0)
    }

    pub fn compose(&mut self, function: Function, pins: [Signal; 2]) -> Option<Signal> {
        let prices = self.prices;
        let recipe = prices.recipe(function)?;
        let mut made = [0 as Signal; 16];
        let read = |made: &[Signal; 16], operand: Operand| match operand {
            Operand::Input(pin) => pins[usize::from(pin)],
            Operand::Constant(value) => Signal::from(value),
            Operand::Step(i) => made[usize::from(i)],
        };
        for (i, step) in recipe.steps.iter().enumerate() {
            made[i] = self.make(step.function, step.pins.map(|operand| read(&made, operand)));
        }
        let root = read(&made, recipe.result);
        self.hold(root);
        made[..recipe.steps.len()].iter().for_each(|&step| self.release(step));
        self.let_go(root);
        Some(root)
    }

    fn simulate(&mut self, signal: Signal) -> bool {
        let GraphNode { function, pins: [a, b], .. } = self.nodes[signal as usize];
        let (a, b, out) = (a as usize * self.width, b as usize * self.width, signal as usize * self.width);
        let mut changed = 0;
        for i in 0..self.width {
            let value = word(function, self.all_values[a + i], self.all_values[b + i]);
            changed |= value ^ self.all_values[out + i];
            self.all_values[out + i] = value;
        }
        changed != 0
    }

    pub fn same(&self, one: Signal, two: Signal) -> bool {
        let (one, two) = (self.node(one), self.node(two));
        let swapped = [two.pins[1], two.pins[0]];
        one.function == two.function && one.pins == two.pins
            || one.function == two.function.swapped() && one.pins == swapped
    }

    pub fn hold(&mut self, signal: Signal) {
        self.nodes[signal as usize].refs += 1;
    }

    pub fn let_go(&mut self, signal: Signal) {
        self.nodes[signal as usize].refs -= 1;
    }

    /// The cost released if no gate read `signal` any more.
    pub fn released(&mut self, signal: Signal) -> u32 {
        let mut released = 0;
        let Scratch { mut pending, mut touched, stale } = std::mem::take(&mut self.scratch);
        pending.push(signal);
        while let Some(gate) = pending.pop() {
            released += self.prices.cell(self.nodes[gate as usize].function);
            for pin in distinct(self.nodes[gate as usize].pins) {
                let node = &mut self.nodes[pin as usize];
                node.refs -= 1;
                touched.push(pin);
                if node.refs == 0 && node.alive {
                    pending.push(pin);
                }
            }
        }
        touched.drain(..).for_each(|pin| self.nodes[pin as usize].refs += 1);
        self.scratch = Scratch { pending, touched, stale };
        released
    }

    pub fn release(&mut self, signal: Signal) {
        if !self.nodes[signal as usize].alive || self.nodes[signal as usize].refs > 0 {
            return;
        }
        let mut pending = std::mem::take(&mut self.scratch.pending);
        pending.push(signal);
        while let Some(gate) = pending.pop() {
            let node = &mut self.nodes[gate as usize];
            if !node.alive || node.refs > 0 {
                continue;
            }
            node.alive = false;
            let (function, pins) = (node.function, node.pins);
            // A removed gate must not be mistaken for an inverter.
            node.function = Function::BUF;
            self.cost -= self.prices.cell(function);
            for pin in distinct(pins) {
                self.nodes[pin as usize].refs -= 1;
                let listeners = &mut self.fanout[pin as usize];
                // Most removed gates were added recently, and are at the end of the list.
                let at = listeners.iter().rposition(|&listener| listener == gate).expect("a listener is on the list");
                listeners.swap_remove(at);
                pending.push(pin);
            }
            self.free.push(gate);
        }
        self.scratch.pending = pending;
    }

    pub fn substitute(&mut self, old: Signal, new: Signal) {
        for gate in std::mem::take(&mut self.fanout[old as usize]) {
            let before = self.nodes[gate as usize].pins;
            let after = before.map(|pin| if pin == old { new } else { pin });
            self.nodes[gate as usize].pins = after;
            if !before.contains(&new) {
                self.fanout[new as usize].push(gate);
                self.nodes[new as usize].refs += 1;
            }
            self.nodes[old as usize].refs -= 1;
        }
        for output in &mut self.outputs {
            if *output == old {
                *output = new;
                self.nodes[new as usize].refs += 1;
                self.nodes[old as usize].refs -= 1;
            }
        }
        self.release(old);
    }

    fn drop_unused(&mut self) {
        for signal in (0..self.nodes.len()).rev() {
            self.release(signal as Signal);
        }
    }

    pub fn sort(&mut self) {
        self.order.clear();
        self.position.clear();
        self.position.resize(self.nodes.len(), None);
        let mut stack: Vec<Signal> = Vec::new();
        for i in 0..self.outputs.len() {
            stack.push(self.outputs[i]);
            while let Some(&signal) = stack.last() {
                let node = &self.nodes[signal as usize];
                if !node.alive || self.position[signal as usize].is_some() {
                    stack.pop();
                    continue;
                }
                let waits = |&pin: &Signal| self.nodes[pin as usize].alive && self.position[pin as usize].is_none();
                match node.pins.into_iter().find(waits) {
                    Some(pin) => stack.push(pin),
                    None => {
                        self.position[signal as usize] = Some(ListIndex::new(self.order.len() as u32));
                        self.order.push(signal);
                        stack.pop();
                    }
                }
            }
        }
    }

    pub fn refresh(&mut self, root: Signal) {
        self.scratch.stale.clear();
        self.scratch.stale.resize(self.nodes.len(), false);
        self.fanout[root as usize].iter().for_each(|&reader| self.scratch.stale[reader as usize] = true);
        for i in 0..self.order.len() {
            let signal = self.order[i];
            let GraphNode { function, pins, .. } = self.nodes[signal as usize];
            let stage = pins.map(|pin| self.nodes[pin as usize].stage);
            self.nodes[signal as usize].stage = stage[0].max(stage[1]);
            self.nodes[signal as usize].arrival = self.arrival(function, pins);
            if self.scratch.stale[signal as usize] && self.simulate(signal) {
                self.fanout[signal as usize].iter().for_each(|&reader| self.scratch.stale[reader as usize] = true);
            }
        }
    }

    pub fn is_output(&self, signal: Signal) -> bool {
        self.nodes[signal as usize].refs as usize > self.fanout[signal as usize].len()
    }

    pub fn finish(mut self, outputs: impl Iterator<Item = Signal>) -> Network {
        for output in outputs {
            self.nodes[output as usize].refs += 1;
            self.outputs.push(output);
        }
        self.drop_unused();
        self.sort();
        self.network()
    }

    pub fn network(&self) -> Network {
        let mut network = Network::new(self.inputs);
        let mut signal: Vec<Signal> = (0..self.nodes.len() as Signal).collect();
        for &gate in &self.order {
            let GraphNode { function, pins, .. } = self.nodes[gate as usize];
            signal[gate as usize] = network.add(function, pins.map(|pin| signal[pin as usize]));
        }
        network.outputs = self.outputs.iter().map(|&output| signal[output as usize]).collect();
        network
    }
}

fn distinct(pins: [Signal; 2]) -> impl Iterator<Item = Signal> {
    let [a, b] = pins;
    std::iter::once(a).chain((a != b).then_some(b))
}

pub fn every_pattern(inputs: usize) -> Vec<Vec<u64>> {
    let words = (1usize << inputs).div_ceil(64);
    (0..inputs).map(|i| (0..words).map(|block| counting_word(i, block)).collect()).collect()
}
