//! Where the loops of a netlist as written are cut open, and the cells of its mapping that the cuts are.
//!
//! The passes that the mapping ran say it. Nothing depends on whether they are right: a cut with a wrong counterpart
//! makes the proof fail.

use std::collections::{BTreeMap, BTreeSet};

use crate::components::Components;
use crate::loops::Loops;
use crate::passes::{Pass, dissolve_wires};
use crate::{NetId, Netlist, NetlistError, Node};

pub(super) struct LoopCut {
    pub(super) cell: NetId,
    /// None if no output depends on it.
    pub(super) name: Option<String>,
    /// The cell with which the passes have merged it, or itself.
    pub(super) merged: NetId,
}

/// The cuts of a netlist; after these passes its memory has the names that the mapping keeps.
pub(super) fn cuts(netlist: &Netlist, passes: &[Pass]) -> Result<Vec<LoopCut>, NetlistError> {
    if Loops::of(netlist).cores().is_empty() {
        return Ok(Vec::new());
    }
    let mut reduced = netlist.clone();
    let mut merged: BTreeMap<NetId, NetId> = BTreeMap::new();
    for pass in passes {
        merged.extend((pass.merged)(&reduced));
        (pass.run)(&mut reduced)?;
    }
    let names = core_names(&reduced, &Loops::memory(&reduced));
    let cut = |cell: NetId| {
        let merged = std::iter::successors(Some(cell), |id| merged.get(id).copied()).last().expect("there is a first");
        LoopCut { cell, name: names.get(&merged).cloned(), merged }
    };
    let is_cell = |id: &NetId| matches!(netlist.node(*id), Node::Cell(_));
    let mut cuts: Vec<LoopCut> = netlist.ids().filter(is_cell).map(cut).filter(|cut| cut.name.is_some()).collect();
    let known: BTreeSet<NetId> = cuts.iter().map(|cut| cut.cell).collect();
    // Loops that no output depends on. Logic between their registers may drive an output nevertheless.
    let mut plain = netlist.clone();
    dissolve_wires(&mut plain)?;
    let memory = Loops::memory(&plain);
    let parts = Components::new(netlist.graph()).from(netlist.ids(), |id| !known.contains(&id));
    let is_loop = |part: &Vec<NetId>| part.len() > 1 || netlist.graph().contains_edge(part[0], part[0]);
    let lost = parts.into_iter().filter(is_loop).flatten().filter(|id| is_cell(id) && memory.contains(*id));
    cuts.extend(lost.map(cut));
    Ok(cuts)
}

pub(crate) fn core_names(netlist: &Netlist, loops: &Loops) -> BTreeMap<NetId, String> {
    let mut taken = BTreeSet::new();
    let cells = netlist.ids().filter(|&id| loops.contains(id) && matches!(netlist.node(id), Node::Cell(_)));
    cells
        .map(|id| {
            let name = netlist.net_name(id);
            let numbered = (2..).map(|i| format!("{name}_{i}"));
            let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
            let free = free.expect("there are more numbers than cells");
            taken.insert(free.clone());
            (id, free)
        })
        .collect()
}
