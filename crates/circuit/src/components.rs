//! Strongly connected components, found without recursion: a chain of cells may be as long as the netlist is large
//! (Tarjan, Depth-first search and linear graph algorithms).
//!
//! petgraph's `tarjan_scc` recurses, so a chain of a million cells would overflow the stack. Its `kosaraju_scc` takes
//! no start nodes and no filter, and results depend on the order in which components are found.

use petgraph::Direction::Outgoing;
use petgraph::visit::NodeIndexable;

use crate::NetId;
use crate::netlist::NetGraph;

const NEW: u32 = 0;

pub struct Components<'g> {
    graph: &'g NetGraph,
    /// When each node was visited, or [`NEW`].
    numbers: Vec<u32>,
    done: Vec<bool>,
    /// For each visited node, the earliest node that it leads back to.
    low: Vec<u32>,
    clock: u32,
    open: Vec<NetId>,
}

impl<'g> Components<'g> {
    pub fn new(graph: &'g NetGraph) -> Self {
        let nodes = graph.node_bound();
        Self {
            graph,
            numbers: vec![NEW; nodes],
            done: vec![false; nodes],
            low: vec![NEW; nodes],
            clock: NEW,
            open: Vec::new(),
        }
    }

    /// The components that `roots` lead to by way of nodes that are `inside`, listeners before their drivers.
    pub fn from(&mut self, roots: impl IntoIterator<Item = NetId>, inside: impl Fn(NetId) -> bool) -> Vec<Vec<NetId>> {
        let mut components = Vec::new();
        for root in roots {
            if inside(root) && self.numbers[root.index()] == NEW {
                self.follow(root, &inside, &mut components);
            }
        }
        components
    }

    fn follow(&mut self, root: NetId, inside: &impl Fn(NetId) -> bool, components: &mut Vec<Vec<NetId>>) {
        let graph = self.graph;
        let listeners = |node: NetId| graph.neighbors_directed(node, Outgoing).detach();
        self.discover(root);
        let mut way = vec![(root, listeners(root))];
        while let Some((node, ahead)) = way.last_mut() {
            let node = *node;
            match ahead.next_node(graph) {
                Some(next) if !inside(next) || self.done[next.index()] => {}
                Some(next) if self.numbers[next.index()] == NEW => {
                    self.discover(next);
                    way.push((next, listeners(next)));
                }
                Some(next) => self.low[node.index()] = self.low[node.index()].min(self.numbers[next.index()]),
                None => {
                    way.pop();
                    if let Some(&(before, _)) = way.last() {
                        self.low[before.index()] = self.low[before.index()].min(self.low[node.index()]);
                    }
                    components.extend(self.close(node));
                }
            }
        }
    }

    fn discover(&mut self, node: NetId) {
        self.clock += 1;
        self.numbers[node.index()] = self.clock;
        self.low[node.index()] = self.clock;
        self.open.push(node);
    }

    fn close(&mut self, node: NetId) -> Option<Vec<NetId>> {
        if self.low[node.index()] != self.numbers[node.index()] {
            return None;
        }
        let first = self.open.iter().rposition(|&open| open == node).expect("a node is open until it is closed");
        let component = self.open.split_off(first);
        component.iter().for_each(|member| self.done[member.index()] = true);
        Some(component)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Netlist;
    use nbc_base::model::Function;

    fn all(netlist: &Netlist) -> Vec<Vec<NetId>> {
        Components::new(netlist.graph()).from(netlist.ids(), |_| true)
    }

    #[test]
    fn loops_are_components_and_receivers_come_first() {
        let mut netlist = Netlist::new("ring");
        let a = netlist.add_input("a");
        let one = netlist.add_gate(Function::NAND, &[a, a]);
        let two = netlist.add_gate(Function::NOT, &[one]);
        netlist.drive(one, 1, two);
        let output = netlist.add_output("q", two);
        assert_eq!(all(&netlist), [vec![output], vec![one, two], vec![a]]);
        let open = Components::new(netlist.graph()).from(netlist.ids(), |id| id != two);
        assert_eq!(open, [vec![one], vec![a], vec![output]]);
    }

    #[test]
    fn a_long_chain_does_not_overflow_the_stack() {
        let mut netlist = Netlist::new("chain");
        let mut net = netlist.add_input("a");
        for _ in 0..200_000 {
            net = netlist.add_gate(Function::NOT, &[net]);
        }
        netlist.add_output("q", net);
        assert_eq!(all(&netlist).len(), 200_002);
    }
}
