//! Loops of cells that are latches of one bit, as registers. A circuit that was written as cells has steps and
//! properties as one with registers, and a mapped one can be compared with its source.

use std::collections::BTreeMap;

use crate::cells::CellKind;
use crate::passes::{dissolve_wires, sweep, turn_clocks};
use crate::register::{Forcing, RegisterKind};
use crate::storage::{Follower, Inverters, Latch, Storage};
use crate::{Logic, NetId, Netlist, NetlistError, Node, RegisterNode};
use nbc_base::model::Function;

/// The cells of memory do not glitch: whether those of robots do is for timing to say.
const KIND: CellKind = CellKind::uniform(1, 1.0);

pub(crate) struct Raised {
    /// Without wires. Latches of one bit are registers, be they open for 1 or 0.
    pub netlist: Netlist,
    /// A cell of each latch that has stayed, because its cells have start values that contradict each other.
    pub contradicting: Vec<NetId>,
}

impl Raised {
    pub fn of(netlist: &Netlist) -> Self {
        let mut made = netlist.clone();
        let storage = Storage::of(netlist, |_| &KIND);
        let mut contradicting = Vec::new();
        if !storage.latches.is_empty() {
            let inverters = Inverters::of(netlist);
            let before = Logic::new(netlist);
            let mut shown: Vec<(NetId, NetId)> = Vec::new();
            for latch in &storage.latches {
                match Follower::of(netlist, &inverters, latch)
                    .map(|follower| raise(&mut made, &before, latch, &follower))
                {
                    Some(Ok(nets)) => shown.extend(nets),
                    Some(Err(net)) => contradicting.push(net),
                    None => {}
                }
            }
            // Now that every register is there, which may read cells of another latch.
            shown.into_iter().for_each(|(cell, net)| made.move_listeners(cell, net));
        }
        turn_clocks(&mut made);
        sweep(&mut made);
        Self { netlist: made, contradicting }
    }
}

/// A netlist without wires in which latches that were written as cells are registers.
pub fn latches_as_registers(netlist: &Netlist) -> Result<Netlist, NetlistError> {
    let mut plain = netlist.clone();
    dissolve_wires(&mut plain)?;
    Ok(Raised::of(&plain).netlist)
}

/// Adds the register, and returns for each cell of the latch the net that shows the same.
fn raise(made: &mut Netlist, before: &Logic, latch: &Latch, follower: &Follower) -> Result<Vec<(NetId, NetId)>, NetId> {
    // The cell that the source names, and not its opposite inside the latch, is the bit of the state.
    let mut cells = follower.cells.clone();
    cells.sort_by_key(|(id, _)| made.net_name(*id).len());
    let (shown, named) = cells[0];
    let start = before.value(shown);
    if cells.iter().any(|&(cell, opposite)| before.value(cell) != (start != (opposite != named))) {
        return Err(shown);
    }
    let (name, span) = made.cell(shown).map(|cell| (cell.name.clone(), cell.span)).unwrap_or_default();
    let name = Some(name.unwrap_or_else(|| made.net_name(shown)));
    let kind = if latch.open { RegisterKind::High } else { RegisterKind::Low };
    let register = RegisterNode { kind, forcing: Forcing::Never, start: Some(start), name, span };
    let id = made.add_loose_register(register);
    made.put_into(id, made.block(shown));
    let data = if named { made.add_gate(Function::NOT, &[follower.data]) } else { follower.data };
    (0..).zip([data, latch.root]).for_each(|(pin, net)| made.connect(id, pin, net));
    let shows = |(cell, opposite)| (cell, if opposite == named { id } else { made.add_gate(Function::NOT, &[id]) });
    Ok(cells.into_iter().map(shows).collect())
}

/// Two latches that open in turn, of which the second takes only the state of the first and nothing else reads that,
/// are a register of an edge. Any two neighbors in a chain are such a pair, so the edge of more pairs counts first;
/// between equals it is the rise.
pub(crate) fn pair_latches(netlist: &mut Netlist) {
    let inverters = Inverters::of(netlist);
    let pairs: Vec<LatchPair> =
        netlist.registers().filter_map(|(second, _)| LatchPair::of(netlist, &inverters, second)).collect();
    let mut counts: BTreeMap<(NetId, bool), usize> = BTreeMap::new();
    pairs.iter().for_each(|pair| *counts.entry((pair.clock, pair.rises)).or_insert(0) += 1);
    let mut ordered: Vec<&LatchPair> = pairs.iter().collect();
    let count = |pair: &LatchPair| counts[&(pair.clock, pair.rises)];
    ordered.sort_by_key(|pair| (std::cmp::Reverse((count(pair), pair.rises)), pair.second));
    for pair in ordered {
        let is_latch = |id| netlist.register(id).is_some_and(|register| !register.kind.is_edge());
        if !is_latch(pair.first) || !is_latch(pair.second) {
            continue;
        }
        let data = netlist.pins(pair.first)[0];
        let data = if pair.is_opposite { netlist.add_gate(Function::NOT, &[data]) } else { data };
        netlist.drive(pair.second, RegisterNode::DATA, data);
        if let Node::Register(register) = netlist.node_mut(pair.second) {
            register.kind = if pair.rises { RegisterKind::Rising } else { RegisterKind::Falling };
        }
        // It stays without listeners, and no edge pairs with it.
        if let Node::Register(register) = netlist.node_mut(pair.first) {
            register.kind = RegisterKind::Rising;
        }
    }
    sweep(netlist);
}

struct LatchPair {
    first: NetId,
    second: NetId,
    clock: NetId,
    rises: bool,
    is_opposite: bool,
}

impl LatchPair {
    fn of(netlist: &Netlist, inverters: &Inverters, second: NetId) -> Option<Self> {
        let [data, clock] = netlist.pins(second)[..] else { return None };
        let (first, is_opposite) = inverters.root(data);
        let (own, other) = (netlist.register(second)?, netlist.register(first)?);
        let rises = own.kind == RegisterKind::High;
        let opens_in_turn = own.kind == other.kind.opposite() && !own.kind.is_edge();
        // While its clock is 0, a register that stores when that falls shows its first latch.
        let starts_alike = rises || own.starts_at() == (other.starts_at() != is_opposite);
        let is_pair = opens_in_turn && starts_alike && netlist.pins(first)[1..] == [clock];
        (is_pair && is_only_reader(netlist, first, second)).then_some(Self { first, second, clock, rises, is_opposite })
    }
}

/// Whether all that reads a net, be it through inverters and buffers, is one node.
fn is_only_reader(netlist: &Netlist, net: NetId, reader: NetId) -> bool {
    let mut open = vec![net];
    while let Some(net) = open.pop() {
        for (listener, _) in netlist.fanout(net) {
            let is_inverter = netlist.cell(listener).is_some_and(|cell| cell.function.arity() == 1);
            if listener != reader && !is_inverter {
                return false;
            }
            open.extend(Some(listener).filter(|_| is_inverter));
        }
    }
    true
}
