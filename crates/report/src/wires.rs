//! Wires of a sheet: the places of its nodes, and the lines between them.

use std::collections::{BTreeMap, BTreeSet};

use crate::Color;
use crate::element::{Paint, Point};
use crate::layers::{Layers, Slot, straighten};
use crate::svg::Svg;
use nbc_circuit::{NetId, Netlist, Node};

const CELL: (f64, f64) = (132.0, 106.0);
const PORT: (f64, f64) = (54.0, 24.0);
pub const MOST_LETTERS: usize = 20;
const GAP: f64 = 22.0;
const PASS: f64 = 12.0;
const TRACK: f64 = 9.0;
const TOP: f64 = 52.0;

pub struct SheetPlan {
    pub layers: Layers,
    /// Upper left corner of each slot.
    pub corners: BTreeMap<(usize, Slot), Point>,
    /// The left edge of each layer's slots, and of the layer after the last.
    lefts: Vec<f64>,
    /// For each channel to the right of a layer (channel 0 is left of all), the nets with a vertical track in it.
    tracks: Vec<Vec<(NetId, bool)>>,
    /// Nets with feedback, in order of their lanes below the layers.
    lanes: Vec<NetId>,
    bottom: f64,
    pub width: f64,
    pub height: f64,
    sizes: Sizes,
}

#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    port: Point,
}

impl Sizes {
    pub fn of(netlist: &Netlist) -> Self {
        let ports = netlist.ids().filter(|&id| matches!(netlist.node(id), Node::Input(_) | Node::Output(_)));
        let longest = ports.map(|id| netlist.net_name(id).chars().count()).max().unwrap_or(0);
        Self { port: (PORT.0.max(14.0 + 7.5 * longest.min(MOST_LETTERS) as f64), PORT.1) }
    }

    pub fn of_slot(self, netlist: &Netlist, slot: Slot) -> Point {
        match slot {
            Slot::Pass(_) => (CELL.0, PASS),
            Slot::Node(id) => match netlist.node(id) {
                Node::Cell(_) | Node::Register(_) | Node::Wire { .. } => CELL,
                Node::Input(_) | Node::Output(_) | Node::Constant(_) => self.port,
            },
        }
    }
}

impl SheetPlan {
    pub fn of(netlist: &Netlist) -> Self {
        let sizes = Sizes::of(netlist);
        let size = |netlist: &Netlist, slot: Slot| sizes.of_slot(netlist, slot);
        let layers = Layers::of(netlist);
        let tracks = tracks(netlist, &layers);
        let lanes = feedback_nets(netlist, &layers);
        let mut lefts = vec![14.0 + channel_width(&tracks[0])];
        for (layer, slots) in layers.layers.iter().enumerate() {
            let widest = slots.iter().map(|&slot| size(netlist, slot).0).fold(0.0, f64::max);
            lefts.push(lefts[layer] + widest + channel_width(&tracks[layer + 1]));
        }
        let tops = straighten(&layers, netlist, |slot| size(netlist, slot).1, GAP);
        let mut corners = BTreeMap::new();
        let mut bottom = TOP + 60.0;
        for (layer, slots) in layers.layers.iter().enumerate() {
            for (&slot, top) in slots.iter().zip(&tops[layer]) {
                corners.insert((layer, slot), (lefts[layer], TOP + top));
                bottom = f64::max(bottom, TOP + top + size(netlist, slot).1 + GAP);
            }
        }
        let width = (lefts[lefts.len() - 1] + 14.0).max(260.0);
        let height = bottom + lanes.len() as f64 * TRACK + 40.0;
        Self { layers, corners, lefts, tracks, lanes, bottom, width, height, sizes }
    }

    pub fn nets(&self, netlist: &Netlist) -> Vec<NetId> {
        netlist.ids().filter(|&id| !netlist.fanout(id).is_empty()).collect()
    }

    pub fn size(&self, netlist: &Netlist, id: NetId) -> Point {
        self.sizes.of_slot(netlist, Slot::Node(id))
    }

    fn track(&self, channel: usize, net: NetId, back: bool) -> f64 {
        let tracks = &self.tracks[channel];
        let place = tracks.iter().position(|&track| track == (net, back)).expect("a net has a track where it turns");
        self.lefts[channel] - (tracks.len() - place) as f64 * TRACK - 8.0
    }

    fn lane(&self, net: NetId) -> f64 {
        let place = self.lanes.iter().position(|&lane| lane == net).expect("a net with feedback has a lane");
        self.bottom + place as f64 * TRACK + 6.0
    }

    fn exit(&self, netlist: &Netlist, layer: usize, net: NetId) -> Point {
        let slot = self.layers.carrier(net, layer);
        let ((x, y), (width, height)) = (self.corners[&(layer, slot)], self.sizes.of_slot(netlist, slot));
        (x + width, y + height / 2.0)
    }

    fn entry(&self, netlist: &Netlist, layer: usize, slot: Slot, pin: u8, pins: usize) -> Point {
        let ((x, y), (_, height)) = (self.corners[&(layer, slot)], self.sizes.of_slot(netlist, slot));
        (x, y + height * (f64::from(pin) + 1.0) / (pins as f64 + 1.0))
    }
}

fn channel_width(tracks: &[(NetId, bool)]) -> f64 {
    tracks.len() as f64 * TRACK + 22.0
}

fn feedback_nets(netlist: &Netlist, layers: &Layers) -> Vec<NetId> {
    let runs_back = |id: &NetId| netlist.fanout(*id).iter().any(|&(listener, _)| layers.is_feedback(*id, listener));
    netlist.ids().filter(runs_back).collect()
}

/// Forward nets are in every channel they cross, feedback nets where they leave and where they arrive.
fn tracks(netlist: &Netlist, layers: &Layers) -> Vec<Vec<(NetId, bool)>> {
    let mut tracks = vec![BTreeSet::new(); layers.layers.len() + 1];
    for id in netlist.ids() {
        let from = layers.layer_of(id);
        for (listener, _) in netlist.fanout(id) {
            let to = layers.layer_of(listener);
            if layers.is_feedback(id, listener) {
                tracks[from + 1].insert((id, false));
                tracks[to].insert((id, true));
            } else {
                tracks[from + 1..=to].iter_mut().for_each(|channel| {
                    channel.insert((id, false));
                });
            }
        }
    }
    tracks.into_iter().map(|channel| channel.into_iter().collect()).collect()
}

pub fn draw_net(svg: &mut Svg, netlist: &Netlist, plan: &SheetPlan, net: NetId, critical: &BTreeSet<(NetId, NetId)>) {
    let from = plan.layers.layer_of(net);
    let fanout = netlist.fanout(net);
    let last = fanout.iter().map(|&(listener, _)| plan.layers.layer_of(listener)).max().unwrap_or(from);
    let back: Vec<(NetId, u8)> =
        fanout.iter().copied().filter(|&(listener, _)| plan.layers.is_feedback(net, listener)).collect();
    for layer in from..last.max(from + 1) {
        let exit = plan.exit(netlist, layer, net);
        let near = fanout.iter().filter(|&&(id, _)| plan.layers.layer_of(id) == layer + 1);
        let mut ends: Vec<(Point, bool)> = near
            .map(|&(id, pin)| {
                let pins = netlist.pins(id).len();
                (plan.entry(netlist, layer + 1, Slot::Node(id), pin, pins), is_critical(critical, net, id))
            })
            .collect();
        if last > layer + 1 {
            let far = fanout.iter().filter(|&&(id, _)| plan.layers.layer_of(id) > layer + 1);
            let bold = far.clone().any(|&(id, _)| is_critical(critical, net, id));
            let entry = plan.entry(netlist, layer + 1, Slot::Pass(net), 0, 1);
            ends.push((entry, bold));
            let passed = (entry.0 + CELL.0, entry.1);
            svg.line(entry, passed, wire(bold));
        }
        let bold_back = back.iter().any(|&(listener, _)| is_critical(critical, net, listener));
        let lane = (layer == from && !back.is_empty()).then(|| (plan.lane(net), bold_back));
        if ends.is_empty() && lane.is_none() {
            continue;
        }
        let track = plan.track(layer + 1, net, false);
        draw_trunk(svg, exit, track, &ends, lane);
    }
    for (listener, pin) in back {
        draw_feedback(svg, netlist, plan, (net, listener, pin), is_critical(critical, net, listener));
    }
}

fn is_critical(critical: &BTreeSet<(NetId, NetId)>, net: NetId, listener: NetId) -> bool {
    critical.contains(&(net, listener))
}

pub fn wire(critical: bool) -> Paint {
    if critical { Paint::stroke(Color::FAULT, 2.6) } else { Paint::stroke(Color::GRAY, 1.3) }
}

fn draw_trunk(svg: &mut Svg, exit: Point, track: f64, ends: &[(Point, bool)], lane: Option<(f64, bool)>) {
    let branch = |&((x, y), bold): &(Point, bool)| (vec![exit, (track, exit.1), (track, y), (x, y)], bold);
    let down = lane.map(|(lane, bold)| (vec![exit, (track, exit.1), (track, lane)], bold));
    let mut wires: Vec<(Vec<Point>, bool)> = ends.iter().map(branch).chain(down).collect();
    // Bold lines last, so that they are on top.
    wires.sort_by_key(|(_, bold)| *bold);
    for (points, bold) in wires {
        svg.polyline(&points, wire(bold));
    }
    if ends.len() + usize::from(lane.is_some()) > 1 {
        svg.circle((track, exit.1), 2.6, Paint::fill(Color::GRAY));
    }
}

fn draw_feedback(
    svg: &mut Svg,
    netlist: &Netlist,
    plan: &SheetPlan,
    (net, listener, pin): (NetId, NetId, u8),
    bold: bool,
) {
    let (from, to) = (plan.layers.layer_of(net), plan.layers.layer_of(listener));
    let (start, end) = (plan.track(from + 1, net, false), plan.track(to, net, true));
    let lane = plan.lane(net);
    let (x, y) = plan.entry(netlist, to, Slot::Node(listener), pin, netlist.pins(listener).len());
    svg.polyline(&[(start, lane), (end, lane), (end, y), (x, y)], wire(bold));
}
