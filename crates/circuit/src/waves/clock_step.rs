//! One step of a clocked circuit: what follows from its inputs and its state, without the cells of its registers.

use std::collections::BTreeMap;

use crate::cells::CellKind;
use crate::network::{Network, Signal, View};
use crate::passes::{dissolve_wires, sweep};
use crate::signal_blocks::SignalBlocks;
use crate::storage::{Follower, Inverters};
use crate::waves::wording::WaveError;
use crate::{Blocks, Latch, Logic, NetId, Netlist, Node, Storage};
use nbc_base::model::Function;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StateBit {
    pub name: String,
    pub start: bool,
}

/// A circuit as the step that its clock makes.
#[derive(Clone, Debug)]
pub struct ClockStep {
    pub name: String,
    pub inputs: Vec<String>,
    pub outputs: Vec<String>,
    /// The clock, as an index of the inputs; `None` if there is no register.
    pub clock: Option<usize>,
    pub rises: bool,
    pub state: Vec<StateBit>,
    /// The logic: its inputs are the ports and then the state, its outputs the ports and then the next state.
    pub logic: Network,
    pub(super) blocks: Blocks,
    pub(super) signal_blocks: SignalBlocks,
}

struct Register {
    /// The cells of the second latch, each with whether it shows the opposite of the first of them.
    shows: Vec<(NetId, bool)>,
    /// The cells of the first latch, which nothing else may read.
    first: Vec<NetId>,
    /// The cell of the first latch that the second one stores, and whether the bit is the opposite of it.
    held: (NetId, bool),
    /// The net of the data, and whether the first cell shows the opposite of it.
    data: (NetId, bool),
    /// The net that clocks it, and whether it takes the data when that rises.
    clock: (NetId, bool),
}

impl ClockStep {
    pub fn of(source: &Netlist) -> Result<Self, WaveError> {
        const KIND: CellKind = CellKind::uniform(1, 1.0);
        let mut netlist = source.clone();
        dissolve_wires(&mut netlist).map_err(WaveError::Netlist)?;
        sweep(&mut netlist);
        let storage = Storage::of(&netlist, |_| &KIND);
        if let Some(unphased) = storage.unphased.first() {
            return Err(WaveError::Loop { net: netlist.net_name(unphased.nets[0]) });
        }
        let registers = registers(&netlist, &storage)?;
        let clock = clock(&netlist, &registers)?;
        Self::cut(&netlist, &registers, clock)
    }

    fn cut(netlist: &Netlist, registers: &[Register], clock: Option<(NetId, bool)>) -> Result<Self, WaveError> {
        let shown = registers.iter().flat_map(|register| register.shows.iter().map(|&(id, _)| id));
        let cuts: Vec<NetId> = shown.chain(registers.iter().flat_map(|register| register.first.clone())).collect();
        let view = View::of(netlist, &cuts).map_err(|id| WaveError::Loop { net: netlist.net_name(id) })?;
        let ports = netlist.inputs().len();
        let mut logic = view.network.clone();
        let wanted = netlist.outputs().iter().map(|&id| netlist.pins(id)[0]);
        let data = registers.iter().map(|register| register.data.0);
        logic.outputs = wanted.chain(data).map(|net| view.signal[&net]).collect();
        let (logic, swept) = logic.swept_signals();
        // What each input of the cut logic is: a port, or a bit of the state, maybe inverted.
        let mut place: BTreeMap<NetId, (usize, bool)> = BTreeMap::new();
        for (at, register) in registers.iter().enumerate() {
            place.extend(register.shows.iter().map(|&(id, inverted)| (id, (ports + at, inverted))));
        }
        let mut step = Network::new(ports + registers.len());
        let used = used_inputs(&logic);
        let mut made: Vec<Signal> = vec![0, 1];
        for (at, &id) in netlist.inputs().iter().chain(&cuts).enumerate() {
            if used[at] && Some(id) == clock.map(|(clock, _)| clock) {
                return Err(WaveError::ClockIsRead { clock: netlist.net_name(id) });
            }
            let signal = match place.get(&id) {
                _ if at < ports => step.input(at),
                Some(&(bit, false)) => step.input(bit),
                Some(&(bit, true)) if used[at] => step.add(Function::NOT, [step.input(bit); 2]),
                Some(_) => 0,
                None if used[at] => return Err(WaveError::Latch { net: netlist.net_name(id) }),
                None => 0,
            };
            made.push(signal);
        }
        for gate in &logic.gates {
            made.push(step.add(gate.function, gate.pins.map(|pin| made[pin as usize])));
        }
        step.outputs = logic.outputs.iter().map(|&output| made[output as usize]).collect();
        for (at, _) in (netlist.outputs().len()..).zip(registers).filter(|(_, register)| register.data.1) {
            step.outputs[at] = step.add(Function::NOT, [step.outputs[at]; 2]);
        }
        let logical: Vec<Signal> = swept.iter().map(|&signal| made[signal as usize]).collect();
        let signal_blocks = SignalBlocks::of(netlist, &view).renumbered(&logical, step.signals());
        let names = |ids: &[NetId]| ids.iter().map(|&id| netlist.net_name(id)).collect::<Vec<_>>();
        Ok(Self {
            name: netlist.name.clone(),
            inputs: names(netlist.inputs()),
            outputs: names(netlist.outputs()),
            clock: clock.and_then(|(clock, _)| netlist.inputs().iter().position(|&id| id == clock)),
            rises: clock.is_none_or(|(_, rises)| rises),
            state: state(netlist, registers)?,
            logic: step,
            blocks: netlist.blocks().without_nodes(),
            signal_blocks,
        })
    }

    pub fn run(&self, inputs: &[bool], state: &[bool]) -> (Vec<bool>, Vec<bool>) {
        let shown = self.logic.run(inputs.iter().chain(state).copied());
        let (outputs, next) = shown.split_at(self.outputs.len());
        (outputs.to_vec(), next.to_vec())
    }
}

fn used_inputs(network: &Network) -> Vec<bool> {
    let mut used = vec![false; network.signals()];
    network.outputs.iter().for_each(|&output| used[output as usize] = true);
    for gate in &network.gates {
        (0..2).filter(|&pin| gate.function.depends_on(pin)).for_each(|pin| used[gate.pins[pin] as usize] = true);
    }
    used[2..2 + network.inputs].to_vec()
}

fn registers(netlist: &Netlist, storage: &Storage) -> Result<Vec<Register>, WaveError> {
    let mut is_paired = vec![false; storage.latches.len()];
    for pair in &storage.flip_flops {
        (is_paired[pair.first], is_paired[pair.second]) = (true, true);
    }
    let latch_error = |latch: &Latch| WaveError::Latch { net: netlist.net_name(latch.cells[0]) };
    if let Some((latch, _)) = storage.latches.iter().zip(&is_paired).find(|(_, is_paired)| !**is_paired) {
        return Err(latch_error(latch));
    }
    let inverters = Inverters::of(netlist);
    let register = |pair: &crate::FlipFlop| {
        let [first, second] = [pair.first, pair.second].map(|latch| &storage.latches[latch]);
        let follow = |latch: &Latch| Follower::of(netlist, &inverters, latch).ok_or_else(|| latch_error(latch));
        let (taken, shown) = (follow(first)?, follow(second)?);
        let (_, inverted) = *taken.cells.iter().find(|(id, _)| *id == shown.data).ok_or_else(|| latch_error(second))?;
        // The cell that the source names, and not its opposite inside the register, is the bit of the state.
        let mut cells = shown.cells;
        cells.sort_by_key(|(id, _)| netlist.net_name(*id).len());
        let named = cells[0].1;
        Ok(Register {
            shows: cells.iter().map(|&(id, opposite)| (id, opposite != named)).collect(),
            first: first.cells.clone(),
            held: (shown.data, named),
            data: (taken.data, named != inverted),
            clock: (second.root, pair.rising),
        })
    };
    storage.flip_flops.iter().map(register).collect()
}

fn clock(netlist: &Netlist, registers: &[Register]) -> Result<Option<(NetId, bool)>, WaveError> {
    let Some(first) = registers.first() else { return Ok(None) };
    let name = |register: &Register| netlist.net_name(register.shows[0].0);
    for register in registers {
        if !matches!(netlist.node(register.clock.0), Node::Input(_)) {
            let clock = netlist.net_name(register.clock.0);
            return Err(WaveError::GatedClock { net: name(register), clock });
        }
        if register.clock.0 != first.clock.0 {
            let nets = [first, register].map(name);
            let clocks = [first, register].map(|register| netlist.net_name(register.clock.0));
            return Err(WaveError::TwoClocks { nets, clocks });
        }
        if register.clock.1 != first.clock.1 {
            let (rising, falling) = if first.clock.1 { (first, register) } else { (register, first) };
            return Err(WaveError::BothEdges { rising: name(rising), falling: name(falling) });
        }
    }
    Ok(Some(first.clock))
}

/// Those without a start value start as the circuit does.
fn state(netlist: &Netlist, registers: &[Register]) -> Result<Vec<StateBit>, WaveError> {
    let before = Logic::new(netlist);
    let bit = |register: &Register| {
        let (id, _) = register.shows[0];
        let (name, start) = (netlist.net_name(id), before.value(id));
        let starts = |(cell, is_opposite): (NetId, bool)| before.value(cell) == (start != is_opposite);
        // While its clock is 0, a register that stores when that falls shows its first latch.
        let is_held = register.clock.1 || starts(register.held);
        if is_held && register.shows.iter().all(|&cell| starts(cell)) {
            return Ok(StateBit { name, start });
        }
        Err(WaveError::Starts { net: name })
    };
    registers.iter().map(bit).collect()
}
