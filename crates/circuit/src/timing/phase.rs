//! A phase of a netlist: which latches are open while the nets that open and close them have certain values. No path
//! leads through a closed latch.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

use petgraph::Direction::Incoming;
use petgraph::visit::{EdgeRef, NodeIndexable};

use crate::cells::CellKind;
use crate::known::answer;
use crate::netlist::NetGraph;
use crate::timing::update::{NetUpdate, unroll};
use crate::{Latch, NetId, Netlist, Node, Storage};

/// The most nets that open and close latches whose values are all tried.
pub(super) const MOST_ROOTS: usize = 4;
/// The most inputs and memory cells that these nets depend on, for which only consistent values are tried.
const MOST_LEAVES: usize = 10;
const MOST_CELLS: usize = 256;
/// How often latches are looked for that may change while they close.
const MOST_SWEEPS: usize = 16;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passage {
    Open,
    /// The latch closes in this row, and its data may change before it is closed.
    Closing,
    Closed,
}

/// The first change of each net by its number, in cycles; `None` if it does not change.
type FirstChanges = Vec<Option<u32>>;

pub(super) type RootValues = BTreeMap<NetId, bool>;

pub(super) struct Phase {
    /// The net of each node that is a second copy of a guard: the guard with only its enable.
    copies: BTreeMap<NetId, NetId>,
    silent: BTreeSet<NetId>,
    /// The updates of its nets, drivers first.
    pub updates: Vec<NetUpdate>,
    pub loops: Vec<Vec<NetId>>,
}

impl Phase {
    pub fn new(netlist: &Netlist, storage: &Storage, passages: &[Passage]) -> Self {
        let mut graph = Cow::Borrowed(netlist.graph());
        let mut copies = BTreeMap::new();
        let mut silent = BTreeSet::new();
        for (latch, passage) in storage.latches.iter().zip(passages) {
            match passage {
                Passage::Open => continue,
                Passage::Closing => copies.extend(close(graph.to_mut(), latch, true)),
                Passage::Closed => {
                    close(graph.to_mut(), latch, false);
                    silent.extend(&latch.cells);
                }
            }
        }
        let latches = storage.latches.iter();
        let elements = latches.map(|latch| (latch.cells[0], (&latch.cells[..], latch.rounds))).collect();
        let (updates, loops) = unroll(&graph, &elements);
        Self { copies, silent, updates, loops }
    }

    pub fn net(&self, update: &NetUpdate) -> NetId {
        self.copies.get(&update.node).copied().unwrap_or(update.node)
    }

    pub fn is_real(&self, update: &NetUpdate) -> bool {
        !self.copies.contains_key(&update.node)
    }

    pub fn is_silent(&self, update: &NetUpdate) -> bool {
        self.silent.contains(&update.node)
    }
}

/// If the latch is still closing, copies of the guards that only read the enable drive it.
fn close(graph: &mut NetGraph, latch: &Latch, is_closing: bool) -> Vec<(NetId, NetId)> {
    let copy_of: BTreeMap<NetId, NetId> = match is_closing {
        true => latch.guards.iter().map(|&guard| (guard, graph.add_node(graph[guard].clone()))).collect(),
        false => BTreeMap::new(),
    };
    let driver = |net: NetId| if net == latch.enable { Some(net) } else { copy_of.get(&net).copied() };
    for (&guard, &copy) in &copy_of {
        for (net, pin) in drivers(graph, guard) {
            if let Some(driver) = driver(net) {
                graph.add_edge(driver, copy, pin);
            }
        }
    }
    for &cell in &latch.cells {
        for (net, pin) in drivers(graph, cell) {
            if latch.cells.contains(&net) {
                continue;
            }
            let mut edges = graph.edges_directed(cell, Incoming);
            if let Some(old) = edges.find(|edge| *edge.weight() == pin).map(|edge| edge.id()) {
                graph.remove_edge(old);
            }
            if let (true, Some(driver)) = (is_closing, driver(net)) {
                graph.add_edge(driver, cell, pin);
            }
        }
    }
    copy_of.into_iter().map(|(guard, copy)| (copy, guard)).collect()
}

fn drivers(graph: &NetGraph, node: NetId) -> Vec<(NetId, u8)> {
    graph.edges_directed(node, Incoming).map(|edge| (edge.source(), *edge.weight())).collect()
}

/// A latch that an input closes through inverters keeps its state if its data change no earlier than it is closed. All
/// that changes has a cause, so the latches that may change are found by starting with none.
pub(super) fn passages<'k>(
    netlist: &Netlist,
    storage: &Storage,
    values: &RootValues,
    sources: &[NetId],
    kind: &impl Fn(NetId) -> &'k CellKind,
) -> Vec<Passage> {
    let first = |latch: &Latch| match values.get(&latch.root) {
        Some(&value) if value != latch.open => {
            let derived = !matches!(netlist.node(latch.root), Node::Input(_));
            if derived { Passage::Closing } else { Passage::Closed }
        }
        _ => Passage::Open,
    };
    let mut passages: Vec<Passage> = storage.latches.iter().map(first).collect();
    let may_close = |latch: &Latch| sources.contains(&latch.root);
    for sweep in 0..MOST_SWEEPS {
        let mut races = Races { netlist, storage, passages: &passages, sources, kind, firsts: BTreeMap::new() };
        let is_last = sweep + 1 == MOST_SWEEPS;
        let closed = (0..).zip(&storage.latches).filter(|(i, _)| passages[*i] == Passage::Closed);
        let closed = closed.filter(|(_, latch)| may_close(latch) && (is_last || !races.are_won(latch)));
        let closing: Vec<usize> = closed.map(|(i, _)| i).collect();
        if closing.is_empty() {
            break;
        }
        closing.into_iter().for_each(|latch| passages[latch] = Passage::Closing);
    }
    passages
}

struct Races<'a, F> {
    netlist: &'a Netlist,
    storage: &'a Storage,
    passages: &'a [Passage],
    sources: &'a [NetId],
    kind: &'a F,
    /// For each enable, the time by which it closes and the first change of each net: after the root, and after each
    /// inverter on the way from it, as far as the two ways part there.
    firsts: BTreeMap<NetId, Vec<(u32, FirstChanges)>>,
}

impl<'k, F: Fn(NetId) -> &'k CellKind> Races<'_, F> {
    fn are_won(&mut self, latch: &Latch) -> bool {
        let Self { netlist, storage, passages, sources, kind, .. } = *self;
        let firsts = self.firsts.entry(latch.enable).or_insert_with(|| {
            let parting = |at: usize| {
                let rest = &latch.chain[at..];
                let from = if at == 0 { sources } else { &latch.chain[at - 1..at] };
                let closed = rest.iter().map(|&id| kind(id).clock).sum();
                (closed, earliest(netlist, storage, passages, from, rest))
            };
            (0..=latch.chain.len()).map(parting).collect()
        });
        firsts.iter().all(|(closed, first)| latch.needed(netlist, kind, *closed, first).is_none())
    }
}

/// The earliest change of each net after the sources switch, one cycle for each cell, on paths that avoid some nets.
pub(super) fn earliest(
    netlist: &Netlist,
    storage: &Storage,
    passages: &[Passage],
    sources: &[NetId],
    avoided: &[NetId],
) -> FirstChanges {
    let mut silent = vec![false; netlist.graph().node_bound()];
    let closed = storage.latches.iter().zip(passages).filter(|(_, passage)| **passage == Passage::Closed);
    closed.flat_map(|(latch, _)| &latch.cells).chain(avoided).for_each(|cell| silent[cell.index()] = true);
    let mut earliest = vec![None; silent.len()];
    let mut pending: VecDeque<NetId> = sources.iter().copied().collect();
    sources.iter().for_each(|source| earliest[source.index()] = Some(0));
    while let Some(net) = pending.pop_front() {
        let next = earliest[net.index()].map(|cycles: u32| cycles + 1);
        for listener in netlist.graph().neighbors(net) {
            let is_new = earliest[listener.index()].is_none() && !silent[listener.index()];
            if is_new && netlist.cell(listener).is_some() {
                earliest[listener.index()] = next;
                pending.push_back(listener);
            }
        }
    }
    earliest
}

pub(super) fn phases(netlist: &Netlist, roots: &[NetId]) -> Vec<RootValues> {
    let of = |bits: usize| roots.iter().enumerate().map(|(i, &root)| (root, bits >> i & 1 == 1)).collect();
    let all = || (0..1 << roots.len()).map(of).collect();
    let Some((leaves, cells)) = before(netlist, roots) else { return all() };
    let mut found = BTreeSet::new();
    for pattern in 0..1usize << leaves.len() {
        let leaf = |(i, &leaf): (usize, &NetId)| (leaf, Some(pattern >> i & 1 == 1));
        let mut values: BTreeMap<NetId, Option<bool>> = leaves.iter().enumerate().map(leaf).collect();
        for _ in 0..=cells.len() {
            let mut changed = false;
            for &id in cells.iter().rev() {
                let value = response(netlist, &values, id);
                changed |= values.insert(id, value).unwrap_or(None) != value;
            }
            if !changed {
                break;
            }
        }
        let Some(known) = roots.iter().map(|root| Some((*root, values[root]?))).collect::<Option<RootValues>>() else {
            return all();
        };
        found.insert(known);
    }
    found.into_iter().collect()
}

fn before(netlist: &Netlist, roots: &[NetId]) -> Option<(Vec<NetId>, Vec<NetId>)> {
    let mut seen: BTreeSet<NetId> = roots.iter().copied().collect();
    let mut pending: VecDeque<NetId> = seen.iter().copied().collect();
    let (mut leaves, mut cells) = (Vec::new(), Vec::new());
    while let Some(net) = pending.pop_front() {
        match netlist.cell(net) {
            Some(cell) if cell.start.is_none() => {
                cells.push(net);
                pending.extend(netlist.pins(net).into_iter().filter(|&pin| seen.insert(pin)));
            }
            _ if matches!(netlist.node(net), Node::Constant(_)) => cells.push(net),
            _ => leaves.push(net),
        }
    }
    (leaves.len() <= MOST_LEAVES && cells.len() <= MOST_CELLS).then_some((leaves, cells))
}

fn response(netlist: &Netlist, values: &BTreeMap<NetId, Option<bool>>, id: NetId) -> Option<bool> {
    let value = |pin: NetId| values.get(&pin).copied().flatten();
    match netlist.node(id) {
        Node::Cell(cell) => {
            let bits: Vec<Option<bool>> = netlist.operands(id).into_iter().map(value).collect();
            answer(cell.function, &bits)
        }
        Node::Constant(bit) => Some(*bit),
        _ => None,
    }
}
