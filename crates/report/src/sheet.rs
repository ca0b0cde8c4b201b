//! A sheet of a schematic: one part of a circuit, with its cells, the parts inside as boxes, and ports for the nets
//! from and to the rest. It is a netlist too, so that it is placed like one.

use std::collections::{BTreeMap, BTreeSet};

use nbc_circuit::{Cell, NetId, Netlist, Node};

use crate::hierarchy::Hierarchy;
use nbc_base::model::Function;

/// The most ports of one direction that show a bit each; beyond that they show buses.
const MOST_BITS: usize = 12;
const MOST_PORTS: usize = 40;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SheetItem {
    Cell(NetId),
    Wire,
    Part(usize),
    Port,
    Constant,
}

#[derive(Clone, Debug)]
pub struct Sheet {
    pub netlist: Netlist,
    pub shown: BTreeMap<NetId, SheetItem>,
    pub nets: BTreeMap<NetId, Vec<NetId>>,
    pub ports: BTreeMap<NetId, Vec<NetId>>,
    nodes: BTreeMap<NetId, NetId>,
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Node(NetId),
    Part(usize),
    Constant(bool),
    From(String),
    To(String),
}

struct Builder<'a> {
    circuit: &'a Netlist,
    hierarchy: &'a Hierarchy,
    part: usize,
    inside: BTreeMap<NetId, Option<usize>>,
    near: BTreeSet<NetId>,
    sources: PortNames,
    sinks: PortNames,
    made: BTreeMap<Place, NetId>,
    sheet: Sheet,
}

impl Sheet {
    pub fn of(circuit: &Netlist, hierarchy: &Hierarchy, part: usize) -> Self {
        let netlist = Netlist::new(&circuit.name);
        let (shown, nets, ports, nodes) = Default::default();
        let sheet = Self { netlist, shown, nets, ports, nodes };
        let inside = hierarchy.inside(part);
        let beside = |&id: &NetId| circuit.pins(id).into_iter().chain(circuit.fanout(id).into_iter().map(|(id, _)| id));
        let near = match part {
            0 => circuit.ids().collect(),
            _ => inside.keys().flat_map(beside).chain(inside.keys().copied()).collect(),
        };
        let (sources, sinks) = Default::default();
        let made = BTreeMap::new();
        let mut builder = Builder { circuit, hierarchy, part, inside, near, sources, sinks, made, sheet };
        builder.name_ports();
        builder.add_nodes();
        builder.connect();
        builder.sheet
    }

    pub fn node_of(&self, net: NetId) -> Option<NetId> {
        self.nodes.get(&net).copied()
    }
}

impl Builder<'_> {
    fn is_inside(&self, id: NetId) -> bool {
        self.inside.contains_key(&id)
    }

    fn is_output(&self, id: NetId) -> bool {
        matches!(self.circuit.node(id), Node::Output(_))
    }

    fn name_ports(&mut self) {
        let (mut from, mut to) = (BTreeSet::new(), BTreeSet::new());
        if self.part == 0 {
            from.extend(self.circuit.inputs().iter().copied());
            to.extend(self.circuit.outputs().iter().copied());
        } else {
            for &id in &self.near {
                for (listener, _) in self.circuit.fanout(id) {
                    match (self.is_inside(id), self.is_inside(listener)) {
                        (true, false) => _ = to.insert(if self.is_output(listener) { listener } else { id }),
                        (false, true) if !matches!(self.circuit.node(id), Node::Constant(_)) => _ = from.insert(id),
                        _ => {}
                    }
                }
            }
        }
        self.sources = self.port_names(&from);
        self.sinks = self.port_names(&to);
    }

    fn port_names(&self, nets: &BTreeSet<NetId>) -> PortNames {
        let home = |id: NetId| match self.hierarchy.home.get(&id) {
            Some(&part) if part != 0 && part != self.part => self.hierarchy.titles(part).0.to_owned(),
            _ => "others".to_owned(),
        };
        let unnamed = |id: NetId| (!self.circuit.is_named(id)).then(|| home(id));
        PortNames::of(nets.iter().map(|&id| (id, self.circuit.net_label(id), unnamed(id))).collect())
    }

    fn add_nodes(&mut self) {
        for id in self.near.clone() {
            match self.circuit.node(id) {
                Node::Constant(value) if self.is_read(id) => self.node(Place::Constant(*value), Some(id)),
                Node::Constant(_) => {}
                Node::Output(_) if self.sinks.0.contains_key(&id) => {
                    let place = self.sink(id);
                    self.port(place, id, None);
                }
                Node::Output(_) => {}
                _ if self.is_inside(id) => {
                    let place = self.source(id);
                    self.node(place, Some(id));
                }
                _ if self.sources.0.contains_key(&id) => {
                    let place = self.source(id);
                    self.port(place, id, Some(id));
                }
                _ => {}
            }
        }
        let leaving: Vec<NetId> = self.inside.keys().copied().filter(|id| self.sinks.0.contains_key(id)).collect();
        for id in leaving {
            let place = self.sink(id);
            self.port(place, id, None);
        }
    }

    fn port(&mut self, place: Place, shown: NetId, id: Option<NetId>) {
        self.node(place.clone(), id);
        self.sheet.ports.entry(self.made[&place]).or_default().push(shown);
    }

    fn is_read(&self, constant: NetId) -> bool {
        let reads = |id: NetId| self.is_inside(id) || self.part == 0 && self.is_output(id);
        self.circuit.fanout(constant).iter().any(|&(listener, _)| reads(listener))
    }

    fn source(&self, id: NetId) -> Place {
        match (self.circuit.node(id), self.inside.get(&id)) {
            (Node::Constant(value), _) => Place::Constant(*value),
            (_, Some(&inner)) => inner.map_or(Place::Node(id), Place::Part),
            _ => Place::From(self.sources.0[&id].clone()),
        }
    }

    fn sink(&self, id: NetId) -> Place {
        Place::To(self.sinks.0[&id].clone())
    }

    fn node(&mut self, place: Place, id: Option<NetId>) {
        let Self { circuit, hierarchy, made, sheet, .. } = self;
        let netlist = &mut sheet.netlist;
        let node = *made.entry(place.clone()).or_insert_with(|| {
            let cell = |function, name: &str| Cell { function, name: Some(name.to_owned()), start: None, span: None };
            let (node, shown) = match &place {
                Place::Node(id) => match circuit.node(*id) {
                    Node::Cell(of) => {
                        let cell = cell(of.function, &circuit.net_name(*id));
                        (netlist.add_loose_cell(cell), SheetItem::Cell(*id))
                    }
                    _ => (netlist.add_wire(circuit.net_name(*id), None, None), SheetItem::Wire),
                },
                Place::Part(part) => {
                    let name = &hierarchy.parts[*part].name;
                    (netlist.add_loose_cell(cell(Function::BUF, name)), SheetItem::Part(*part))
                }
                Place::Constant(value) => (netlist.add_constant(*value), SheetItem::Constant),
                Place::From(name) => (netlist.add_input(name), SheetItem::Port),
                Place::To(name) => (netlist.add_loose_output(name), SheetItem::Port),
            };
            sheet.shown.insert(node, shown);
            node
        });
        sheet.nodes.extend(id.map(|id| (id, node)));
        sheet.nets.entry(node).or_default().extend(id);
    }

    /// A part or a port with several nets has one pin for each driver.
    fn connect(&mut self) {
        let mut known: BTreeMap<NetId, Vec<NetId>> = BTreeMap::new();
        for &id in &self.near {
            let (is_inside, is_sink) = (self.is_inside(id), self.is_output(id) && self.sinks.0.contains_key(&id));
            if is_inside || is_sink {
                let listener = if is_inside { self.source(id) } else { self.sink(id) };
                let is_node = matches!(listener, Place::Node(_));
                for pin in self.circuit.pins(id) {
                    let (from, to) = (self.made[&self.source(pin)], self.made[&listener]);
                    let pins = known.entry(to).or_default();
                    if is_node || from != to && !pins.contains(&from) {
                        pins.push(from);
                    }
                }
            }
            if is_inside && self.sinks.0.contains_key(&id) {
                let (from, to) = (self.made[&self.source(id)], self.made[&self.sink(id)]);
                let pins = known.entry(to).or_default();
                if !pins.contains(&from) {
                    pins.push(from);
                }
            }
        }
        for (to, pins) in known {
            for (pin, from) in (0..=u8::MAX).zip(pins) {
                self.sheet.netlist.connect(to, pin, from);
            }
        }
        // A net that stays inside its part is not one of the sheet.
        let circuit = self.circuit;
        let inside = |id: NetId| self.inside.get(&id).copied().flatten();
        for nets in self.sheet.nets.values_mut() {
            nets.retain(|&id| {
                let own = inside(id);
                own.is_none() || circuit.fanout(id).iter().any(|&(listener, _)| inside(listener) != own)
            });
        }
    }
}

#[derive(Clone, Debug, Default)]
struct PortNames(BTreeMap<NetId, String>);

impl PortNames {
    fn of(nets: Vec<(NetId, String, Option<String>)>) -> Self {
        let is_few = nets.len() <= MOST_BITS;
        let mut known = BTreeSet::new();
        let mut port = |name: String| {
            if known.len() < MOST_PORTS || known.contains(&name) {
                known.insert(name.clone());
                return name;
            }
            "others".to_owned()
        };
        let name = |(id, name, home): (NetId, String, Option<String>)| {
            let bus = || name.rfind('[').map_or(name.clone(), |at| name[..at].to_owned());
            let together = home.unwrap_or_else(bus);
            (id, port(if is_few { name } else { together }))
        };
        Self(nets.into_iter().map(name).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_circuit::BlockId;

    fn buses() -> Netlist {
        let mut netlist = Netlist::new("buses");
        let inputs: Vec<NetId> = (0..30).map(|bit| netlist.add_input(format!("a[{bit}]"))).collect();
        let mut nets = inputs;
        for call in ["first", "second"] {
            let block = netlist.blocks_mut().add(call, "invert", BlockId::TOP);
            for net in &mut nets {
                *net = netlist.add_gate(Function::NOT, &[*net]);
                netlist.put_into(*net, block);
            }
        }
        for (bit, &net) in nets.iter().enumerate() {
            netlist.add_output(format!("q[{bit}]"), net);
        }
        netlist
    }

    fn check(part: usize, expected: &str) {
        let netlist = buses();
        let hierarchy = Hierarchy::of(&netlist);
        let sheet = Sheet::of(&netlist, &hierarchy, part);
        let found = sheet.netlist.to_string();
        let lines: Vec<&str> = found.lines().take(5).map(str::trim).collect();
        assert_eq!(lines.join("; "), expected);
    }

    #[test]
    fn a_part_is_a_box_and_a_bus_is_a_port() {
        check(0, "netlist buses(a) -> (q) {; first = buf(a); second = buf(first); q = second; }");
    }

    #[test]
    fn a_sheet_of_a_part_has_ports_to_the_others() {
        let netlist = buses();
        let hierarchy = Hierarchy::of(&netlist);
        let sheet = Sheet::of(&netlist, &hierarchy, 2);
        let inputs: Vec<String> = sheet.netlist.inputs().iter().map(|&id| sheet.netlist.net_name(id)).collect();
        assert_eq!(inputs, ["first"], "nets without names are those of their part");
        let crossing = |id: &NetId| sheet.nets[id].len();
        assert_eq!(sheet.netlist.inputs().iter().map(crossing).collect::<Vec<_>>(), [30]);
        assert_eq!(sheet.netlist.cells().count(), 30);
    }
}
