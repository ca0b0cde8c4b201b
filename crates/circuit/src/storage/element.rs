//! The memory elements of a netlist: the shortest loops through the cells with a start value.

use std::collections::{BTreeMap, BTreeSet};

use crate::loops::Loops;
use crate::{NetId, Netlist, Node};

/// The most cells of a shortest loop.
const MOST_STEPS: usize = 32;
const MOST_VISITS: usize = 1024;

/// Those of the cells that are not `lowered`.
///
/// Every loop through several elements is longer than theirs, because it passes their guards too; so each element is a
/// shortest loop, whatever the functions of the library. Elements that share cells are one.
pub(super) fn elements(netlist: &Netlist, loops: &Loops, lowered: &BTreeSet<NetId>) -> Vec<Vec<NetId>> {
    let is_written = |id: NetId| !lowered.contains(&id);
    let starts = netlist.cells().filter(|(id, cell)| cell.start.is_some() && loops.contains(*id) && is_written(*id));
    let mut element_of: BTreeMap<NetId, usize> = BTreeMap::new();
    let mut elements: Vec<Vec<NetId>> = Vec::new();
    for (start, _) in starts {
        let cycle = shortest_loop(netlist, start, is_written);
        let found: Vec<usize> = cycle.iter().filter_map(|id| element_of.get(id).copied()).collect();
        let own = found.iter().copied().min().unwrap_or(elements.len());
        if own == elements.len() {
            elements.push(Vec::new());
        }
        let merged = found.into_iter().filter(|&other| other != own).collect::<BTreeSet<_>>();
        let others: Vec<NetId> = merged.into_iter().flat_map(|other| std::mem::take(&mut elements[other])).collect();
        for id in cycle.into_iter().chain(others) {
            if element_of.insert(id, own) != Some(own) {
                elements[own].push(id);
            }
        }
    }
    elements.iter_mut().for_each(|element| element.sort_unstable());
    elements.into_iter().filter(|element| !element.is_empty()).collect()
}

/// The cells `inside` of the shortest loop through `start`; only `start` if there is no short loop.
pub(super) fn shortest_loop(netlist: &Netlist, start: NetId, inside: impl Fn(NetId) -> bool) -> Vec<NetId> {
    let mut from: BTreeMap<NetId, NetId> = BTreeMap::new();
    let mut level = vec![start];
    for _ in 0..MOST_STEPS {
        let mut next = Vec::new();
        for &at in &level {
            for (listener, _) in netlist.fanout(at) {
                if listener == start {
                    return std::iter::successors(Some(at), |id| from.get(id).copied()).collect();
                }
                if matches!(netlist.node(listener), Node::Cell(_)) && inside(listener) && !from.contains_key(&listener)
                {
                    from.insert(listener, at);
                    next.push(listener);
                }
            }
        }
        if next.is_empty() || from.len() > MOST_VISITS {
            break;
        }
        level = next;
    }
    vec![start]
}
