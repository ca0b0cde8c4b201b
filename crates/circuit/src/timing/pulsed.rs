//! Pulsed latches: registers as one latch of four cells each, which short pulses of one generator open at an edge of
//! the clock (docs/timing.md, "Pulsed latches").
//!
//! A flip-flop of two latches loses its first latch, and its second one is opened by the pulse. This is safe for delays
//! between one cycle and the clocks of the cells if the pulse is long enough for a latch to settle, and if no change
//! that the pulse causes reaches a latch before the pulse has ended.

use std::collections::BTreeMap;

use crate::cells::CellLibrary;
use crate::passes::{Pass, Sweep};
use crate::timing::phase::{MOST_ROOTS, earliest, passages, phases};
use crate::{BlockId, Cell, FlipFlop, Latch, Logic, NetId, Netlist, Node, Storage};
use nbc_base::model::Function;

/// The numbers of inverters that are tried for a pulse.
const CHAINS: [usize; 8] = [1, 3, 5, 7, 9, 11, 13, 15];
/// The most cells that are added before a latch so that its data change late enough.
const MOST_PADDING: usize = 2;

/// A netlist with pulsed latches.
#[derive(Clone, Debug)]
pub struct Pulsed {
    /// The netlist with pulsed latches in place of some flip-flops.
    pub netlist: Netlist,
    /// What became of its registers.
    pub registers: PulsedRegisters,
}

/// The registers of a netlist with pulsed latches.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PulsedRegisters {
    /// The generators of pulses.
    pub pulses: Vec<Pulse>,
    /// The nets of each register that stays a flip-flop of two latches, with the reason.
    pub kept: Vec<(NetId, WhyKept)>,
}

/// A pulse at each edge of a clock.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pulse {
    /// The net that it is on.
    pub net: NetId,
    /// The clock whose edges it follows.
    pub clock: NetId,
    /// Whether it follows the rises of the clock.
    pub rises: bool,
    /// Its least length in cycles.
    pub width: u32,
    /// The length that its latches need, in cycles.
    pub needed: u32,
    /// Cycles after the edge at which it has ended for certain; the inputs of its latches must be stable until then.
    pub ends: u32,
    /// The number of latches that it opens.
    pub latches: usize,
    /// The number of cells that delay data.
    pub padding: usize,
}

/// Why a register stays as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WhyKept {
    /// It is not made of eight NAND cells as the standard circuits are, or its first latch is read elsewhere or starts
    /// otherwise.
    OtherForm,
    /// Its clock is not an input.
    DerivedClock,
    /// Its data may change before a pulse has ended.
    FastData,
    /// It is not a latch of one bit, so one cell cannot be in its place.
    NotOneBit,
    /// One cell in its place would not be recognized as a latch, such as where its data depend on what opens it.
    NotRecognized,
    /// Pulsed latches would not save cells.
    NoGain,
}

impl Pulsed {
    /// A netlist of cells of a library, with pulsed latches where they are proved safe.
    pub fn of(netlist: &Netlist, library: &CellLibrary) -> Self {
        let storage = Storage::of(netlist, library.kinds_of(netlist));
        let before = Logic::new(netlist);
        let mut kept = Vec::new();
        let mut registers = Vec::new();
        for pair in &storage.flip_flops {
            match Register::of(netlist, &before, &storage, pair) {
                Ok(register) => registers.push((register, 0)),
                Err(why) => kept.push((storage.latches[pair.second].cells[0], why)),
            }
        }
        let plan = Plan { netlist, library };
        loop {
            let (made, pulses) = plan.make(&registers);
            let missing = plan.missing(&made, &registers, &pulses);
            if missing.iter().all(|&missing| missing == 0) {
                let is_gain = made.cells().count() < netlist.cells().count();
                return if is_gain { Self::with(made, pulses, kept) } else { plan.unchanged(registers, kept) };
            }
            let padded = registers.into_iter().zip(missing).map(|((register, padding), missing)| {
                // Two inverters at a time, so that the data keep their sense.
                (register, padding + missing.min(MOST_PADDING as u32 + 1).next_multiple_of(2) as usize)
            });
            let (fast, rest): (Vec<_>, Vec<_>) = padded.partition(|&(_, padding)| padding > MOST_PADDING);
            kept.extend(fast.into_iter().map(|(register, _)| (register.q, WhyKept::FastData)));
            registers = rest;
        }
    }

    fn with(netlist: Netlist, pulses: Vec<Pulse>, mut kept: Vec<(NetId, WhyKept)>) -> Self {
        kept.sort_by_key(|(net, _)| *net);
        Self { netlist, registers: PulsedRegisters { pulses, kept } }
    }
}

/// A flip-flop of eight NAND cells.
#[derive(Clone, Copy, Debug)]
struct Register {
    /// The input that is its clock, and whether it takes its data when that rises.
    clock: NetId,
    rises: bool,
    data: NetId,
    /// The guards of its second latch.
    set: NetId,
    reset: NetId,
    /// The cells of its second latch.
    q: NetId,
    nq: NetId,
}

impl Register {
    /// The flip-flop, if it is one of this form in a netlist that starts so.
    fn of(netlist: &Netlist, before: &Logic, storage: &Storage, pair: &FlipFlop) -> Result<Self, WhyKept> {
        let [first, second] = [pair.first, pair.second].map(|latch| &storage.latches[latch]);
        let data = |latch: &Latch| <[NetId; 1]>::try_from(&latch.data[..]).map_err(|_| WhyKept::OtherForm);
        let ([data], [held]) = (data(first)?, data(second)?);
        let Some([_, _, first_q, first_nq]) = standard(netlist, first, data) else { return Err(WhyKept::OtherForm) };
        let Some([set, reset, q, nq]) = standard(netlist, second, held) else { return Err(WhyKept::OtherForm) };
        let is_private = netlist.fanout(first_q).iter().all(|(listener, _)| [first_nq, set].contains(listener));
        let starts_alike = before.value(first_q) == before.value(q);
        if held != first_q || !starts_alike || !is_private || netlist.fanout(first_nq).len() != 1 {
            return Err(WhyKept::OtherForm);
        }
        if !matches!(netlist.node(second.root), Node::Input(_)) {
            return Err(WhyKept::DerivedClock);
        }
        Ok(Self { clock: second.root, rises: second.open, data, set, reset, q, nq })
    }
}

/// The two guards and the two cells of a latch of four NAND cells, if it is one: `[set, reset, q, nq]`.
fn standard(netlist: &Netlist, latch: &Latch, data: NetId) -> Option<[NetId; 4]> {
    let is_nand = |&id: &NetId| netlist.cell(id).is_some_and(|cell| cell.function == Function::NAND);
    if latch.guards.len() != 2 || latch.cells.len() != 2 || !latch.guards.iter().chain(&latch.cells).all(is_nand) {
        return None;
    }
    let reads = |id: NetId, pins: [NetId; 2]| {
        let found = netlist.pins(id);
        found == pins || found == [pins[1], pins[0]]
    };
    let find = |nets: &[NetId], pins: [NetId; 2]| nets.iter().copied().find(|&id| reads(id, pins));
    let set = find(&latch.guards, [data, latch.enable])?;
    let reset = find(&latch.guards, [set, latch.enable])?;
    let [a, b] = [latch.cells[0], latch.cells[1]];
    let is_pair = |q: NetId, nq: NetId| reads(q, [set, nq]) && reads(nq, [reset, q]);
    [[a, b], [b, a]].into_iter().find(|&[q, nq]| is_pair(q, nq)).map(|[q, nq]| [set, reset, q, nq])
}

/// The making of pulsed latches.
struct Plan<'a> {
    netlist: &'a Netlist,
    library: &'a CellLibrary,
}

impl Plan<'_> {
    fn clock(&self, function: Function) -> Option<u32> {
        self.library.get(function).map(|kind| kind.clock)
    }

    /// The netlist with these registers as pulsed latches, each with so many cells before its data.
    fn make(&self, registers: &[(Register, usize)]) -> (Netlist, Vec<Pulse>) {
        let mut made = self.netlist.clone();
        let mut groups: BTreeMap<(NetId, bool), Vec<&(Register, usize)>> = BTreeMap::new();
        for one in registers {
            groups.entry((one.0.clock, one.0.rises)).or_default().push(one);
        }
        let mut pulses = Vec::new();
        for ((clock, rises), group) in groups {
            let needed = group.iter().map(|(register, _)| self.needed(register)).max().unwrap_or(0);
            let Some(mut pulse) = self.generate(&mut made, clock, rises, needed) else { continue };
            for &&(Register { data, set, reset, .. }, padding) in &group {
                let block = made.block(set);
                let late = (0..padding).fold(data, |net, _| self.invert(&mut made, net, block));
                made.drive(set, 0, late);
                made.drive(set, 1, pulse.net);
                let [from, to] = [set, pulse.net];
                made.drive(reset, 0, from);
                made.drive(reset, 1, to);
                pulse.padding += padding;
            }
            pulse.latches = group.len();
            pulses.push(pulse);
        }
        Sweep.run(&mut made).expect("a sweep always succeeds");
        (made, pulses)
    }

    /// Cycles that a latch needs to settle after its pulse has begun, less the one in which its guards still have their
    /// values after the pulse.
    fn needed(&self, register: &Register) -> u32 {
        let Register { set, reset, q, nq, .. } = *register;
        let kind = self.library.kinds_of(self.netlist);
        let [set, reset, q, nq] = [set, reset, q, nq].map(|id| kind(id).clock);
        (set + reset + 2 * q.max(nq)).saturating_sub(1)
    }

    /// Adds the shortest generator whose pulses are long enough: the clock, and the clock through a chain of inverters.
    fn generate(&self, made: &mut Netlist, clock: NetId, rises: bool, needed: u32) -> Option<Pulse> {
        let name = format!("{}.pulse{}", made.net_name(clock), if rises { "" } else { ".low" });
        let inverter = self.clock(self.inverter())?;
        let (and_cells, and_cycles) = match self.clock(Function::AND) {
            Some(clock) => (1, clock),
            None => (2, self.clock(Function::NAND)? + inverter),
        };
        let width = |chain: usize| (chain as u32 + and_cells).saturating_sub(and_cycles);
        let chain = CHAINS.into_iter().find(|&chain| width(chain) >= needed)?;
        let block = made.blocks_mut().add(&name, "pulse", BlockId::TOP);
        let base = if rises { clock } else { self.invert(made, clock, block) };
        let late = (0..chain).fold(base, |net, _| self.invert(made, net, block));
        let net = match self.clock(Function::AND) {
            Some(_) => made.add_gate(Function::AND, &[base, late]),
            None => {
                let opposite = made.add_gate(Function::NAND, &[base, late]);
                made.put_into(opposite, block);
                self.invert(made, opposite, block)
            }
        };
        made.put_into(net, block);
        made.rename(net, &name);
        let before = if rises { 0 } else { inverter };
        let ends = before + chain as u32 * inverter + and_cycles;
        Some(Pulse { net, clock, rises, width: width(chain), needed, ends, latches: 0, padding: 0 })
    }

    /// The quicker of NOT and NAND.
    fn inverter(&self) -> Function {
        let is_quick = |not| self.clock(Function::NAND).is_none_or(|nand| not <= nand);
        if self.clock(Function::NOT).is_some_and(is_quick) { Function::NOT } else { Function::NAND }
    }

    fn invert(&self, made: &mut Netlist, net: NetId, block: BlockId) -> NetId {
        let function = self.inverter();
        let cell = Cell { function, name: None, start: None, span: None };
        let id = made.add_cell(cell, &[net, net][..function.arity()]);
        made.put_into(id, block);
        id
    }

    /// For each register, by how many cycles its data may change too early; one without a pulse is beyond padding.
    fn missing(&self, made: &Netlist, registers: &[(Register, usize)], pulses: &[Pulse]) -> Vec<u32> {
        let kind = self.library.kinds_of(made);
        let storage = Storage::of(made, &kind);
        let roots: Vec<NetId> = storage.roots().into_iter().map(|(root, _)| root).take(MOST_ROOTS).collect();
        let all = phases(made, &roots);
        let early = |register: &Register| {
            let pulse = pulses.iter().find(|pulse| (pulse.clock, pulse.rises) == (register.clock, register.rises));
            let Some(pulse) = pulse else { return MOST_PADDING as u32 + 1 };
            let is_after =
                |values: &&BTreeMap<NetId, bool>| values.get(&pulse.clock).is_none_or(|&now| now == pulse.rises);
            let of_phase = |values: &BTreeMap<NetId, bool>| {
                let passages = passages(made, &storage, values, &[pulse.clock], &kind);
                let first = earliest(made, &storage, &passages, &[pulse.clock], &[]);
                let data = made.pins(register.set).into_iter().filter(|&pin| pin != pulse.net);
                data.filter_map(|pin| pulse.ends.checked_sub(first[pin.index()]?)).max().unwrap_or(0)
            };
            all.iter().filter(is_after).map(of_phase).max().unwrap_or(0)
        };
        registers.iter().map(|(register, _)| early(register)).collect()
    }

    /// The netlist as it was.
    fn unchanged(&self, registers: Vec<(Register, usize)>, mut kept: Vec<(NetId, WhyKept)>) -> Pulsed {
        kept.extend(registers.into_iter().map(|(register, _)| (register.q, WhyKept::NoGain)));
        Pulsed::with(self.netlist.clone(), Vec::new(), kept)
    }
}
