//! Positions of a netlist's nodes in a layered drawing: inputs left, outputs right, feedback running back.

use std::collections::{BTreeMap, BTreeSet};

use nbc_circuit::{Loops, NetId, Netlist, Node};

const SWEEPS: usize = 8;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slot {
    Node(NetId),
    /// A net that passes through to later layers.
    Pass(NetId),
}

#[derive(Clone, Debug, Default)]
pub struct Layers {
    pub layers: Vec<Vec<Slot>>,
    layer_of: BTreeMap<NetId, usize>,
}

impl Layers {
    /// Wires are placed like cells.
    pub fn of(netlist: &Netlist) -> Self {
        let layer_of = assign(netlist);
        let count = layer_of.values().max().map_or(0, |last| last + 1);
        let mut layers = Self { layers: vec![Vec::new(); count], layer_of };
        for id in netlist.ids() {
            let from = layers.layer_of(id);
            layers.layers[from].push(Slot::Node(id));
            let listeners = netlist.fanout(id).into_iter().map(|(listener, _)| layers.layer_of(listener));
            let to = listeners.max().unwrap_or(0);
            for between in from + 1..to {
                layers.layers[between].push(Slot::Pass(id));
            }
        }
        for sweep in 0..SWEEPS {
            layers.sweep(netlist, sweep % 2 == 0);
        }
        layers
    }

    pub fn layer_of(&self, id: NetId) -> usize {
        self.layer_of[&id]
    }

    pub fn is_feedback(&self, driver: NetId, listener: NetId) -> bool {
        self.layer_of(listener) <= self.layer_of(driver)
    }

    pub fn carrier(&self, net: NetId, layer: usize) -> Slot {
        if self.layer_of(net) == layer { Slot::Node(net) } else { Slot::Pass(net) }
    }

    /// Orders each layer by the mean height of its slots' neighbors on one side.
    fn sweep(&mut self, netlist: &Netlist, forwards: bool) {
        let count = self.layers.len();
        let order: Vec<usize> = if forwards { (0..count).collect() } else { (0..count).rev().collect() };
        for layer in order {
            let heights: Vec<BTreeMap<Slot, f64>> = self.layers.iter().map(|slots| heights(slots)).collect();
            let mean = |slot: Slot| {
                let near = if forwards { self.before(netlist, slot, layer) } else { self.after(netlist, slot, layer) };
                let near: Vec<f64> = near.iter().map(|(layer, slot)| heights[*layer][slot]).collect();
                if near.is_empty() { heights[layer][&slot] } else { near.iter().sum::<f64>() / near.len() as f64 }
            };
            let mut slots: Vec<(f64, Slot)> = self.layers[layer].iter().map(|&slot| (mean(slot), slot)).collect();
            slots.sort_by(|a, b| a.0.total_cmp(&b.0));
            self.layers[layer] = slots.into_iter().map(|(_, slot)| slot).collect();
        }
    }

    fn before(&self, netlist: &Netlist, slot: Slot, layer: usize) -> Vec<(usize, Slot)> {
        self.entries(netlist, slot, layer).into_iter().map(|(before, _)| (layer - 1, before)).collect()
    }

    /// The slots of the previous layer that are wired to a slot, each with the relative height at which the wire
    /// enters.
    pub fn entries(&self, netlist: &Netlist, slot: Slot, layer: usize) -> Vec<(Slot, f64)> {
        let id = match slot {
            Slot::Pass(net) => return vec![(self.carrier(net, layer - 1), 0.5)],
            Slot::Node(id) => id,
        };
        let pins = netlist.pins(id);
        let share = |pin: usize| (pin as f64 + 1.0) / (pins.len() as f64 + 1.0);
        let forwards = pins.iter().enumerate().filter(|&(_, &net)| !self.is_feedback(net, id));
        forwards.map(|(pin, &net)| (self.carrier(net, layer - 1), share(pin))).collect()
    }

    pub fn after(&self, netlist: &Netlist, slot: Slot, layer: usize) -> Vec<(usize, Slot)> {
        let (Slot::Node(net) | Slot::Pass(net)) = slot;
        let listeners: Vec<NetId> = netlist.fanout(net).into_iter().map(|(listener, _)| listener).collect();
        let near = listeners.iter().filter(|&&id| self.layer_of(id) == layer + 1);
        let far = listeners.iter().any(|&id| self.layer_of(id) > layer + 1);
        near.map(|&id| (layer + 1, Slot::Node(id))).chain(far.then_some((layer + 1, Slot::Pass(net)))).collect()
    }
}

/// The relative position of each slot in its layer: 0 at the top, 1 at the bottom.
fn heights(slots: &[Slot]) -> BTreeMap<Slot, f64> {
    let count = slots.len() as f64;
    slots.iter().enumerate().map(|(i, &slot)| (slot, (i as f64 + 0.5) / count)).collect()
}

/// The layer of each node: inputs and constants in the first, every node after its drivers except those of feedback,
/// outputs in the last.
fn assign(netlist: &Netlist) -> BTreeMap<NetId, usize> {
    let loops = Loops::of(netlist);
    let mut layer: BTreeMap<NetId, usize> = BTreeMap::new();
    let mut seen: BTreeSet<NetId> = BTreeSet::new();
    for &id in loops.order() {
        // A driver that is later in the order is feedback.
        let drivers = netlist.pins(id).into_iter().filter(|driver| seen.contains(driver));
        let first = usize::from(!matches!(netlist.node(id), Node::Input(_) | Node::Constant(_)));
        let at = drivers.map(|driver| layer[&driver] + 1).max().unwrap_or(0).max(first);
        layer.insert(id, at);
        seen.insert(id);
    }
    let last = layer.values().max().copied().unwrap_or(0).max(1);
    for &output in netlist.outputs() {
        layer.insert(output, last);
    }
    layer
}
