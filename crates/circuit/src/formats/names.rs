//! Names of nets in files: unique, and valid in the format; and start values of cells.

use std::collections::{BTreeMap, BTreeSet};

use crate::formats::{Design, Register};
use crate::{Logic, Loops, NetId, Netlist, Node};

pub struct FileNames {
    nets: BTreeMap<NetId, String>,
    /// The nets that clock registers, by the names that the registers have for them.
    clocked: BTreeMap<String, NetId>,
    clocks: BTreeMap<String, String>,
}

pub enum ClockName<'n> {
    Net(NetId),
    Own(&'n str),
}

impl FileNames {
    /// `legal` turns a name into a valid one of the format, and `kept` are reserved words.
    /// Names are assigned first to ports, then to clocks that are not ports, then to the values of registers and to the
    /// outputs for them (the last inputs and outputs), then to cells. An output that is the input of its name gets
    /// another name, unless the format has them `apart`.
    pub fn new(
        netlist: &Netlist,
        registers: &[Register],
        kept: &[&str],
        apart: bool,
        legal: impl Fn(&str) -> String,
    ) -> Self {
        let mut taken: BTreeSet<String> = kept.iter().map(|&word| word.to_owned()).collect();
        let mut nets = BTreeMap::new();
        let (inputs, states) = netlist.inputs().split_at(netlist.inputs().len() - registers.len());
        let (outputs, nexts) = netlist.outputs().split_at(netlist.outputs().len() - Register::outputs(registers));
        for &id in inputs.iter().chain(outputs) {
            let wish = netlist.net_name(id);
            let driver = netlist.pins(id).first().copied().filter(|_| apart);
            let known = driver.filter(|driver| inputs.contains(driver) && netlist.net_name(*driver) == wish);
            let name = known.and_then(|input| nets.get(&input).cloned());
            nets.insert(id, name.unwrap_or_else(|| free(&mut taken, legal(&wish))));
        }
        let wanted: BTreeSet<&String> = registers.iter().filter_map(|register| register.clock.as_ref()).collect();
        let sources = || inputs.iter().chain(states);
        let source = |clock: &&String| sources().copied().find(|&id| netlist.net_name(id) == **clock);
        let clocked = wanted.iter().filter_map(|clock| Some(((*clock).clone(), source(clock)?))).collect();
        let own = wanted.iter().filter(|clock| source(clock).is_none());
        let clocks = own.map(|clock| ((*clock).clone(), free(&mut taken, legal(clock)))).collect();
        let others = netlist.ids().filter(|&id| matches!(netlist.node(id), Node::Cell(_) | Node::Wire { .. }));
        for id in states.iter().chain(nexts).copied().chain(others) {
            nets.insert(id, free(&mut taken, legal(&netlist.net_name(id))));
        }
        Self { nets, clocked, clocks }
    }

    pub fn net(&self, id: NetId) -> &str {
        &self.nets[&id]
    }

    pub fn own_clocks(&self) -> impl Iterator<Item = &str> {
        self.clocks.values().map(String::as_str)
    }

    pub fn clock(&self, register: &Register) -> Option<ClockName<'_>> {
        let clock = register.clock.as_ref()?;
        let net = self.clocked.get(clock).map(|&id| ClockName::Net(id));
        net.or_else(|| self.clocks.get(clock).map(|name| ClockName::Own(name)))
    }
}

pub(super) fn free(taken: &mut BTreeSet<String>, wish: String) -> String {
    let numbered = (1..).map(|i| format!("{wish}_{i}"));
    let name = std::iter::once(wish.clone()).chain(numbered).find(|name| !taken.contains(name));
    let name = name.expect("there are more numbers than nets");
    taken.insert(name.clone());
    name
}

pub fn visible(name: &str, unreadable: &[char]) -> String {
    let readable = |c: char| c.is_ascii_graphic() && !unreadable.contains(&c);
    let visible: String = name.chars().map(|c| if readable(c) { c } else { '_' }).collect();
    if visible.is_empty() { "_".to_owned() } else { visible }
}

/// For each cell or register value that drives a port or a next value, the output that names it: the first.
pub fn stand_ins(design: &Design) -> BTreeMap<NetId, NetId> {
    let netlist = &design.logic;
    let mut stand_ins = BTreeMap::new();
    let states = &netlist.inputs()[design.inputs()..];
    for &output in &netlist.outputs()[..design.outputs() + design.registers.len()] {
        let driver = netlist.pins(output)[0];
        if matches!(netlist.node(driver), Node::Cell(_)) || states.contains(&driver) {
            stand_ins.entry(driver).or_insert(output);
        }
    }
    stand_ins
}

pub fn cells_in_order(netlist: &Netlist) -> Vec<NetId> {
    let loops = Loops::of(netlist);
    loops.order().iter().copied().filter(|&id| matches!(netlist.node(id), Node::Cell(_))).collect()
}

pub(super) fn starts(netlist: &Netlist) -> BTreeMap<NetId, bool> {
    let memory = Loops::memory(netlist).cores().concat();
    let own = |id: NetId| netlist.cell(id).and_then(|cell| cell.start);
    if memory.iter().all(|&id| own(id).is_some()) {
        return memory.into_iter().filter_map(|id| Some((id, own(id)?))).collect();
    }
    let before = Logic::new(netlist);
    memory.into_iter().map(|id| (id, before.value(id))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Function;

    #[test]
    fn equal_names_are_numbered() {
        let mut netlist = Netlist::new("m");
        let a = netlist.add_input("a b");
        let b = netlist.add_input("a_b");
        let gate = netlist.add_gate(Function::AND, &[a, b]);
        netlist.rename(gate, "a\u{1b}b");
        let output = netlist.add_output("", gate);
        let names = FileNames::new(&netlist, &[], &["_"], true, |name| visible(name, &[]));
        assert_eq!([a, b, gate, output].map(|id| names.net(id)), ["a_b", "a_b_1", "a_b_2", "__1"]);
    }

    #[test]
    fn an_output_that_is_an_input_keeps_its_name_where_the_format_permits() {
        let mut netlist = Netlist::new("m");
        let [a, b] = ["a", "b"].map(|name| netlist.add_input(name));
        let outputs = [("a", a), ("a", b), ("b", a)].map(|(name, net)| netlist.add_output(name, net));
        for (apart, expected) in [(true, ["a", "a_1", "b_1"]), (false, ["a_1", "a_2", "b_1"])] {
            let names = FileNames::new(&netlist, &[], &[], apart, str::to_owned);
            assert_eq!(outputs.map(|id| names.net(id)), expected);
        }
    }
}
