//! Names of nets in files: unique, and valid in the format; and start values of cells.

use std::collections::{BTreeMap, BTreeSet};

use crate::formats::Design;
use crate::{Logic, Loops, NetId, Netlist, Node, RegisterNode};

pub struct FileNames {
    nets: BTreeMap<NetId, String>,
}

impl FileNames {
    /// `legal` turns a name into a valid one of the format, and `kept` are reserved words.
    /// Names are assigned first to ports, then to clocks that are not ports, then to registers and to the cells that
    /// compute their data, then to the others. An output that is the input of its name gets another name, unless the
    /// format has them `apart`.
    pub fn new(design: &Design, kept: &[&str], apart: bool, legal: impl Fn(&str) -> String) -> Self {
        let netlist = &design.netlist;
        let mut taken: BTreeSet<String> = kept.iter().map(|&word| word.to_owned()).collect();
        let mut nets = BTreeMap::new();
        for &id in design.ports().iter().chain(netlist.outputs()) {
            let wish = netlist.net_name(id);
            let driver = netlist.pins(id).first().copied().filter(|_| apart);
            let known = driver.filter(|driver| design.ports().contains(driver) && netlist.net_name(*driver) == wish);
            let name = known.and_then(|input| nets.get(&input).cloned());
            nets.insert(id, name.unwrap_or_else(|| free(&mut taken, legal(&wish))));
        }
        let own_clocks = design.own_clocks().iter().map(|&id| (id, netlist.net_name(id)));
        let registers = netlist.registers().map(|(id, _)| (id, netlist.net_name(id)));
        let others = netlist.ids().filter(|&id| matches!(netlist.node(id), Node::Cell(_) | Node::Wire { .. }));
        let others = others.map(|id| (id, netlist.net_name(id)));
        for (id, wish) in own_clocks.chain(registers).chain(nexts(netlist)).chain(others) {
            nets.entry(id).or_insert_with(|| free(&mut taken, legal(&wish)));
        }
        Self { nets }
    }

    pub fn net(&self, id: NetId) -> &str {
        &self.nets[&id]
    }
}

/// The cells without names that compute the data of registers, each with the name of the first such register.
pub(super) fn nexts(netlist: &Netlist) -> Vec<(NetId, String)> {
    let data = |(id, _)| (netlist.pins(id)[usize::from(RegisterNode::DATA)], format!("{}_next", netlist.net_name(id)));
    let is_free = |id: NetId| netlist.cell(id).is_some() && !netlist.is_named(id);
    netlist.registers().map(data).filter(|&(id, _)| is_free(id)).collect()
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

/// For each cell or register that drives a port, the output that names it: the first.
pub fn stand_ins(netlist: &Netlist) -> BTreeMap<NetId, NetId> {
    let mut stand_ins = BTreeMap::new();
    for &output in netlist.outputs() {
        let driver = netlist.pins(output)[0];
        if matches!(netlist.node(driver), Node::Cell(_) | Node::Register(_)) {
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
        let names = FileNames::new(&Design::new(netlist), &["_"], true, |name| visible(name, &[]));
        assert_eq!([a, b, gate, output].map(|id| names.net(id)), ["a_b", "a_b_1", "a_b_2", "__1"]);
    }

    #[test]
    fn an_output_that_is_an_input_keeps_its_name_where_the_format_permits() {
        let mut netlist = Netlist::new("m");
        let [a, b] = ["a", "b"].map(|name| netlist.add_input(name));
        let outputs = [("a", a), ("a", b), ("b", a)].map(|(name, net)| netlist.add_output(name, net));
        for (apart, expected) in [(true, ["a", "a_1", "b_1"]), (false, ["a_1", "a_2", "b_1"])] {
            let names = FileNames::new(&Design::new(netlist.clone()), &[], apart, str::to_owned);
            assert_eq!(outputs.map(|id| names.net(id)), expected);
        }
    }
}
