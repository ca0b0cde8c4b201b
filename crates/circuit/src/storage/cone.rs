//! The cells around a memory element, and their values where few of them are known.

use std::collections::{BTreeMap, BTreeSet};

use crate::known::{TernaryBit, answer};
use crate::{Cell, NetId, Netlist, Node};

/// The most cells between a memory element and the net that closes it.
const DEPTH: usize = 6;
const MOST_CELLS: usize = 64;

/// Values of nets; a net that is missing is unknown.
pub(super) type Values = BTreeMap<NetId, TernaryBit>;

#[derive(Clone, Debug)]
pub struct Inverters {
    driver: BTreeMap<NetId, (NetId, bool)>,
}

impl Inverters {
    pub fn of(netlist: &Netlist) -> Self {
        let driver = netlist.cells().filter_map(|(id, cell)| Some((id, only_pin(netlist, id, cell)?))).collect();
        Self { driver }
    }

    /// The net behind all inverters and buffers of a net, and whether it has the opposite value.
    pub fn root(&self, net: NetId) -> (NetId, bool) {
        self.steps(net).last().expect("a net leads to itself")
    }

    pub fn steps(&self, net: NetId) -> impl Iterator<Item = (NetId, bool)> + '_ {
        let mut seen = BTreeSet::from([net]);
        std::iter::successors(Some((net, false)), move |&(at, inverted)| {
            let &(next, inverts) = self.driver.get(&at)?;
            seen.insert(next).then_some((next, inverted != inverts))
        })
    }
}

/// The one net that a cell depends on, and whether the cell inverts it; memory is never a buffer.
fn only_pin(netlist: &Netlist, id: NetId, cell: &Cell) -> Option<(NetId, bool)> {
    if cell.start.is_some() {
        return None;
    }
    let ends = netlist.operands(id);
    let free = ends.iter().copied().find(|&pin| constant(netlist, pin).is_none())?;
    if ends.iter().any(|&pin| pin != free && constant(netlist, pin).is_none()) {
        return None;
    }
    let output = |value: bool| cell.function.at(ends.iter().map(|&pin| constant(netlist, pin).unwrap_or(value)));
    (output(false) != output(true)).then(|| (free, output(false)))
}

pub(super) fn constant(netlist: &Netlist, net: NetId) -> TernaryBit {
    match netlist.node(net) {
        Node::Constant(value) => Some(*value),
        _ => None,
    }
}

pub(super) struct Cone<'a> {
    netlist: &'a Netlist,
    pub element: &'a [NetId],
    pub entering: Vec<NetId>,
    cells: Vec<NetId>,
    /// The nets before the element by their distance from it.
    near: Vec<NetId>,
}

impl<'a> Cone<'a> {
    pub fn new(netlist: &'a Netlist, element: &'a [NetId]) -> Self {
        let mut entering: Vec<NetId> = element.iter().flat_map(|&id| netlist.pins(id)).collect();
        entering.sort_unstable();
        entering.dedup();
        entering.retain(|pin| !element.contains(pin));
        let mut cone = Self { netlist, element, entering, cells: Vec::new(), near: Vec::new() };
        cone.look_back();
        cone
    }

    fn look_back(&mut self) {
        let mut seen: BTreeSet<NetId> = self.entering.iter().copied().collect();
        let mut level: Vec<NetId> = self.entering.clone();
        for _ in 0..=DEPTH {
            let mut next = BTreeSet::new();
            for &net in &level {
                self.near.push(net);
                let is_logic = self.netlist.cell(net).is_some_and(|cell| cell.start.is_none());
                if is_logic && self.cells.len() < MOST_CELLS {
                    self.cells.push(net);
                    next.extend(self.netlist.pins(net).into_iter().filter(|&pin| seen.insert(pin)));
                }
            }
            level = next.into_iter().collect();
        }
        self.near.retain(|net| !self.element.contains(net));
        self.cells.retain(|net| !self.element.contains(net));
    }

    pub fn near(&self) -> impl Iterator<Item = NetId> + '_ {
        let changes = |net: &&NetId| !matches!(self.netlist.node(**net), Node::Constant(_));
        self.near.iter().filter(changes).copied()
    }

    pub fn guards(&self, net: NetId) -> Vec<NetId> {
        let mut guards: BTreeSet<NetId> = BTreeSet::new();
        let mut grows = true;
        while grows {
            let depends = |id: &&NetId| self.netlist.pins(**id).iter().any(|pin| *pin == net || guards.contains(pin));
            let more: Vec<NetId> =
                self.cells.iter().filter(|id| !guards.contains(id)).filter(depends).copied().collect();
            grows = !more.is_empty();
            guards.extend(more);
        }
        guards.remove(&net);
        guards.into_iter().collect()
    }

    pub fn implied(&self, known: &Values) -> Values {
        let mut values = known.clone();
        let free: Vec<NetId> = self.cells.iter().copied().filter(|id| !known.contains_key(id)).collect();
        let mut changed = true;
        while changed {
            changed = false;
            for &id in free.iter().rev() {
                let value = self.answer(&values, id);
                changed |= values.insert(id, value).unwrap_or(None) != value;
            }
        }
        values
    }

    /// The values, and the cells that a change passes in the element; `None` if its state is not determined.
    pub fn stored(&self, known: &Values) -> Option<(Values, usize)> {
        let mut values = self.implied(known);
        for rounds in 1..=self.element.len() {
            let next: Vec<TernaryBit> = self.element.iter().map(|&id| self.answer(&values, id)).collect();
            let is_known = next.iter().all(Option::is_some);
            values.extend(self.element.iter().copied().zip(next));
            if is_known {
                return Some((values, rounds));
            }
        }
        None
    }

    pub fn answer(&self, values: &Values, id: NetId) -> TernaryBit {
        let cell = self.netlist.cell(id).expect("elements and guards are cells");
        let bits: Vec<TernaryBit> = self.netlist.operands(id).iter().map(|&pin| self.value(values, pin)).collect();
        answer(cell.function, &bits)
    }

    pub fn value(&self, values: &Values, net: NetId) -> TernaryBit {
        values.get(&net).copied().unwrap_or_else(|| constant(self.netlist, net))
    }
}
