//! Schematics: a netlist in layers, each cell with the robot that plays it.

use std::collections::{BTreeMap, BTreeSet};

use crate::report::Color;
use crate::report::element::{Anchor, Paint, Point, Type};
use crate::report::heights;
use crate::report::layers::{Layers, Slot};
use crate::report::looks::Looks;
use crate::report::scheme::Scheme;
use crate::report::sprite::draw_body;
use crate::report::svg::{Svg, shorten};
use nbc_base::model::Robot;
use nbc_circuit::{NetId, Netlist, Node};

const CELL: (f64, f64) = (108.0, 92.0);
const PORT: (f64, f64) = (54.0, 24.0);
const GAP: f64 = 22.0;
const PASS: f64 = 12.0;
const TRACK: f64 = 9.0;
const TOP: f64 = 52.0;
/// Larger circuits are drawn without bodies, which would be too small to see.
const MAX_BODIES: usize = 400;

/// Draws a netlist. `robots` are those of its cells in order, or empty if none are chosen yet; `critical` are the nets
/// of the slowest path.
pub fn draw_schematic(netlist: &Netlist, robots: &[&Robot], critical: &[NetId], scheme: Scheme) -> Svg {
    let plan = Plan::of(netlist);
    let mut svg = Svg::new(plan.width, plan.height, &format!("schematic of {}", netlist.name));
    svg.text((14.0, 28.0), &netlist.name, Type::new(17.0).bold());
    draw_legend(&mut svg, &plan, critical);
    let critical: BTreeSet<(NetId, NetId)> = critical.windows(2).map(|pair| (pair[0], pair[1])).collect();
    for net in plan.nets(netlist) {
        let name = netlist.net_name(net);
        svg.group(&format!("net-{name}"), &name, |svg| draw_net(svg, netlist, &plan, net, &critical));
    }
    let looks = Looks::of(robots.iter().map(|robot| &robot.body), scheme);
    let cells: BTreeMap<NetId, usize> = netlist.cells().enumerate().map(|(i, (id, _))| (id, i)).collect();
    for id in netlist.ids() {
        let number = cells.get(&id).copied();
        let robot = number.and_then(|i| robots.get(i)).filter(|_| cells.len() <= MAX_BODIES).copied();
        draw_node(&mut svg, netlist, &plan, Symbol { id, number, robot, looks: &looks });
    }
    svg
}

/// The positions of all parts.
struct Plan {
    layers: Layers,
    /// Upper left corner of each slot.
    corners: BTreeMap<(usize, Slot), Point>,
    /// The left edge of each layer's slots, and of the layer after the last.
    lefts: Vec<f64>,
    /// For each channel to the right of a layer (channel 0 is left of all), the nets with a vertical track in it.
    tracks: Vec<Vec<(NetId, bool)>>,
    /// Nets with feedback, in order of their lanes below the layers.
    lanes: Vec<NetId>,
    bottom: f64,
    width: f64,
    height: f64,
}

fn size(netlist: &Netlist, slot: Slot) -> Point {
    match slot {
        Slot::Pass(_) => (CELL.0, PASS),
        Slot::Node(id) => match netlist.node(id) {
            Node::Cell(_) | Node::Wire { .. } => CELL,
            Node::Input(_) | Node::Output(_) | Node::Constant(_) => PORT,
        },
    }
}

impl Plan {
    fn of(netlist: &Netlist) -> Self {
        let layers = Layers::of(netlist);
        let tracks = tracks(netlist, &layers);
        let lanes = feedback_nets(netlist, &layers);
        let mut lefts = vec![14.0 + channel_width(&tracks[0])];
        for (layer, slots) in layers.layers.iter().enumerate() {
            let widest = slots.iter().map(|&slot| size(netlist, slot).0).fold(0.0, f64::max);
            lefts.push(lefts[layer] + widest + channel_width(&tracks[layer + 1]));
        }
        let tops = heights::straighten(&layers, netlist, |slot| size(netlist, slot).1, GAP);
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
        Self { layers, corners, lefts, tracks, lanes, bottom, width, height }
    }

    /// The nets that drive something.
    fn nets(&self, netlist: &Netlist) -> Vec<NetId> {
        netlist.ids().filter(|&id| !netlist.fanout(id).is_empty()).collect()
    }

    /// The position of a net's vertical track in a channel.
    fn track(&self, channel: usize, net: NetId, back: bool) -> f64 {
        let tracks = &self.tracks[channel];
        let place = tracks.iter().position(|&track| track == (net, back)).expect("a net has a track where it turns");
        self.lefts[channel] - (tracks.len() - place) as f64 * TRACK - 8.0
    }

    fn lane(&self, net: NetId) -> f64 {
        let place = self.lanes.iter().position(|&lane| lane == net).expect("a net with feedback has a lane");
        self.bottom + place as f64 * TRACK + 6.0
    }

    /// The point at which a net leaves its slot in a layer.
    fn exit(&self, netlist: &Netlist, layer: usize, net: NetId) -> Point {
        let slot = self.layers.carrier(net, layer);
        let ((x, y), (width, height)) = (self.corners[&(layer, slot)], size(netlist, slot));
        (x + width, y + height / 2.0)
    }

    /// The point at which a net enters a slot: a pin of a node, or a passage.
    fn entry(&self, netlist: &Netlist, layer: usize, slot: Slot, pin: u8, pins: usize) -> Point {
        let ((x, y), (_, height)) = (self.corners[&(layer, slot)], size(netlist, slot));
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

/// The nets with a track in each channel: forward nets in every channel they cross, and feedback nets where they leave
/// and where they arrive.
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

/// Draws a net: in each channel a trunk with a branch for each slot it goes to.
fn draw_net(svg: &mut Svg, netlist: &Netlist, plan: &Plan, net: NetId, critical: &BTreeSet<(NetId, NetId)>) {
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

fn wire(critical: bool) -> Paint {
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

/// A wire that runs back: along a lane below the layers and up to its pin.
fn draw_feedback(svg: &mut Svg, netlist: &Netlist, plan: &Plan, (net, listener, pin): (NetId, NetId, u8), bold: bool) {
    let (from, to) = (plan.layers.layer_of(net), plan.layers.layer_of(listener));
    let (start, end) = (plan.track(from + 1, net, false), plan.track(to, net, true));
    let lane = plan.lane(net);
    let (x, y) = plan.entry(netlist, to, Slot::Node(listener), pin, netlist.pins(listener).len());
    svg.polyline(&[(start, lane), (end, lane), (end, y), (x, y)], wire(bold));
}

/// Draws a node.
struct Symbol<'a> {
    id: NetId,
    /// The cell's place among the cells.
    number: Option<usize>,
    robot: Option<&'a Robot>,
    looks: &'a Looks,
}

fn draw_node(svg: &mut Svg, netlist: &Netlist, plan: &Plan, symbol: Symbol<'_>) {
    let slot = Slot::Node(symbol.id);
    let layer = plan.layers.layer_of(symbol.id);
    let corner = plan.corners[&(layer, slot)];
    let name = netlist.net_name(symbol.id);
    match netlist.node(symbol.id) {
        Node::Cell(cell) => {
            let pins: Vec<String> = netlist.pins(symbol.id).into_iter().map(|net| netlist.net_name(net)).collect();
            let robot = symbol.robot.map_or(String::new(), |robot| format!(", robot {}", robot.name));
            let title = format!("{name} = {}({}){robot}", cell.function, pins.join(", "));
            let id = format!("cell-{}", symbol.number.unwrap_or(0));
            svg.group(&id, &title, |svg| draw_cell(svg, corner, (&name, cell.function.name()), &symbol));
        }
        Node::Wire { .. } => draw_box(svg, corner, CELL, &name),
        Node::Input(_) => svg.group(&format!("input-{name}"), &name, |svg| draw_box(svg, corner, PORT, &name)),
        Node::Output(_) => svg.group(&format!("output-{name}"), &name, |svg| draw_box(svg, corner, PORT, &name)),
        Node::Constant(_) => draw_box(svg, corner, PORT, &name),
    }
}

/// A port: a box with its name, shortened if it is too long.
fn draw_box(svg: &mut Svg, (x, y): Point, (width, height): Point, name: &str) {
    svg.rect((x, y), width, height, Paint::fill(Color::PALE).with_stroke(Color::GRAY, 1.0));
    let set = Type::new(11.0).bold().anchored(Anchor::Middle);
    svg.text((x + width / 2.0, y + height / 2.0 + 4.0), &shorten(name, 8), set);
}

fn draw_cell(svg: &mut Svg, (x, y): Point, (net, function): (&str, &str), symbol: &Symbol<'_>) {
    svg.rect((x, y), CELL.0, CELL.1, Paint::fill(Color::WHITE).with_stroke(Color::BLACK, 1.4));
    svg.text((x + 6.0, y + 14.0), &function.to_uppercase(), Type::new(11.0).bold());
    let end = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::End);
    svg.text((x + CELL.0 - 6.0, y + 14.0), &shorten(net, 8), end);
    let Some(robot) = symbol.robot else { return };
    let side = robot.body.width().max(robot.body.height()) as f64;
    let body = draw_body(&robot.body, symbol.looks, 52.0 / side);
    svg.place((x + (CELL.0 - body.width()) / 2.0, y + 20.0 + (52.0 - body.height()).max(0.0)), 1.0, &body);
    let middle = Type::new(9.0).colored(Color::GRAY).anchored(Anchor::Middle);
    svg.text((x + CELL.0 / 2.0, y + CELL.1 - 5.0), &shorten(&robot.name, 18), middle);
}

fn draw_legend(svg: &mut Svg, plan: &Plan, critical: &[NetId]) {
    if critical.len() < 2 {
        return;
    }
    let y = plan.height - 12.0;
    svg.line((14.0, y - 4.0), (40.0, y - 4.0), wire(true));
    svg.text((46.0, y), "critical path", Type::new(11.0).colored(Color::GRAY));
}
