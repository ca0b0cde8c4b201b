//! The order in which changes pass the nets of a netlist: loops are passed more than once.

use std::collections::{BTreeMap, BTreeSet};

use petgraph::Direction::Incoming;
use petgraph::visit::EdgeRef;

use crate::NetId;
use crate::components::Components;
use crate::netlist::NetGraph;

#[derive(Clone, Debug)]
pub(super) struct NetUpdate {
    pub node: NetId,
    /// The earlier updates that drive its pins.
    pub drivers: Vec<usize>,
}

/// The updates of a graph in an order with pins first, and the loops that are not one of `elements`.
///
/// The cells of an element are updated at once, as often as the number given with it; those of another loop one after
/// the other, twice: once for the change and once for the response to it.
pub(super) fn unroll(
    graph: &NetGraph,
    elements: &BTreeMap<NetId, (&[NetId], usize)>,
) -> (Vec<NetUpdate>, Vec<Vec<NetId>>) {
    let mut updates = UpdateOrder { graph, list: Vec::new(), last: BTreeMap::new() };
    let mut components = Components::new(graph).from(graph.node_indices(), |_| true);
    components.reverse();
    let mut others = Vec::new();
    for mut core in components {
        core.sort_unstable();
        match elements.get(&core[0]) {
            Some((cells, rounds)) if *cells == core => (0..*rounds).for_each(|_| updates.update_together(&core)),
            _ if core.len() > 1 || graph.contains_edge(core[0], core[0]) => {
                let order = along(graph, &core);
                order.iter().chain(&order).for_each(|&member| updates.update_together(&[member]));
                others.push(core);
            }
            _ => updates.update_together(&core),
        }
    }
    (updates.list, others)
}

struct UpdateOrder<'g> {
    graph: &'g NetGraph,
    list: Vec<NetUpdate>,
    last: BTreeMap<NetId, usize>,
}

impl UpdateOrder<'_> {
    fn update_together(&mut self, nodes: &[NetId]) {
        let first = self.list.len();
        for &node in nodes {
            let drivers = pins(self.graph, node).into_iter();
            let drivers = drivers.filter_map(|(_, driver)| self.last.get(&driver).copied()).collect();
            self.list.push(NetUpdate { node, drivers });
        }
        self.last.extend(nodes.iter().copied().zip(first..));
    }
}

pub(super) fn pins(graph: &NetGraph, node: NetId) -> Vec<(u8, NetId)> {
    let mut pins: Vec<_> = graph.edges_directed(node, Incoming).map(|edge| (*edge.weight(), edge.source())).collect();
    pins.sort_unstable();
    pins
}

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
