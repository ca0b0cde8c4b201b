//! Names of nets in the project's own language: unique, legal, and bits of buses where the file has them.

use std::collections::{BTreeMap, BTreeSet};

use crate::formats::Design;
use crate::formats::buses::{Bus, buses};
use crate::formats::names::{free, stand_ins};
use crate::{NetId, Netlist, Node, RegisterNode};

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NamedBit {
    net: String,
    bit: usize,
    width: usize,
}

impl NamedBit {
    fn alone(net: String) -> Self {
        Self { net, bit: 0, width: 1 }
    }

    pub(super) fn text(&self) -> String {
        if self.width == 1 { self.net.clone() } else { format!("{}[{}]", self.net, self.bit) }
    }

    /// Bits as one expression, the highest first.
    pub(super) fn joined(bits: &[Self]) -> String {
        let [first, .., last] = bits else { return bits[0].text() };
        let next = |high: &Self, low: &Self| high.width > 1 && high.net == low.net && high.bit == low.bit + 1;
        if !bits.is_sorted_by(next) {
            let parts: Vec<_> = bits.iter().map(Self::text).collect();
            return format!("{{{}}}", parts.join(", "));
        }
        if bits.len() == first.width {
            first.net.clone()
        } else {
            format!("{}[{}..{}]", first.net, first.bit, last.bit)
        }
    }
}

#[derive(Clone, Debug)]
pub(super) struct NamedNet {
    pub(super) name: String,
    pub(super) bits: Vec<NetId>,
}

impl NamedNet {
    pub(super) fn declared(&self) -> String {
        if self.bits.len() == 1 { self.name.clone() } else { format!("{}[{}]", self.name, self.bits.len()) }
    }
}

#[derive(Default)]
pub(super) struct NbNames {
    pub(super) inputs: Vec<NamedNet>,
    pub(super) outputs: Vec<NamedNet>,
    /// The values of registers that no output shows, then the next values that cells compute.
    pub(super) states: Vec<NamedNet>,
    pub(super) nexts: Vec<NamedNet>,
    /// The other cells and wires, of one bit each.
    pub(super) others: Vec<NamedNet>,
    pub(super) stand_ins: BTreeMap<NetId, NetId>,
    bits: BTreeMap<NetId, NamedBit>,
    taken: BTreeSet<String>,
    ascending: BTreeSet<String>,
}

impl NbNames {
    pub(super) fn new(design: &Design) -> Self {
        let netlist = &design.netlist;
        let mut names = Self {
            stand_ins: stand_ins(netlist),
            ascending: design.ascending.iter().flat_map(|bus| [bus.clone(), format!("{bus}_next")]).collect(),
            ..Self::default()
        };
        names.inputs = names.nets(design.ports(), |id| netlist.net_name(id));
        names.outputs = names.nets(netlist.outputs(), |id| netlist.net_name(id));
        let clocks = names.nets(design.own_clocks(), |id| netlist.net_name(id));
        names.inputs.extend(clocks);
        let registers: Vec<NetId> = netlist.registers().map(|(id, _)| id).collect();
        let hidden: Vec<_> = registers.iter().copied().filter(|id| !names.stand_ins.contains_key(id)).collect();
        names.states = names.nets(&hidden, |id| netlist.net_name(id));
        let mut nexts: BTreeMap<NetId, String> = BTreeMap::new();
        let mut computed = Vec::new();
        for id in registers {
            let data = netlist.pins(id)[usize::from(RegisterNode::DATA)];
            if netlist.cell(data).is_some() && !names.stand_ins.contains_key(&data) && !nexts.contains_key(&data) {
                nexts.insert(data, next_name(&netlist.net_name(id)));
                computed.push(data);
            }
        }
        names.nexts = names.nets(&computed, |id| nexts[&id].clone());
        names.others(netlist);
        names
    }

    fn nets(&mut self, ids: &[NetId], name: impl Fn(NetId) -> String) -> Vec<NamedNet> {
        let names: Vec<String> = ids.iter().map(|&id| name(id)).collect();
        let mut net = |Bus { name, bits }: Bus| {
            let name = free(&mut self.taken, word(&name));
            let bits: Vec<_> = bits.into_iter().map(|place| ids[place]).collect();
            for (bit, &id) in bits.iter().enumerate() {
                self.bits.insert(id, NamedBit { net: name.clone(), bit, width: bits.len() });
            }
            NamedNet { name, bits }
        };
        buses(&names, &self.ascending).into_iter().map(&mut net).collect()
    }

    fn others(&mut self, logic: &Netlist) {
        for id in logic.ids().filter(|&id| matches!(logic.node(id), Node::Cell(_) | Node::Wire { .. })) {
            if !self.stand_ins.contains_key(&id) && !self.bits.contains_key(&id) {
                let name = free(&mut self.taken, word(&logic.net_name(id)));
                self.bits.insert(id, NamedBit::alone(name.clone()));
                self.others.push(NamedNet { name, bits: vec![id] });
            }
        }
    }

    pub(super) fn bit(&self, logic: &Netlist, id: NetId) -> NamedBit {
        match logic.node(id) {
            Node::Constant(value) => NamedBit::alone(u8::from(*value).to_string()),
            _ => self.bits[self.stand_ins.get(&id).unwrap_or(&id)].clone(),
        }
    }
}

/// The name of a register's next value: the next values of a bus are a bus.
fn next_name(name: &str) -> String {
    let bit = name.strip_suffix(']').and_then(|name| name.rsplit_once('['));
    bit.map_or_else(|| format!("{name}_next"), |(bus, bit)| format!("{bus}_next[{bit}]"))
}

pub fn is_word(name: &str) -> bool {
    word(name) == name
}

pub(super) fn word(name: &str) -> String {
    let mut word: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if !is_legal(&word) {
        word.insert_str(0, "n_");
    }
    word
}

fn is_legal(word: &str) -> bool {
    match word {
        "async_latch" | "async_register" | "set_reset_latch" | "set_reset_register" => false,
        "and" | "circuit" | "else" | "evolution" | "for" | "if" | "import" | "in" | "init" | "latch" | "library"
        | "log2" | "material" | "nand" | "net" | "nor" | "not" | "or" | "register" | "schedule" | "simulate"
        | "prove" | "stimulus" | "swarm" | "table" | "test" | "then" | "use" | "world" | "xnor" | "xor" => false,
        _ => word.chars().any(|c| c != '_') && !word.starts_with(|c: char| c.is_ascii_digit()),
    }
}
