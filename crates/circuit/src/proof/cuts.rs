//! Where a netlist as written is cut open, at its registers and in its loops, and what the cuts are in its mapping.
//!
//! The passes that the mapping ran say it. Nothing depends on whether they are right: a cut with a wrong counterpart
//! makes the proof fail.

use std::collections::{BTreeMap, BTreeSet};

use crate::components::Components;
use crate::loops::Loops;
use crate::lowering::gate_data;
use crate::passes::{Pass, dissolve_wires};
use crate::{NetId, Netlist, NetlistError, Node};

/// A register, or a cell of a loop.
pub(super) struct StateCut {
    pub(super) net: NetId,
    /// None if no output depends on it.
    pub(super) name: Option<String>,
    /// The one with which the passes have merged it, or itself.
    pub(super) merged: NetId,
}

/// The cuts of a netlist; after these passes its state has the names that the mapping keeps.
pub(super) fn cuts(netlist: &Netlist, passes: &[Pass]) -> Result<Vec<StateCut>, NetlistError> {
    if Loops::through_registers(netlist).cores().is_empty() && netlist.registers().next().is_none() {
        return Ok(Vec::new());
    }
    let mut reduced = netlist.clone();
    gate_data(&mut reduced);
    let mut merged: BTreeMap<NetId, NetId> = BTreeMap::new();
    for pass in passes {
        merged.extend((pass.merged)(&reduced));
        (pass.run)(&mut reduced)?;
    }
    let names = state_names(&reduced, &Loops::memory(&reduced));
    let cut = |net: NetId| {
        let merged = std::iter::successors(Some(net), |id| merged.get(id).copied()).last().expect("there is a first");
        StateCut { net, name: names.get(&merged).cloned(), merged }
    };
    let is_cell = |id: &NetId| matches!(netlist.node(*id), Node::Cell(_));
    let is_register = |net: NetId| netlist.register(net).is_some();
    let all = netlist.ids().filter(|id| is_cell(id) || is_register(*id)).map(cut);
    let mut cuts: Vec<StateCut> = all.filter(|cut| cut.name.is_some() || is_register(cut.net)).collect();
    let known: BTreeSet<NetId> = cuts.iter().map(|cut| cut.net).collect();
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

/// The names of registers and of cells of loops, each once.
pub(crate) fn state_names(netlist: &Netlist, loops: &Loops) -> BTreeMap<NetId, String> {
    let mut taken = BTreeSet::new();
    let is_state = |id: &NetId| match netlist.node(*id) {
        Node::Cell(_) => loops.contains(*id),
        node => matches!(node, Node::Register(_)),
    };
    let states = netlist.ids().filter(is_state);
    states
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
