//! The netlist: a directed graph of ports, constants and cells, feedback included. A net is known by the node that
//! drives it.

use std::collections::BTreeMap;
use std::fmt;

use petgraph::Direction::Incoming;
use petgraph::stable_graph::{NodeIndex, StableDiGraph};
use petgraph::visit::EdgeRef;

use crate::blocks::{BlockId, Blocks};
use crate::register::RegisterNode;
use nbc_base::model::Function;
use nbc_base::source::Span;

/// A net, named by its driver.
pub type NetId = NodeIndex;

#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Its function of its pins, pin 0 first; a function of one input reads pin 0 only, and has no pin 1.
    pub function: Function,
    pub name: Option<String>,
    /// The output before the first cycle; only cells on a feedback loop need one.
    pub start: Option<bool>,
    pub span: Option<Span>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    Input(String),
    /// An output port; its one pin is the net it shows.
    Output(String),
    Constant(bool),
    /// A name for a net that is driven elsewhere, perhaps later: this makes feedback possible. Its one pin is the
    /// driver.
    Wire {
        name: String,
        start: Option<bool>,
        span: Option<Span>,
    },
    Cell(Cell),
    Register(RegisterNode),
}

/// A latch that a register has become which nothing forces, or one of the two of an edge, in order.
#[derive(Clone, Debug)]
pub(crate) struct LoweredLatch {
    /// The cell that shows its bit, and the others of its loop, among which may be some beside it.
    pub cells: Vec<NetId>,
    pub enable: NetId,
    /// The value of `enable` for which it is open.
    pub open: bool,
    /// Whether it is the second one of an edge.
    pub is_second: bool,
}

pub(crate) type NetGraph = StableDiGraph<Node, u8, u32>;

/// A circuit as a graph: an edge runs from a driver to the pin (0, 1 or 2) that listens.
#[derive(Clone, Debug, Default)]
pub struct Netlist {
    pub name: String,
    graph: NetGraph,
    inputs: Vec<NetId>,
    outputs: Vec<NetId>,
    blocks: Blocks,
    /// What its registers have become, once they are robots.
    pub(crate) latches: Vec<LoweredLatch>,
}

impl Netlist {
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), ..Self::default() }
    }

    pub(crate) fn with_blocks_of(other: &Self) -> Self {
        Self { blocks: other.blocks.without_nodes(), ..Self::new(&other.name) }
    }

    /// Adds a node that is in no block. It may take the place of one that was removed.
    fn add(&mut self, node: Node) -> NetId {
        let id = self.graph.add_node(node);
        self.blocks.put(id.index(), BlockId::TOP);
        id
    }

    pub fn blocks(&self) -> &Blocks {
        &self.blocks
    }

    pub fn blocks_mut(&mut self) -> &mut Blocks {
        &mut self.blocks
    }

    pub fn block(&self, id: NetId) -> BlockId {
        self.blocks.of(id.index())
    }

    pub fn put_into(&mut self, id: NetId, block: BlockId) {
        self.blocks.put(id.index(), block);
    }

    pub fn add_input(&mut self, name: impl Into<String>) -> NetId {
        let id = self.add(Node::Input(name.into()));
        self.inputs.push(id);
        id
    }

    pub fn add_output(&mut self, name: impl Into<String>, net: NetId) -> NetId {
        let id = self.add_loose_output(name);
        self.connect(id, 0, net);
        id
    }

    pub fn add_loose_output(&mut self, name: impl Into<String>) -> NetId {
        let id = self.add(Node::Output(name.into()));
        self.outputs.push(id);
        id
    }

    pub fn add_constant(&mut self, value: bool) -> NetId {
        self.add(Node::Constant(value))
    }

    pub fn add_wire(&mut self, name: impl Into<String>, start: Option<bool>, span: Option<Span>) -> NetId {
        self.add(Node::Wire { name: name.into(), start, span })
    }

    /// Adds a cell whose pins 0, 1, … listen to `pins`.
    pub fn add_cell(&mut self, cell: Cell, pins: &[NetId]) -> NetId {
        assert!(matches!(pins.len(), 1..=3), "a cell has one pin, two or three");
        let id = self.add(Node::Cell(cell));
        for (pin, &net) in pins.iter().enumerate() {
            self.graph.add_edge(net, id, pin as u8);
        }
        id
    }

    pub fn add_loose_cell(&mut self, cell: Cell) -> NetId {
        self.add(Node::Cell(cell))
    }

    pub fn add_register(&mut self, register: RegisterNode, pins: &[NetId]) -> NetId {
        assert_eq!(pins.len(), register.pins(), "a register has data, a clock, and what forces it");
        let id = self.add_loose_register(register);
        (0..).zip(pins).for_each(|(pin, &net)| self.connect(id, pin, net));
        id
    }

    pub fn add_loose_register(&mut self, register: RegisterNode) -> NetId {
        self.add(Node::Register(register))
    }

    pub fn connect(&mut self, listener: NetId, pin: u8, net: NetId) {
        self.graph.add_edge(net, listener, pin);
    }

    pub fn add_gate(&mut self, function: Function, pins: &[NetId]) -> NetId {
        self.add_cell(Cell { function, name: None, start: None, span: None }, pins)
    }

    /// Connects pin `pin` of `listener` to `net` only.
    pub fn drive(&mut self, listener: NetId, pin: u8, net: NetId) {
        let old =
            self.graph.edges_directed(listener, Incoming).find(|edge| *edge.weight() == pin).map(|edge| edge.id());
        if let Some(old) = old {
            self.graph.remove_edge(old);
        }
        self.graph.add_edge(net, listener, pin);
    }

    /// Connects all pins that listen to one net to another.
    pub(crate) fn move_listeners(&mut self, from: NetId, to: NetId) {
        for (listener, pin) in self.fanout(from) {
            self.drive(listener, pin, to);
        }
    }

    pub fn remove(&mut self, id: NetId) {
        self.graph.remove_node(id);
        self.inputs.retain(|&input| input != id);
        self.outputs.retain(|&output| output != id);
    }

    pub fn node(&self, id: NetId) -> &Node {
        &self.graph[id]
    }

    pub fn rename(&mut self, id: NetId, new: &str) {
        match self.node_mut(id) {
            Node::Input(name) | Node::Output(name) | Node::Wire { name, .. } => *name = new.to_owned(),
            Node::Cell(Cell { name, .. }) | Node::Register(RegisterNode { name, .. }) => *name = Some(new.to_owned()),
            Node::Constant(_) => {}
        }
    }

    pub(crate) fn node_mut(&mut self, id: NetId) -> &mut Node {
        &mut self.graph[id]
    }

    pub fn cell(&self, id: NetId) -> Option<&Cell> {
        match self.node(id) {
            Node::Cell(cell) => Some(cell),
            _ => None,
        }
    }

    pub(crate) fn cell_mut(&mut self, id: NetId) -> Option<&mut Cell> {
        match self.node_mut(id) {
            Node::Cell(cell) => Some(cell),
            _ => None,
        }
    }

    pub fn register(&self, id: NetId) -> Option<&RegisterNode> {
        match self.node(id) {
            Node::Register(register) => Some(register),
            _ => None,
        }
    }

    /// The registers, in order of numbers.
    pub fn registers(&self) -> impl Iterator<Item = (NetId, &RegisterNode)> {
        self.ids().filter_map(|id| Some((id, self.register(id)?)))
    }

    /// Makes a register another node, which keeps its listeners and has no pins.
    pub(crate) fn replace_register(&mut self, id: NetId, node: Node) {
        let pins: Vec<_> = self.graph.edges_directed(id, Incoming).map(|edge| edge.id()).collect();
        pins.into_iter().for_each(|pin| _ = self.graph.remove_edge(pin));
        self.inputs.extend(Some(id).filter(|_| matches!(node, Node::Input(_))));
        self.graph[id] = node;
    }

    /// Makes an input another node, which keeps its listeners.
    pub(crate) fn replace_input(&mut self, id: NetId, node: Node) {
        self.inputs.retain(|&input| input != id);
        self.graph[id] = node;
    }

    /// The drivers of a node's pins, pin 0 first.
    pub fn pins(&self, id: NetId) -> Vec<NetId> {
        let mut pins: Vec<_> =
            self.graph.edges_directed(id, Incoming).map(|edge| (*edge.weight(), edge.source())).collect();
        pins.sort_unstable();
        pins.into_iter().map(|(_, net)| net).collect()
    }

    /// The net of each input of a cell's function. A cell of one pin has it at both.
    pub fn operands(&self, id: NetId) -> Vec<NetId> {
        let inputs = self.cell(id).expect("only cells have operands").function.inputs();
        let pins = self.pins(id);
        (0..inputs).map(|input| pins[input.min(pins.len() - 1)]).collect()
    }

    /// The listeners of a net with their pins, in order of their numbers.
    pub fn fanout(&self, id: NetId) -> Vec<(NetId, u8)> {
        let mut listeners: Vec<_> = self.graph.edges(id).map(|edge| (edge.target(), *edge.weight())).collect();
        listeners.sort_unstable();
        listeners
    }

    pub fn inputs(&self) -> &[NetId] {
        &self.inputs
    }

    pub fn outputs(&self) -> &[NetId] {
        &self.outputs
    }

    pub fn ids(&self) -> impl Iterator<Item = NetId> + '_ {
        self.graph.node_indices()
    }

    /// The cells, in order of numbers.
    pub fn cells(&self) -> impl Iterator<Item = (NetId, &Cell)> {
        self.ids().filter_map(|id| Some((id, self.cell(id)?)))
    }

    /// The cells, as many as there are once registers are cells, too.
    pub fn size(&self) -> usize {
        self.cells().count() + RegisterNode::CELLS * self.registers().count()
    }

    pub fn by_function(&self) -> BTreeMap<&'static str, usize> {
        let mut counts = BTreeMap::new();
        for (_, cell) in self.cells() {
            *counts.entry(cell.function.name()).or_insert(0) += 1;
        }
        counts
    }

    pub fn graph(&self) -> &NetGraph {
        &self.graph
    }

    /// The displayed name of a net: that of the port, wire or cell, else `n` and its number.
    pub fn net_name(&self, id: NetId) -> String {
        match self.node(id) {
            Node::Input(name) | Node::Output(name) | Node::Wire { name, .. } => name.clone(),
            Node::Constant(value) => u8::from(*value).to_string(),
            Node::Cell(Cell { name: Some(name), .. }) | Node::Register(RegisterNode { name: Some(name), .. }) => {
                name.clone()
            }
            Node::Cell(_) | Node::Register(_) => format!("n{}", id.index()),
        }
    }

    pub fn net_names(&self, nets: &[NetId]) -> Vec<String> {
        nets.iter().map(|&net| self.net_name(net)).collect()
    }

    pub fn is_named(&self, id: NetId) -> bool {
        !matches!(self.node(id), Node::Cell(Cell { name: None, .. }) | Node::Register(RegisterNode { name: None, .. }))
    }

    /// What readers call a net: its name, else what drives it, such as `nand(d, not(e))`.
    pub fn net_label(&self, id: NetId) -> String {
        self.label_within(id, 2)
    }

    fn label_within(&self, id: NetId, depth: usize) -> String {
        match self.cell(id) {
            Some(cell) if !self.is_named(id) => {
                let pins = self.pins(id).into_iter();
                let pins: Vec<String> = match depth {
                    0 => vec!["…".to_owned()],
                    _ => pins.map(|pin| self.label_within(pin, depth - 1)).collect(),
                };
                format!("{}({})", cell.function, pins.join(", "))
            }
            _ => self.net_name(id),
        }
    }
}

impl fmt::Display for Netlist {
    /// The netlist as text: ports, then a line for each cell and wire in order of numbers, and for each output that
    /// has another name than the net that drives it. An output is no cell, so its line has no operator.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = |ids: &[NetId]| ids.iter().map(|&id| self.net_name(id)).collect::<Vec<_>>().join(", ");
        writeln!(f, "netlist {}({}) -> ({}) {{", self.name, names(&self.inputs), names(&self.outputs))?;
        for id in self.ids() {
            let (operator, start) = match self.node(id) {
                Node::Input(_) | Node::Constant(_) => continue,
                Node::Output(_) => {
                    let (name, driver) = (self.net_name(id), names(&self.pins(id)));
                    if name != driver {
                        writeln!(f, "    {name} = {driver}")?;
                    }
                    continue;
                }
                Node::Wire { start, .. } => ("wire".to_owned(), *start),
                Node::Cell(cell) => (cell.function.to_string(), cell.start),
                Node::Register(register) => (register.kind.word().to_owned(), register.start),
            };
            let start = start.map_or(String::new(), |start| format!(" init {}", u8::from(start)));
            writeln!(f, "    {} = {operator}({}){start}", self.net_name(id), names(&self.pins(id)))?;
        }
        writeln!(f, "}}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_netlist_prints_as_text() {
        let mut netlist = Netlist::new("half");
        let a = netlist.add_input("a");
        let b = netlist.add_input("b");
        let sum = netlist.add_gate(Function::XOR, &[a, b]);
        netlist.add_output("s", sum);
        assert_eq!(netlist.to_string(), "netlist half(a, b) -> (s) {\n    n2 = xor(a, b)\n    s = n2\n}\n");
    }

    #[test]
    fn a_net_without_a_name_is_called_what_drives_it() {
        let mut netlist = Netlist::new("label");
        let a = netlist.add_input("a");
        let first = netlist.add_gate(Function::NOT, &[a]);
        let second = netlist.add_gate(Function::NAND, &[first, a]);
        let third = netlist.add_gate(Function::NOT, &[second]);
        assert!(netlist.is_named(a) && !netlist.is_named(third));
        assert_eq!([a, first, third].map(|net| netlist.net_label(net)), ["a", "not(a)", "not(nand(not(…), a))"]);
        netlist.rename(second, "inner");
        assert_eq!(netlist.net_label(third), "not(inner)");
    }

    #[test]
    fn driving_a_pin_again_replaces_its_driver() {
        let mut netlist = Netlist::new("loop");
        let a = netlist.add_input("a");
        let wire = netlist.add_wire("q", Some(false), None);
        let gate = netlist.add_gate(Function::NAND, &[a, wire]);
        netlist.drive(wire, 0, a);
        netlist.drive(wire, 0, gate);
        assert_eq!(netlist.pins(wire), [gate]);
        assert_eq!(netlist.fanout(a), [(gate, 0)]);
    }
}
