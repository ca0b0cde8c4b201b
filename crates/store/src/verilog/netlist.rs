//! The netlist of words that Yosys writes as JSON, before it becomes gates: ports, where nets are declared, and what a
//! person should know of it.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;

use crate::verilog::messages::{self, SandboxFiles};
use crate::verilog::wording;
use nbc_base::source::{VerilogNote, VerilogPlace};

#[derive(Deserialize)]
pub(super) struct WordNetlist {
    creator: String,
    modules: BTreeMap<String, WordModule>,
}

#[derive(Default, Deserialize)]
struct WordModule {
    #[serde(default)]
    attributes: Attributes,
    ports: BTreeMap<String, Port>,
    cells: BTreeMap<String, WordCell>,
    netnames: BTreeMap<String, Net>,
}

#[derive(Deserialize)]
struct Port {
    direction: String,
    bits: Vec<Bit>,
    #[serde(default)]
    upto: u8,
}

#[derive(Deserialize)]
struct WordCell {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    attributes: Attributes,
    #[serde(default)]
    port_directions: BTreeMap<String, String>,
    connections: BTreeMap<String, Vec<Bit>>,
}

#[derive(Deserialize)]
struct Net {
    hide_name: u8,
    bits: Vec<Bit>,
    #[serde(default)]
    offset: i64,
    #[serde(default)]
    upto: u8,
    #[serde(default)]
    attributes: Attributes,
}

#[derive(Default, Deserialize)]
struct Attributes {
    src: Option<String>,
}

/// A number of a net, or the digit of a constant.
#[derive(Clone, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
#[serde(untagged)]
enum Bit {
    Net(u64),
    Constant(String),
}

/// What drives a bit, in words and with its place.
type Driver = (String, Option<VerilogPlace>);

impl WordNetlist {
    pub(super) fn version(&self) -> String {
        self.creator.split_whitespace().nth(1).unwrap_or("?").to_owned()
    }

    /// The ports of a module whose leftmost bit has the lowest number.
    pub(super) fn ascending(&self, module: &str) -> BTreeSet<String> {
        let ports = self.modules.get(module).into_iter().flat_map(|module| &module.ports);
        ports.filter(|(_, port)| port.upto == 1).map(|(name, _)| name.clone()).collect()
    }

    pub(super) fn declared(&self, module: &str, names: &SandboxFiles) -> Option<VerilogPlace> {
        self.modules.get(module)?.attributes.place(module, names)
    }

    pub(super) fn places(&self, module: &str, names: &SandboxFiles) -> BTreeMap<String, VerilogPlace> {
        let nets = self.modules.get(module).into_iter().flat_map(|module| &module.netnames);
        nets.filter_map(|(name, net)| Some((name.clone(), net.attributes.place(name, names)?))).collect()
    }

    /// What a person should know of a module. `latches` are the nets that are meant to be latches.
    pub(super) fn notes(&self, module: &str, names: &SandboxFiles, latches: &BTreeSet<String>) -> Vec<VerilogNote> {
        let Some(module) = self.modules.get(module) else { return Vec::new() };
        let nets = module.visible();
        let place = |name: &str| module.netnames.get(whole(name))?.attributes.place(whole(name), names);
        let mut notes = Vec::new();
        for (name, port) in &module.ports {
            if port.direction == "inout" {
                notes.push(wording::two_ways(name, place(name)));
            }
        }
        let mut driven: BTreeMap<&Bit, Vec<Driver>> = BTreeMap::new();
        for port in module.ports.values().filter(|port| port.direction == "input") {
            for bit in &port.bits {
                driven.entry(bit).or_default().push(("the input port".to_owned(), None));
            }
        }
        let used = module.used();
        let mut open = None;
        for cell in module.cells.values() {
            let name = || cell.bits("output").find_map(|(_, _, bit)| nets.get(bit));
            let at = |net: &String| cell.place(names).or_else(|| place(net));
            let has = |digit: &str| cell.bits("input").any(|(.., bit)| bit.is(digit));
            let is_changing = |port: &str| cell.connections.get(port).into_iter().flatten().any(Bit::is_net);
            match (cell.kind.as_str(), name()) {
                ("$eqx" | "$nex", _) if has("x") || has("z") => notes.push(wording::unknown_equal(cell.place(names))),
                ("$tribuf" | "$_TBUF_", Some(net)) => notes.push(wording::high_impedance(net, at(net))),
                (_, Some(net)) if has("z") => notes.push(wording::high_impedance(net, at(net))),
                ("$dlatch", Some(net)) if !latches.contains(whole(net)) => {
                    notes.push(wording::latch(whole(net), at(net)));
                }
                ("$aldff" | "$aldffe", Some(net)) if is_changing("AD") => {
                    notes.push(wording::load(whole(net), at(net)));
                }
                _ if cell.is_open(&used) => open = open.or(Some(cell.place(names))),
                _ => {}
            }
            for (port, at, bit) in cell.bits("output").filter(|(.., bit)| bit.is_net()) {
                driven.entry(bit).or_default().push((cell.described(port, at, &nets), cell.place(names)));
            }
        }
        // What a latch does not take is open, too.
        let has_latches = module.cells.values().any(|cell| cell.kind.contains("dlatch"));
        notes.extend(open.filter(|_| !has_latches).map(wording::open));
        let mut told: BTreeSet<&str> = BTreeSet::new();
        for (bit, name) in &nets {
            match driven.get(bit).map(Vec::as_slice).unwrap_or_default() {
                [] if bit.is_net() && used.contains(bit) && told.insert(whole(name)) => {
                    notes.push(wording::undriven(name, place(name)));
                }
                [first, second, ..] if used.contains(bit) && told.insert(whole(name)) => {
                    notes.push(wording::driven_twice(name, [first.clone(), second.clone()], place(name)));
                }
                _ => {}
            }
        }
        notes
    }

    /// The nets of a module that have several drivers and that no output depends on, such as arguments of a function.
    pub(super) fn stale(&self, module: &str) -> Vec<&str> {
        let Some(module) = self.modules.get(module) else { return Vec::new() };
        let used = module.used();
        let mut drivers: BTreeMap<&Bit, usize> = BTreeMap::new();
        for (.., bit) in module.cells.values().flat_map(|cell| cell.bits("output")) {
            *drivers.entry(bit).or_default() += 1;
        }
        let is_stale = |bit: &Bit| !used.contains(bit) && drivers.get(bit).is_some_and(|&count| count > 1);
        let nets = module.netnames.iter().filter(|(_, net)| net.bits.iter().any(is_stale));
        nets.map(|(name, _)| name.as_str()).collect()
    }
}

impl WordModule {
    /// The bits on which an output depends.
    fn used(&self) -> BTreeSet<&Bit> {
        let mut drivers: BTreeMap<&Bit, Vec<(&WordCell, usize)>> = BTreeMap::new();
        for cell in self.cells.values() {
            cell.bits("output").for_each(|(_, at, bit)| drivers.entry(bit).or_default().push((cell, at)));
        }
        let outputs = self.ports.values().filter(|port| port.direction == "output");
        let mut waiting: Vec<&Bit> = outputs.flat_map(|port| &port.bits).collect();
        let mut used = BTreeSet::new();
        while let Some(bit) = waiting.pop() {
            if used.insert(bit) {
                for (cell, at) in drivers.remove(bit).into_iter().flatten() {
                    let is_meant = |own: usize| cell.kind != "$buf" || own == at;
                    waiting.extend(cell.bits("input").filter(|(_, own, _)| is_meant(*own)).map(|(.., bit)| bit));
                }
            }
        }
        used
    }

    /// A name that a person wrote for each bit, the shortest if there are several.
    fn visible(&self) -> BTreeMap<&Bit, String> {
        let mut found: BTreeMap<&Bit, String> = BTreeMap::new();
        for (name, net) in self.netnames.iter().filter(|(_, net)| net.hide_name == 0) {
            for (at, bit) in net.bits.iter().enumerate() {
                let at = if net.upto == 1 { net.bits.len() - 1 - at } else { at };
                let number = net.offset + at as i64;
                let own = if net.bits.len() == 1 { name.clone() } else { format!("{name}[{number}]") };
                let known = found.entry(bit).or_insert_with(|| own.clone());
                if own.len() < known.len() {
                    *known = own;
                }
            }
        }
        found
    }
}

impl Bit {
    fn is_net(&self) -> bool {
        matches!(self, Self::Net(_))
    }

    fn is(&self, digit: &str) -> bool {
        matches!(self, Self::Constant(own) if own == digit)
    }
}

impl WordCell {
    /// The bits of its inputs or outputs, each with its port and number.
    fn bits(&self, direction: &str) -> impl Iterator<Item = (&str, usize, &Bit)> {
        let of_direction = move |port: &&String| self.port_directions.get(*port).is_some_and(|own| own == direction);
        let ports = self.connections.keys().filter(move |port| of_direction(port));
        ports.flat_map(|port| self.connections[port].iter().enumerate().map(|(at, bit)| (port.as_str(), at, bit)))
    }

    /// Whether a used output can depend on an unknown bit.
    fn is_open(&self, used: &BTreeSet<&Bit>) -> bool {
        let is_used = |at: usize| {
            self.bits("output").any(|(_, own, bit)| (self.kind != "$buf" || own == at) && used.contains(bit))
        };
        self.bits("input").any(|(_, at, bit)| bit.is("x") && is_used(at))
    }

    fn place(&self, names: &SandboxFiles) -> Option<VerilogPlace> {
        messages::at(self.attributes.src.as_ref()?, names)
    }

    fn described(&self, port: &str, at: usize, nets: &BTreeMap<&Bit, String>) -> String {
        let buffered = self.connections.get("A").and_then(|bits| bits.get(at)).filter(|_| self.kind == "$buf");
        match buffered {
            Some(Bit::Constant(digit)) => format!("the constant {digit}"),
            Some(bit) => nets.get(bit).map_or_else(|| "logic".to_owned(), |net| format!("`{net}`")),
            None if port == "Q" => "a register".to_owned(),
            None => "logic".to_owned(),
        }
    }
}

impl Attributes {
    fn place(&self, name: &str, names: &SandboxFiles) -> Option<VerilogPlace> {
        let src = self.src.as_ref()?;
        let mut place = messages::at(src, names)?;
        let column = || src.split('|').next()?.rsplit('.').next()?.parse::<usize>().ok();
        let written = name.rsplit('.').next().unwrap_or(name).len();
        place.columns = place.columns.or_else(|| column().map(|first| [first, first + written]));
        Some(place)
    }
}

/// The net of a bit such as `a[3]`.
fn whole(name: &str) -> &str {
    name.strip_suffix(']').and_then(|name| name.rsplit_once('[')).map_or(name, |(net, _)| net)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_person_is_told_of_open_nets_two_drivers_and_latches() {
        let json = r#"{"creator": "Yosys 0.70 (git)", "modules": {"m": {
            "ports": {
                "a": {"direction": "input", "bits": [2], "upto": 1},
                "q": {"direction": "output", "bits": [3, 4]}},
            "cells": {
                "one": {"type": "$buf", "port_directions": {"A": "input", "Y": "output"},
                    "connections": {"A": ["1"], "Y": [3]}, "attributes": {}},
                "two": {"type": "$dlatch", "port_directions": {"D": "input", "EN": "input", "Q": "output"},
                    "connections": {"D": [2], "EN": [5], "Q": [3]}, "attributes": {"src": "s.v:4.1"}}},
            "netnames": {
                "a": {"hide_name": 0, "bits": [2], "attributes": {"src": "s.v:1.10"}},
                "q": {"hide_name": 0, "bits": [3, 4], "attributes": {"src": "s.v:1.13"}},
                "e": {"hide_name": 0, "bits": [5], "attributes": {"src": "s.v:2.6"}}}}}}"#;
        let netlist: WordNetlist = serde_json::from_str(json).unwrap();
        let names = SandboxFiles::from([("s.v".to_owned(), "m.v".into())]);
        let said = |latches: &[&str]| {
            let latches = latches.iter().map(|&name| name.to_owned()).collect();
            netlist.notes("m", &names, &latches).into_iter().map(|note| note.message).collect::<Vec<_>>()
        };
        let twice = "`q[0]` is driven twice: by the constant 1 and by a register (line 4)";
        assert_eq!(said(&[]), ["`q` is a latch", twice, "nothing drives `e`"]);
        assert_eq!(said(&["q"]), [twice, "nothing drives `e`"]);
        assert_eq!((netlist.version(), netlist.ascending("m")), ("0.70".to_owned(), BTreeSet::from(["a".to_owned()])));
        assert_eq!(netlist.places("m", &names)["e"].columns, Some([6, 7]));
    }
}
