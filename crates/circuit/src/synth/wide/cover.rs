//! The cover of a network by cells: a cut for each gate that stays, chosen by the cells that it takes, exactly counted.

use std::collections::BTreeMap;

use crate::cells::CellLibrary;
use crate::network::{Network, Signal};
use crate::options::MappingObjective;
use crate::recipes::{Operand, Recipe, Recipes};
use crate::synth::wide::CellNetwork;
use crate::synth::wide::cuts::{Cut, cuts};
use nbc_base::model::Function;

const ROUNDS: usize = 4;

pub struct Coverer<'a> {
    library: &'a CellLibrary,
    recipes: Recipes,
    objective: MappingObjective,
    /// Of each function of two inputs and of each of three, if it can be made.
    prices: [Vec<Option<Price>>; 2],
}

#[derive(Clone, Copy)]
struct Price {
    cost: u32,
    /// In cycles.
    delay: u32,
}

impl<'a> Coverer<'a> {
    pub fn new(library: &'a CellLibrary, objective: MappingObjective) -> Self {
        let recipes = Recipes::of(library);
        let narrow = |function| {
            let delay = |recipe: &Recipe| recipe.steps.iter().map(|step| clock(library, step.function)).sum();
            recipes.get(function).map(|recipe| Price { cost: recipe.cost, delay: delay(recipe) })
        };
        let wide = |function| library.get(function).map(|kind| Price { cost: kind.cost, delay: kind.clock });
        let prices = [Function::all().map(narrow).collect(), Function::all_of(3).map(wide).collect()];
        Self { library, recipes, objective, prices }
    }

    fn price(&self, function: Function) -> Option<Price> {
        self.prices[function.inputs() - 2][usize::from(function.bits())]
    }

    /// The cost, then the slowest path in cycles; the other way round where the objective is the delay.
    pub fn weight(&self, network: &CellNetwork) -> (u32, u32) {
        let mut arrivals = vec![0; 2 + network.inputs];
        let mut cost = 0;
        for cell in &network.cells {
            let latest = cell.pins.iter().map(|&pin| arrivals[pin as usize]).max().unwrap_or(0);
            arrivals.push(latest + clock(self.library, cell.function));
            cost += self.library.get(cell.function).map_or(1, |kind| kind.cost);
        }
        let slowest = network.outputs.iter().map(|&output| arrivals[output as usize]).max().unwrap_or(0);
        if self.objective == MappingObjective::Delay { (slowest, cost) } else { (cost, slowest) }
    }

    /// Gates of functions that the library cannot make in any way stay as they are.
    pub fn cover(&self, network: &Network) -> CellNetwork {
        let swept = network.swept();
        let mut choice = Choice::new(self, &swept);
        choice.choose_by_flow();
        (0..ROUNDS).for_each(|_| choice.choose_exactly());
        choice.build()
    }
}

fn clock(library: &CellLibrary, function: Function) -> u32 {
    library.get(function).map_or(1, |kind| kind.clock)
}

struct Choice<'a> {
    coverer: &'a Coverer<'a>,
    network: &'a Network,
    cuts: Vec<Vec<(Cut, Price)>>,
    chosen: Vec<usize>,
    readers: Vec<u32>,
    arrivals: Vec<u32>,
}

impl<'a> Choice<'a> {
    fn new(coverer: &'a Coverer<'a>, network: &'a Network) -> Self {
        let priced = |cut: Cut| Some((cut, coverer.price(cut.function())?));
        let cuts: Vec<Vec<_>> =
            cuts(network).into_iter().map(|all| all.into_iter().filter_map(priced).collect()).collect();
        let signals = network.signals();
        let chosen = vec![0; cuts.len()];
        Self { coverer, network, cuts, chosen, readers: vec![0; signals], arrivals: vec![0; signals] }
    }

    fn gate(&self, signal: Signal) -> Option<usize> {
        (signal as usize).checked_sub(2 + self.network.inputs)
    }

    fn arrival(&self, (cut, price): &(Cut, Price)) -> u32 {
        cut.leaves().iter().map(|&leaf| self.arrivals[leaf as usize]).max().unwrap_or(0) + price.delay
    }

    /// A first choice by the flow of cost: what a signal costs is shared by all gates that read it.
    fn choose_by_flow(&mut self) {
        let first = 2 + self.network.inputs;
        let mut fanout = vec![0u32; self.network.signals()];
        let pins = self.network.gates.iter().flat_map(|gate| gate.pins);
        pins.chain(self.network.outputs.iter().copied()).for_each(|signal| fanout[signal as usize] += 1);
        let mut flows = vec![0.0f64; self.network.signals()];
        for at in 0..self.cuts.len() {
            let flow = |(cut, price): &(Cut, Price)| {
                let share = |&leaf: &Signal| flows[leaf as usize] / f64::from(fanout[leaf as usize].max(1));
                f64::from(price.cost) + cut.leaves().iter().map(share).sum::<f64>()
            };
            let ranks: Vec<(f64, u32)> = self.cuts[at].iter().map(|one| (flow(one), self.arrival(one))).collect();
            let better = |one: &usize, two: &usize| {
                let ((flow, arrival), (other, later)) = (ranks[*one], ranks[*two]);
                match self.coverer.objective {
                    MappingObjective::Delay => arrival.cmp(&later).then(flow.total_cmp(&other)),
                    _ => flow.total_cmp(&other).then(arrival.cmp(&later)),
                }
            };
            let Some(best) = (0..ranks.len()).min_by(better) else { continue };
            self.chosen[at] = best;
            (flows[first + at], self.arrivals[first + at]) = ranks[best];
        }
        for &output in &self.network.outputs {
            self.count(output, true);
        }
    }

    /// Counts a reader of a signal more or less, and of the signals that its cell needs; returns the change of cost.
    fn count(&mut self, signal: Signal, more: bool) -> u32 {
        let (mut cost, mut pending) = (0, vec![signal]);
        while let Some(signal) = pending.pop() {
            let Some(gate) = self.gate(signal) else { continue };
            let readers = &mut self.readers[signal as usize];
            let changes = if more { *readers == 0 } else { *readers == 1 };
            *readers = if more { *readers + 1 } else { *readers - 1 };
            if let (true, Some((cut, price))) = (changes, self.cuts[gate].get(self.chosen[gate])) {
                cost += price.cost;
                pending.extend_from_slice(cut.leaves());
            }
        }
        cost
    }

    fn exact(&mut self, gate: usize, at: usize) -> u32 {
        let (cut, price) = self.cuts[gate][at];
        let taken = self.take_leaves(cut);
        self.leave_leaves(cut);
        price.cost + taken
    }

    fn take_leaves(&mut self, cut: Cut) -> u32 {
        cut.leaves().iter().map(|&leaf| self.count(leaf, true)).sum()
    }

    fn leave_leaves(&mut self, cut: Cut) {
        for &leaf in cut.leaves() {
            self.count(leaf, false);
        }
    }

    /// Improves one choice after the other. With the objective delay, no output becomes later.
    fn choose_exactly(&mut self) {
        let first = 2 + self.network.inputs;
        let required = self.required();
        for gate in 0..self.cuts.len() {
            let signal = first + gate;
            if self.cuts[gate].len() > 1 {
                let readers = std::mem::take(&mut self.readers[signal]);
                if readers > 0 {
                    self.leave_leaves(self.cuts[gate][self.chosen[gate]].0);
                }
                let ranks: Vec<(bool, u32, u32)> = (0..self.cuts[gate].len())
                    .map(|at| {
                        let arrival = self.arrival(&self.cuts[gate][at]);
                        (arrival > required[signal], self.exact(gate, at), arrival)
                    })
                    .collect();
                let best = (0..ranks.len()).min_by_key(|&at| ranks[at]).expect("there are several");
                self.chosen[gate] = best;
                if readers > 0 {
                    self.take_leaves(self.cuts[gate][best].0);
                }
                self.readers[signal] = readers;
            }
            if let Some(one) = self.cuts[gate].get(self.chosen[gate]) {
                self.arrivals[signal] = self.arrival(one);
            }
        }
    }

    /// The latest arrival of each signal with which no output is later than the slowest is now.
    fn required(&self) -> Vec<u32> {
        let mut required = vec![u32::MAX; self.network.signals()];
        if self.coverer.objective != MappingObjective::Delay {
            return required;
        }
        let outputs = || self.network.outputs.iter().map(|&output| output as usize);
        let slowest = outputs().map(|output| self.arrivals[output]).max().unwrap_or(0);
        outputs().for_each(|output| required[output] = slowest);
        for gate in (0..self.cuts.len()).rev() {
            let signal = 2 + self.network.inputs + gate;
            let Some((cut, price)) = self.cuts[gate].get(self.chosen[gate]) else { continue };
            if self.readers[signal] > 0 {
                let latest = required[signal].saturating_sub(price.delay);
                cut.leaves().iter().for_each(|&leaf| required[leaf as usize] = required[leaf as usize].min(latest));
            }
        }
        required
    }

    fn build(self) -> CellNetwork {
        let network = self.network;
        let mut built = CellNetwork { inputs: network.inputs, ..CellNetwork::default() };
        let mut steps = BTreeMap::new();
        let mut made: Vec<Signal> = (0..(2 + network.inputs) as Signal).collect();
        for (at, gate) in network.gates.iter().enumerate() {
            let signal = 2 + network.inputs + at;
            let own = match self.cuts[at].get(self.chosen[at]) {
                _ if self.readers[signal] == 0 => 0,
                Some((cut, _)) => {
                    let pins: Vec<Signal> = cut.leaves().iter().map(|&leaf| made[leaf as usize]).collect();
                    self.cell(&mut built, &mut steps, cut.function(), &pins)
                }
                None => built.add(gate.function, gate.pins.map(|pin| made[pin as usize]).to_vec()),
            };
            made.push(own);
        }
        built.outputs = network.outputs.iter().map(|&output| made[output as usize]).collect();
        built
    }

    /// Adds the cells of a function of these signals; `known` are the steps of recipes that are there.
    fn cell(
        &self,
        built: &mut CellNetwork,
        known: &mut BTreeMap<(Function, Vec<Signal>), Signal>,
        function: Function,
        pins: &[Signal],
    ) -> Signal {
        if function.inputs() == 3 {
            return built.add(function, pins.to_vec());
        }
        let recipe = self.coverer.recipes.get(function).expect("a cut with a price can be made");
        let mut steps: Vec<Signal> = Vec::with_capacity(recipe.steps.len());
        let signal = |operand: Operand, steps: &[Signal]| match operand {
            Operand::Input(pin) => pins[usize::from(pin)],
            Operand::Constant(value) => Signal::from(value),
            Operand::Step(step) => steps[usize::from(step)],
        };
        for step in &recipe.steps {
            let used = if step.function.depends_on(1) { 2 } else { 1 };
            let pins: Vec<Signal> = step.pins.iter().take(used).map(|&operand| signal(operand, &steps)).collect();
            let same = known.entry((step.function, pins.clone()));
            steps.push(*same.or_insert_with(|| built.add(step.function, pins)));
        }
        signal(recipe.result, &steps)
    }
}
