//! Positions of a netlist's nodes in a layered drawing: inputs left, outputs right, feedback running back, and heights
//! at which most wires are straight.

use std::collections::{BTreeMap, BTreeSet};

use nbc_circuit::{Loops, NetId, Netlist, Node};

const SWEEPS: usize = 8;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slot {
    Node(NetId),
    Pass(NetId),
}

#[derive(Clone, Debug, Default)]
pub struct Layers {
    pub layers: Vec<Vec<Slot>>,
    layer_of: BTreeMap<NetId, usize>,
}

impl Layers {
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

    /// The slots of the previous layer that are wired to a slot, and the relative heights at which the wires enter.
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

/// Inputs and constants in the first layer, each node after its drivers except those of feedback, outputs in the last.
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

const PASSES: usize = 12;

/// The top of each slot, layer by layer, the uppermost at 0. Slots keep their order and are at least `gap` apart.
pub fn straighten(layers: &Layers, netlist: &Netlist, height: impl Fn(Slot) -> f64, gap: f64) -> Vec<Vec<f64>> {
    let stacked = |slots: &Vec<Slot>| {
        let tops = slots.iter().scan(0.0, |next, &slot| {
            let top = *next;
            *next += height(slot) + gap;
            Some(top)
        });
        tops.collect::<Vec<f64>>()
    };
    let mut tops: Vec<Vec<f64>> = layers.layers.iter().map(stacked).collect();
    for sweep in 0..PASSES {
        let count = layers.layers.len();
        let order: Vec<usize> = if sweep % 2 == 0 { (0..count).collect() } else { (0..count).rev().collect() };
        for layer in order {
            let wanted: Vec<f64> = (0..layers.layers[layer].len())
                .map(|place| wanted(layers, netlist, &tops, &height, (layer, place), sweep % 2 == 0))
                .collect();
            let needed: Vec<f64> = layers.layers[layer].iter().map(|&slot| height(slot) + gap).collect();
            tops[layer] = nearest(&wanted, &needed);
        }
    }
    let highest = tops.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    tops.into_iter().map(|layer| layer.into_iter().map(|top| top - highest).collect()).collect()
}

fn wanted(
    layers: &Layers,
    netlist: &Netlist,
    tops: &[Vec<f64>],
    height: &impl Fn(Slot) -> f64,
    (layer, place): (usize, usize),
    forwards: bool,
) -> f64 {
    let slot = layers.layers[layer][place];
    let top_of = |layer: usize, slot: Slot| {
        let place = layers.layers[layer].iter().position(|&other| other == slot);
        tops[layer][place.expect("a neighbor stands in its layer")]
    };
    // A wire leaves the middle of a slot, and enters at its pin.
    let wires: Vec<f64> = if forwards {
        layers
            .entries(netlist, slot, layer)
            .into_iter()
            .map(|(before, share)| top_of(layer - 1, before) + height(before) / 2.0 - height(slot) * share)
            .collect()
    } else {
        layers
            .after(netlist, slot, layer)
            .into_iter()
            .map(|(next, after)| {
                let entries = layers.entries(netlist, after, next).into_iter();
                let shares: Vec<f64> = entries.filter(|(before, _)| *before == slot).map(|(_, share)| share).collect();
                let share = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
                top_of(next, after) + height(after) * share - height(slot) / 2.0
            })
            .collect()
    };
    if wires.is_empty() { tops[layer][place] } else { wires.iter().sum::<f64>() / wires.len() as f64 }
}

/// The closest by least squares that keep order and distance (isotonic regression by pooling adjacent violators).
fn nearest(wanted: &[f64], needed: &[f64]) -> Vec<f64> {
    let offsets: Vec<f64> = needed
        .iter()
        .scan(0.0, |next, room| {
            let offset = *next;
            *next += room;
            Some(offset)
        })
        .collect();
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (want, offset) in wanted.iter().zip(&offsets) {
        let mut pool = (want - offset, 1);
        while let Some(&(mean, count)) = pools.last().filter(|(mean, _)| *mean > pool.0) {
            pools.pop();
            let both = count + pool.1;
            pool = ((mean * count as f64 + pool.0 * pool.1 as f64) / both as f64, both);
        }
        pools.push(pool);
    }
    let free = pools.into_iter().flat_map(|(mean, count)| std::iter::repeat_n(mean, count));
    free.zip(offsets).map(|(mean, offset)| mean + offset).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(wanted: &[f64], needed: &[f64], expected: &[f64]) {
        assert_eq!(nearest(wanted, needed), expected);
    }

    #[test]
    fn slots_are_at_their_wanted_places_if_there_is_room() {
        check(&[0.0, 30.0], &[20.0, 20.0], &[0.0, 30.0]);
        check(&[], &[], &[]);
    }

    #[test]
    fn slots_with_the_same_wanted_place_share_it() {
        check(&[10.0, 10.0], &[20.0, 20.0], &[0.0, 20.0]);
        check(&[50.0, 0.0, 100.0], &[10.0, 10.0, 10.0], &[20.0, 30.0, 100.0]);
    }
}
