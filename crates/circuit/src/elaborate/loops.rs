//! Loops without a start value: found by looking at a module with all bits cut that have one.

use std::collections::BTreeSet;

use crate::elaborate::build::Builder;
use crate::elaborate::module::{Bit, Module, ModuleId, ModuleSignal, Passes, Site};
use crate::elaborate::wording;
use nbc_base::budget::{Limit, OverBudget};
use nbc_base::diag::Diagnostic;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

impl Builder<'_> {
    pub(super) fn look_for_loops(&mut self, top: ModuleId) {
        let mut open = vec![top];
        while let Some(id) = open.pop().filter(|_| self.over.is_none()) {
            if std::mem::replace(&mut self.inspected[id.0 as usize], true) {
                continue;
            }
            open.extend(self.module(id).sites.iter().map(|site| site.module));
            for fault in self.loops_of(id) {
                self.fault(fault);
            }
        }
    }

    fn loops_of(&mut self, id: ModuleId) -> Vec<Diagnostic> {
        // Most modules have none, which is quick to see.
        if is_straight(self.module(id)) {
            return Vec::new();
        }
        let coarse = loops(&self.graph(self.module(id), None));
        // At first, a circuit inside was assumed to pass every input to every output; now check its real dependencies.
        let module = self.module(id);
        let has_sites = coarse
            .iter()
            .flatten()
            .any(|&at| at >= module.signals.len() || matches!(module.signals[at], ModuleSignal::Output { .. }));
        let exact = if has_sites {
            if self.find_passes(id).is_none() {
                return Vec::new();
            }
            loops(&self.graph(self.module(id), Some(&self.passes)))
        } else {
            coarse
        };
        exact.iter().filter_map(|signals| warning(self.module(id), signals)).collect()
    }

    /// Visits each module once; `None` after too many steps.
    fn find_passes(&mut self, id: ModuleId) -> Option<()> {
        let inside: BTreeSet<ModuleId> = self.module(id).sites.iter().map(|site| site.module).collect();
        for site in inside {
            if !self.passes.contains_key(&site) {
                self.find_passes(site)?;
                let found = self.passes_of(site)?;
                self.passes.insert(site, found);
            }
        }
        let passed = self.module(id).sites.iter().flat_map(|site| &self.passes[&site.module]);
        let passed = passed.map(|inputs| inputs.len() as u64).sum();
        self.take_steps(passed)
    }

    fn take_steps(&mut self, steps: u64) -> Option<()> {
        let taken = self.budget.take(Limit::LoopSteps, steps);
        if taken == Err(OverBudget::Cancelled) {
            self.over = Some(OverBudget::Cancelled);
        }
        taken.ok()
    }

    /// Nodes are the signals, and then the circuits inside whose passes are not known.
    fn graph(&self, module: &Module, exact: Option<&Passes>) -> DiGraph<(), ()> {
        let signals = module.signals.len();
        let mut graph = DiGraph::with_capacity(signals + module.sites.len(), 2 * signals);
        for _ in 0..signals + module.sites.len() {
            graph.add_node(());
        }
        let mut edge = |from: usize, to: usize| _ = graph.add_edge(NodeIndex::new(from), NodeIndex::new(to), ());
        let mut started = vec![false; signals];
        module.starts.iter().for_each(|&(bit, _)| started[bit as usize] = true);
        for (at, signal) in module.signals.iter().enumerate() {
            match *signal {
                ModuleSignal::Gate { function, pins, .. } => {
                    pins[..function.arity()].iter().for_each(|&pin| edge(pin as usize, at))
                }
                ModuleSignal::Net { driver: Some(driver), .. } if !started[at] => edge(driver.get() as usize, at),
                ModuleSignal::Output { site, bit } => match exact {
                    Some(passes) => {
                        let Site { module, inputs, .. } = &module.sites[site as usize];
                        passes[module][bit as usize]
                            .iter()
                            .for_each(|&input| edge(inputs[input as usize] as usize, at));
                    }
                    None => edge(signals + site as usize, at),
                },
                _ => {}
            }
        }
        if exact.is_none() {
            for (at, site) in module.sites.iter().enumerate() {
                site.inputs.iter().for_each(|&input| edge(input as usize, signals + at));
            }
        }
        graph
    }

    /// For each output bit, the input bits that reach it without passing a start value; nothing after too many steps.
    fn passes_of(&mut self, id: ModuleId) -> Option<Vec<Vec<u32>>> {
        let graph = self.graph(self.module(id), Some(&self.passes));
        let mut seen = vec![0; self.module(id).signals.len()];
        let outputs = self.module(id).output_bits.clone();
        let mut passes = Vec::new();
        for (turn, output) in (1u32..).zip(outputs) {
            let mut inputs = Vec::new();
            let mut open = vec![NodeIndex::new(output as usize)];
            while let Some(at) = open.pop() {
                if std::mem::replace(&mut seen[at.index()], turn) == turn {
                    continue;
                }
                self.take_steps(1)?;
                if let ModuleSignal::Input(input) = self.module(id).signals[at.index()] {
                    inputs.push(input);
                }
                open.extend(graph.neighbors_directed(at, petgraph::Direction::Incoming));
            }
            inputs.sort_unstable();
            passes.push(inputs);
        }
        Some(passes)
    }
}

/// Whether no signal depends on itself, even if each circuit inside passes every input to every output.
fn is_straight(module: &Module) -> bool {
    let signals = module.signals.len();
    let mut is_started = vec![false; signals];
    module.starts.iter().for_each(|&(bit, _)| is_started[bit as usize] = true);
    let (mut begun, mut done) = (vec![false; signals + module.sites.len()], vec![false; signals + module.sites.len()]);
    let mut open: Vec<Bit> = Vec::new();
    for root in 0..signals {
        open.push(root as Bit);
        while let Some(&at) = open.last() {
            let place = at as usize;
            if std::mem::replace(&mut begun[place], true) {
                done[place] = true;
                open.pop();
                continue;
            }
            let waiting = open.len();
            match module.signals.get(place) {
                None => open.extend(&module.sites[place - signals].inputs),
                Some(ModuleSignal::Gate { function, pins, .. }) => open.extend(&pins[..function.arity()]),
                Some(ModuleSignal::Net { driver: Some(driver), .. }) if !is_started[place] => open.push(driver.get()),
                Some(ModuleSignal::Output { site, .. }) => open.push(signals as Bit + site),
                Some(_) => {}
            }
            if open[waiting..].iter().any(|&from| begun[from as usize] && !done[from as usize]) {
                return false;
            }
        }
    }
    true
}

fn loops(graph: &DiGraph<(), ()>) -> Vec<Vec<usize>> {
    let is_loop = |nodes: &Vec<NodeIndex>| nodes.len() > 1 || graph.contains_edge(nodes[0], nodes[0]);
    let numbers = |nodes: Vec<NodeIndex>| {
        let mut numbers: Vec<_> = nodes.into_iter().map(NodeIndex::index).collect();
        numbers.sort_unstable();
        numbers
    };
    let mut loops: Vec<_> = kosaraju_scc(graph).into_iter().filter(is_loop).map(numbers).collect();
    loops.sort_unstable();
    loops
}

fn warning(module: &Module, signals: &[usize]) -> Option<Diagnostic> {
    let mut nets: Vec<u32> = Vec::new();
    for &at in signals {
        if let Some(ModuleSignal::Net { net, .. }) = module.signals.get(at)
            && !nets.contains(net)
            && nets.len() < 4
        {
            nets.push(*net);
        }
    }
    let first = &module.nets[*nets.first()? as usize];
    let nets: Vec<String> = nets.iter().map(|&net| module.nets[net as usize].name.clone()).collect();
    Some(wording::no_start(&nets, first.span))
}
