//! Levels: the number of cells between the inputs and a net. A loop core has the level of its latest driver.

use std::collections::BTreeMap;

use crate::loops::Loops;
use crate::{NetId, Netlist, Node};

/// The level of every net: 0 for inputs and constants, else one more than its latest pin.
pub(crate) fn levelize(netlist: &Netlist) -> BTreeMap<NetId, u32> {
    most_before(netlist, |id| matches!(netlist.node(id), Node::Cell(_)))
}

/// For every net, the most nodes that count on a path to it and including it. The nodes of a loop core are alike.
pub(crate) fn most_before(netlist: &Netlist, counts: impl Fn(NetId) -> bool) -> BTreeMap<NetId, u32> {
    let loops = Loops::through_registers(netlist);
    let mut levels = BTreeMap::new();
    for &id in loops.order() {
        let members = loops.core_of(id).map_or(std::slice::from_ref(&id), |core| &loops.cores()[core]);
        let pins = members.iter().flat_map(|&member| netlist.pins(member)).filter(|pin| !members.contains(pin));
        let latest = pins.map(|pin| levels.get(&pin).copied().unwrap_or(0)).max().unwrap_or(0);
        levels.insert(id, latest + u32::from(counts(id)));
    }
    levels
}

pub fn depth(netlist: &Netlist) -> u32 {
    let levels = levelize(netlist);
    netlist.outputs().iter().map(|id| levels[id]).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{full_adder, latch};

    #[test]
    fn a_full_adder_has_three_levels_and_a_latch_too() {
        assert_eq!(depth(&full_adder()), 3);
        let mut netlist = latch();
        crate::passes::run(&mut netlist).unwrap();
        assert_eq!(depth(&netlist), 3);
    }
}
