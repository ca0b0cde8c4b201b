//! Start values of the cells on loops.

use std::collections::BTreeMap;

use crate::{Logic, Loops, NetId, Netlist};

/// The value before the first cycle of every cell of a memory element.
pub(super) fn starts(netlist: &Netlist) -> BTreeMap<NetId, bool> {
    let memory = Loops::memory(netlist).cores().concat();
    let own = |id: NetId| netlist.cell(id).and_then(|cell| cell.start);
    if memory.iter().all(|&id| own(id).is_some()) {
        return memory.into_iter().filter_map(|id| Some((id, own(id)?))).collect();
    }
    let before = Logic::new(netlist);
    memory.into_iter().map(|id| (id, before.value(id))).collect()
}
