//! Loops without a start value: found by looking at a module with all bits cut that have one.

use crate::elaborate::build::Builder;
use crate::elaborate::module::{Module, ModuleId, ModuleSignal};
use crate::elaborate::wording::ElaborateError;
use nbc_base::diag::Diagnostic;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

impl Builder<'_> {
    /// Warns of loops without a start value in a module and the circuits it contains.
    pub(super) fn look_for_loops(&mut self, top: ModuleId) {
        let mut open = vec![top];
        while let Some(id) = open.pop() {
            if std::mem::replace(&mut self.inspected[id.0 as usize], true) {
                continue;
            }
            open.extend(self.module(id).sites.iter().map(|site| site.module));
            for fault in self.loops_of(id) {
                self.fault(fault);
            }
        }
    }

    fn loops_of(&self, id: ModuleId) -> Vec<Diagnostic> {
        let module = self.module(id);
        let coarse = loops(&self.graph(module, false));
        if coarse.is_empty() {
            return Vec::new();
        }
        // At first, a circuit inside was assumed to pass every input to every output; now check its real dependencies.
        let has_sites = coarse
            .iter()
            .flatten()
            .any(|&at| at >= module.signals.len() || matches!(module.signals[at], ModuleSignal::Output { .. }));
        let exact = if has_sites { loops(&self.graph(module, true)) } else { coarse };
        exact.iter().filter_map(|signals| warning(module, signals)).collect()
    }

    /// The dependencies in a module; each circuit inside is a node after the signals, unless `exact`.
    fn graph(&self, module: &Module, exact: bool) -> DiGraph<(), ()> {
        let signals = module.signals.len();
        let mut graph = DiGraph::with_capacity(signals + module.sites.len(), 2 * signals);
        for _ in 0..signals + module.sites.len() {
            graph.add_node(());
        }
        let mut edge = |from: usize, to: usize| _ = graph.add_edge(NodeIndex::new(from), NodeIndex::new(to), ());
        let passes: Vec<_> =
            if exact { module.sites.iter().map(|site| self.passes(site.module)).collect() } else { Vec::new() };
        let started = started(module);
        for (at, signal) in module.signals.iter().enumerate() {
            match *signal {
                ModuleSignal::Gate { function, pins, .. } => {
                    pins[..function.arity()].iter().for_each(|&pin| edge(pin as usize, at))
                }
                ModuleSignal::Net { driver: Some(driver), .. } if !started[at] => edge(driver.get() as usize, at),
                ModuleSignal::Output { site, bit } if exact => {
                    let inputs = &module.sites[site as usize].inputs;
                    passes[site as usize][bit as usize]
                        .iter()
                        .for_each(|&input| edge(inputs[input as usize] as usize, at));
                }
                ModuleSignal::Output { site, .. } => edge(signals + site as usize, at),
                _ => {}
            }
        }
        if !exact {
            for (at, site) in module.sites.iter().enumerate() {
                site.inputs.iter().for_each(|&input| edge(input as usize, signals + at));
            }
        }
        graph
    }

    /// For each output bit of a module, the input bits that reach it without passing a bit with a start value.
    fn passes(&self, id: ModuleId) -> Vec<Vec<u32>> {
        let module = self.module(id);
        let graph = self.graph(module, true);
        let reach = |&output: &u32| {
            let mut inputs = Vec::new();
            let mut seen = vec![false; module.signals.len()];
            let mut open = vec![NodeIndex::new(output as usize)];
            while let Some(at) = open.pop() {
                if std::mem::replace(&mut seen[at.index()], true) {
                    continue;
                }
                if let ModuleSignal::Input(input) = module.signals[at.index()] {
                    inputs.push(input);
                }
                open.extend(graph.neighbors_directed(at, petgraph::Direction::Incoming));
            }
            inputs.sort_unstable();
            inputs
        };
        module.output_bits.iter().map(reach).collect()
    }
}

fn started(module: &Module) -> Vec<bool> {
    let mut started = vec![false; module.signals.len()];
    for &(bit, _) in &module.starts {
        started[bit as usize] = true;
    }
    started
}

/// The loops of a graph, each as its nodes in order of numbers.
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
    let nets = nets.iter().map(|&net| module.nets[net as usize].name.clone()).collect();
    Some(ElaborateError::NoStart { nets }.at(first.span))
}
