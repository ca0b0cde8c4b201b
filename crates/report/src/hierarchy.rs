//! The parts of a circuit, each small enough to be seen at once: the calls of the source, opened where they are small
//! and divided where they are large.

use std::collections::{BTreeMap, BTreeSet};

use nbc_circuit::{BlockId, NetId, Netlist, Node};

use crate::net_names::{NetNames, Word, call_name, distinct_names, written};

/// A part with at most this many cells has no parts in it.
const FLAT: usize = 25;
/// A call with at most so many cells is no part of its own; one with `SMALL` only if there is no room for its cells.
const FEW: usize = 2;
const SMALL: usize = 8;
const ROOM: usize = 30;
const MOST: usize = 40;
const DIVISION: usize = 24;

#[derive(Clone, Debug, Default)]
pub struct CircuitPart {
    pub name: String,
    pub circuit: Option<String>,
    pub outer: Option<usize>,
    pub cells: Vec<NetId>,
    pub inner: Vec<usize>,
    pub size: usize,
}

#[derive(Clone, Debug)]
pub struct Hierarchy {
    /// The whole circuit first, each part after the one around it.
    pub parts: Vec<CircuitPart>,
    pub home: BTreeMap<NetId, usize>,
}

#[derive(Clone, Copy, Debug)]
enum Item {
    Cell(NetId),
    Part(usize),
}

impl Item {
    fn part(self) -> Option<usize> {
        match self {
            Self::Part(inner) => Some(inner),
            Self::Cell(_) => None,
        }
    }
}

impl Hierarchy {
    pub fn of(netlist: &Netlist) -> Self {
        let mut tree = Tree::of(netlist);
        tree.dissolve_small();
        tree.divide_large(&ranks(netlist), &NetNames::of(netlist));
        tree.finish()
    }

    pub fn path(&self, part: usize) -> Vec<usize> {
        path_of(&self.parts, part)
    }

    /// Its circuit and the name of its call; the name first for a register, or beside a part of the same circuit.
    pub fn titles(&self, part: usize) -> (&str, Option<&str>) {
        let CircuitPart { name, circuit, outer, .. } = &self.parts[part];
        let Some(circuit) = circuit.as_deref() else { return (name, None) };
        let (circuit, call) = (written(circuit), call_name(name, circuit));
        if call == circuit {
            return (circuit, None);
        }
        let beside = outer.iter().flat_map(|&outer| &self.parts[outer].inner);
        let same = beside.filter(|&&other| self.parts[other].circuit.as_deref().map(written) == Some(circuit)).count();
        if same > 1 || nbc_circuit::keeps_state(circuit) { (call, Some(circuit)) } else { (circuit, Some(call)) }
    }

    pub fn inside(&self, part: usize) -> BTreeMap<NetId, Option<usize>> {
        let mut inside: BTreeMap<NetId, Option<usize>> =
            self.parts[part].cells.iter().map(|&cell| (cell, None)).collect();
        for &inner in &self.parts[part].inner {
            let mut open = vec![inner];
            while let Some(at) = open.pop() {
                inside.extend(self.parts[at].cells.iter().map(|&cell| (cell, Some(inner))));
                open.extend(&self.parts[at].inner);
            }
        }
        inside
    }
}

struct Tree {
    parts: Vec<CircuitPart>,
}

impl Tree {
    fn of(netlist: &Netlist) -> Self {
        let mut tree = Self { parts: vec![CircuitPart { name: netlist.name.clone(), ..CircuitPart::default() }] };
        let mut known = BTreeMap::from([(BlockId::TOP, 0)]);
        for id in netlist.ids().filter(|&id| is_shown(netlist, id)) {
            let mut at = 0;
            for block in netlist.blocks().around(netlist.block(id)) {
                at = *known.entry(block).or_insert_with(|| {
                    let name = netlist.blocks().name(block).to_owned();
                    let circuit = Some(netlist.blocks().circuit(block).to_owned());
                    tree.add(CircuitPart { name, circuit, outer: Some(at), ..CircuitPart::default() })
                });
            }
            tree.parts[at].cells.push(id);
        }
        for at in (0..tree.parts.len()).rev() {
            tree.parts[at].size += tree.parts[at].cells.len();
            if let Some(outer) = tree.parts[at].outer {
                tree.parts[outer].size += tree.parts[at].size;
            }
        }
        tree
    }

    fn add(&mut self, part: CircuitPart) -> usize {
        let (at, outer) = (self.parts.len(), part.outer);
        self.parts.push(part);
        if let Some(outer) = outer {
            self.parts[outer].inner.push(at);
        }
        at
    }

    fn items(&self, part: usize) -> usize {
        self.parts[part].cells.len() + self.parts[part].inner.len()
    }

    fn dissolve_small(&mut self) {
        for at in (1..self.parts.len()).rev() {
            let outer = self.parts[at].outer.expect("only the first part has none around it");
            let together = self.items(outer) + self.items(at) - 1;
            let is_small = self.parts[at].size <= SMALL && together <= ROOM;
            let is_alone = self.items(outer) == 1;
            if self.parts[at].size > FEW && self.parts[outer].size > FLAT && !is_small && !is_alone {
                continue;
            }
            let part = std::mem::take(&mut self.parts[at]);
            part.inner.iter().for_each(|&inner| self.parts[inner].outer = Some(outer));
            let around = &mut self.parts[outer];
            around.inner.retain(|&inner| inner != at);
            around.inner.extend(part.inner);
            around.cells.extend(part.cells);
        }
    }

    /// What is connected stays together.
    fn divide_large(&mut self, ranks: &BTreeMap<NetId, usize>, nets: &NetNames<'_>) {
        let first: Vec<usize> = self.first_ranks(ranks);
        for at in 0..first.len() {
            while self.items(at) > MOST {
                self.divide(at, ranks, &first, nets);
            }
        }
    }

    fn first_ranks(&self, ranks: &BTreeMap<NetId, usize>) -> Vec<usize> {
        let own = |part: &CircuitPart| part.cells.iter().map(|cell| ranks[cell]).min().unwrap_or(usize::MAX);
        let mut first: Vec<usize> = self.parts.iter().map(own).collect();
        for at in (1..first.len()).rev() {
            if let Some(outer) = self.parts[at].outer {
                first[outer] = first[outer].min(first[at]);
            }
        }
        first
    }

    fn divide(&mut self, at: usize, ranks: &BTreeMap<NetId, usize>, first: &[usize], nets: &NetNames<'_>) {
        let part = &mut self.parts[at];
        let cells = std::mem::take(&mut part.cells).into_iter().map(|cell| (ranks[&cell], Item::Cell(cell)));
        let inner = std::mem::take(&mut part.inner).into_iter();
        // Divisions of a division are in order already.
        let rank = |inner: usize| first.get(inner).copied().unwrap_or(inner);
        let mut items: Vec<(usize, Item)> = cells.chain(inner.map(|inner| (rank(inner), Item::Part(inner)))).collect();
        items.sort_by_key(|(rank, _)| *rank);
        let count = items.len().div_ceil(DIVISION);
        let chunks: Vec<&[(usize, Item)]> = items.chunks(items.len().div_ceil(count)).collect();
        let words = chunks.iter().map(|items| self.words(at, items, nets)).collect::<Vec<_>>();
        for (name, items) in distinct_names(&words).into_iter().zip(chunks) {
            let division = self.add(CircuitPart { name, outer: Some(at), ..CircuitPart::default() });
            for &(_, item) in items {
                match item {
                    Item::Cell(cell) => self.parts[division].cells.push(cell),
                    Item::Part(inner) => {
                        self.parts[inner].outer = Some(division);
                        self.parts[division].inner.push(inner);
                    }
                }
            }
            let inside: usize = self.parts[division].inner.iter().map(|&inner| self.parts[inner].size).sum();
            self.parts[division].size = inside + self.parts[division].cells.len();
        }
    }

    fn words(&self, at: usize, items: &[(usize, Item)], nets: &NetNames<'_>) -> Vec<Word> {
        let named = |inner: usize| {
            let CircuitPart { name, circuit, .. } = &self.parts[inner];
            circuit.as_deref().map_or(name.as_str(), |circuit| call_name(name, circuit))
        };
        let parts: Vec<&str> = items.iter().filter_map(|(_, item)| item.part()).map(named).collect();
        if let [first, .., last] = parts[..]
            && parts.len() == items.len()
            && first != last
        {
            return vec![Word::new(format!("{first} to {last}"))];
        }
        let calls: Vec<&str> = path_of(&self.parts, at)
            .into_iter()
            .filter(|&part| self.parts[part].circuit.is_some())
            .map(|part| self.parts[part].name.as_str())
            .collect();
        let mut words: BTreeMap<String, Word> = BTreeMap::new();
        for (_, item) in items {
            let (name, place, robots) = match item {
                Item::Part(inner) => (named(*inner).to_owned(), None, self.parts[*inner].size),
                Item::Cell(cell) => {
                    let (name, place) = nets.within(*cell, &calls);
                    (name, place, 1)
                }
            };
            words.entry(name.clone()).or_insert_with(|| Word::new(name)).count(robots, place);
        }
        let mut words: Vec<Word> = words.into_values().collect();
        words.sort_by_key(Word::order);
        words
    }

    fn finish(mut self) -> Hierarchy {
        let mut order = vec![0];
        let mut at = 0;
        while at < order.len() {
            self.parts[order[at]].inner.sort_unstable();
            order.extend(&self.parts[order[at]].inner);
            at += 1;
        }
        let number: BTreeMap<usize, usize> = order.iter().enumerate().map(|(new, &old)| (old, new)).collect();
        let mut home = BTreeMap::new();
        let mut parts = Vec::new();
        for &old in &order {
            let mut part = std::mem::take(&mut self.parts[old]);
            part.outer = part.outer.map(|outer| number[&outer]);
            part.inner.iter_mut().for_each(|inner| *inner = number[inner]);
            part.cells.sort_unstable();
            home.extend(part.cells.iter().map(|&cell| (cell, parts.len())));
            parts.push(part);
        }
        Hierarchy { parts, home }
    }
}

fn is_shown(netlist: &Netlist, id: NetId) -> bool {
    matches!(netlist.node(id), Node::Cell(_) | Node::Register(_) | Node::Wire { .. })
}

fn path_of(parts: &[CircuitPart], part: usize) -> Vec<usize> {
    let mut path: Vec<usize> = std::iter::successors(Some(part), |&at| parts[at].outer).collect();
    path.pop();
    path.reverse();
    path
}

/// An order in which each comes soon after those it reads: a search from the outputs against the wires.
fn ranks(netlist: &Netlist) -> BTreeMap<NetId, usize> {
    let mut ranks = BTreeMap::new();
    let mut seen = BTreeSet::new();
    for root in netlist.outputs().iter().copied().chain(netlist.ids()) {
        let mut stack = vec![(root, false)];
        while let Some((id, is_left)) = stack.pop() {
            if is_left {
                ranks.insert(id, ranks.len());
            } else if seen.insert(id) {
                stack.push((id, true));
                stack.extend(netlist.pins(id).into_iter().rev().map(|pin| (pin, false)));
            }
        }
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::Function;

    fn chains(count: usize, length: usize) -> Netlist {
        let mut netlist = Netlist::new("chains");
        let mut net = netlist.add_input("a");
        for call in 0..count {
            let block = netlist.blocks_mut().add(format!("c[{call}]"), "chain", BlockId::TOP);
            for _ in 0..length {
                net = netlist.add_gate(Function::NOT, &[net]);
                netlist.put_into(net, block);
            }
        }
        netlist.add_output("q", net);
        netlist
    }

    fn check(count: usize, length: usize) -> Hierarchy {
        let netlist = chains(count, length);
        let hierarchy = Hierarchy::of(&netlist);
        assert_eq!(hierarchy.parts[0].size, count * length);
        assert_eq!(hierarchy.home.len(), count * length);
        for (at, part) in hierarchy.parts.iter().enumerate() {
            assert!(part.cells.len() + part.inner.len() <= MOST, "{part:?}");
            assert!(part.inner.iter().all(|&inner| inner > at && hierarchy.parts[inner].outer == Some(at)));
            let inside: usize = part.inner.iter().map(|&inner| hierarchy.parts[inner].size).sum();
            assert_eq!(part.size, inside + part.cells.len());
        }
        hierarchy
    }

    #[test]
    fn calls_are_parts_where_there_are_many_cells() {
        assert_eq!(check(2, 10).parts.len(), 1, "20 cells are seen at once");
        let few = check(4, 10);
        assert_eq!(few.parts[0].inner.len(), 4);
        assert_eq!(few.path(2), [2]);
        assert_eq!(few.titles(2), ("c[1]", Some("chain")), "other parts are calls of the same circuit");
    }

    #[test]
    fn a_call_alone_is_no_part() {
        assert_eq!(check(1, 30).parts.len(), 1);
    }

    #[test]
    fn small_calls_are_no_parts() {
        assert_eq!(check(15, 2).parts.len(), 1);
    }

    #[test]
    fn a_division_is_named_for_what_most_of_its_robots_are_of() {
        let mut netlist = chains(10, 30);
        let mut net = netlist.inputs()[0];
        for place in 0..60 {
            net = netlist.add_gate(Function::NOT, &[net]);
            netlist.rename(net, &format!("carry[{place}]"));
        }
        netlist.add_output("last", net);
        let hierarchy = Hierarchy::of(&netlist);
        let names: Vec<&str> = hierarchy.parts[0].inner.iter().map(|&inner| hierarchy.titles(inner).0).collect();
        assert_eq!(names, ["c[0], c[1]", "carry[37..14]", "carry[59..38]"]);
    }

    fn calls(called: &[(&str, &str)]) -> Hierarchy {
        let mut netlist = chains(0, 0);
        let mut net = netlist.inputs()[0];
        for (name, circuit) in called {
            let block = netlist.blocks_mut().add(*name, *circuit, BlockId::TOP);
            for _ in 0..10 {
                net = netlist.add_gate(Function::NOT, &[net]);
                netlist.put_into(net, block);
            }
        }
        netlist.add_output("last", net);
        Hierarchy::of(&netlist)
    }

    #[test]
    fn a_call_is_called_as_its_circuit_where_that_is_enough() {
        let called = [
            ("pc", "machine"),
            ("a", "register"),
            ("equal_1", "equal"),
            ("x", "half"),
            ("s", "prelude.add"),
            ("y", "half"),
        ];
        let hierarchy = calls(&called);
        let titles: Vec<(&str, Option<&str>)> =
            hierarchy.parts[0].inner.iter().map(|&inner| hierarchy.titles(inner)).collect();
        assert_eq!(
            titles,
            [
                ("machine", Some("pc")),
                ("a", Some("register")),
                ("equal", None),
                ("x", Some("half")),
                ("add", Some("s")),
                ("y", Some("half"))
            ]
        );
    }

    #[test]
    fn large_parts_are_divided_in_order() {
        let many = check(60, 30);
        assert_eq!(many.parts[0].inner.len(), 3);
        assert_eq!(many.parts[1].name, "c[0] to c[19]");
        let flat = check(1, 2_000);
        assert!(flat.parts[1].name.starts_with("c[0]"), "{:?}", flat.parts[1].name);
        assert!(flat.parts.len() > 80 && flat.parts[0].inner.len() <= MOST);
    }
}
