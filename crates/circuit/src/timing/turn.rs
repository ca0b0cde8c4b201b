//! The order in which changes pass the nets of a netlist: loops are passed more than once.

use std::collections::{BTreeMap, BTreeSet};

use petgraph::Direction::Incoming;
use petgraph::visit::EdgeRef;

use crate::NetId;
use crate::components::Components;
use crate::netlist::NetGraph;

/// A net's turn. A net on a loop has several.
#[derive(Clone, Debug)]
pub(super) struct Turn {
    /// The node of the graph.
    pub node: NetId,
    /// The pins that an earlier turn drives, with the number of that turn.
    pub pins: Vec<(u8, usize)>,
}

/// The turns of a graph in an order with pins first, and the loops that are not one of `elements`.
///
/// The cells of an element, given with the number of cells that a change passes in it, all take their turns at once,
/// that many times. Those of another loop are passed one after the other, twice: once by the change and once by the
/// response to it.
pub(super) fn unroll(graph: &NetGraph, elements: &BTreeMap<NetId, (&[NetId], usize)>) -> (Vec<Turn>, Vec<Vec<NetId>>) {
    let mut way = Way { graph, turns: Vec::new(), last: BTreeMap::new() };
    let mut components = Components::new(graph).from(graph.node_indices(), |_| true);
    components.reverse();
    let mut others = Vec::new();
    for mut core in components {
        core.sort_unstable();
        match elements.get(&core[0]) {
            Some((cells, rounds)) if *cells == core => (0..*rounds).for_each(|_| way.take_together(&core)),
            _ if core.len() > 1 || graph.contains_edge(core[0], core[0]) => {
                let order = along(graph, &core);
                order.iter().chain(&order).for_each(|&member| way.take_together(&[member]));
                others.push(core);
            }
            _ => way.take_together(&core),
        }
    }
    (way.turns, others)
}

struct Way<'g> {
    graph: &'g NetGraph,
    turns: Vec<Turn>,
    /// The last turn of each node.
    last: BTreeMap<NetId, usize>,
}

impl Way<'_> {
    /// A turn for each of these nodes; they read the turns before.
    fn take_together(&mut self, nodes: &[NetId]) {
        let first = self.turns.len();
        for &node in nodes {
            let pins = pins(self.graph, node).into_iter();
            let pins = pins.filter_map(|(pin, driver)| Some((pin, *self.last.get(&driver)?))).collect();
            self.turns.push(Turn { node, pins });
        }
        self.last.extend(nodes.iter().copied().zip(first..));
    }
}

/// The pins of a node with their drivers, pin 0 first.
pub(super) fn pins(graph: &NetGraph, node: NetId) -> Vec<(u8, NetId)> {
    let mut pins: Vec<_> = graph.edges_directed(node, Incoming).map(|edge| (*edge.weight(), edge.source())).collect();
    pins.sort_unstable();
    pins
}

/// A loop core in depth-first order from the cells that listen to something outside.
fn along(graph: &NetGraph, core: &[NetId]) -> Vec<NetId> {
    let is_inside = |node: &NetId| core.binary_search(node).is_ok();
    let entered = |&&node: &&NetId| pins(graph, node).iter().any(|(_, pin)| !is_inside(pin));
    let mut seen = BTreeSet::new();
    let mut finished = Vec::with_capacity(core.len());
    for &root in core.iter().filter(entered).chain(core) {
        let mut stack = vec![(root, false)];
        while let Some((node, leaving)) = stack.pop() {
            if leaving {
                finished.push(node);
            } else if seen.insert(node) {
                stack.push((node, true));
                let mut listeners: Vec<_> = graph.edges(node).map(|edge| (edge.target(), *edge.weight())).collect();
                listeners.sort_unstable();
                stack.extend(listeners.into_iter().filter(|(id, _)| is_inside(id)).map(|(id, _)| (id, false)));
            }
        }
    }
    finished.reverse();
    finished
}
