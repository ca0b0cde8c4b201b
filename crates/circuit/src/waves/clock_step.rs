//! One step of a clocked circuit: what follows from its inputs and its state, without the cells of its registers.

use crate::network::{Network, View};
use crate::passes::{dissolve_wires, sweep};
use crate::register::{Forcing, RegisterKind};
use crate::signal_blocks::SignalBlocks;
use crate::storage::{Inverters, Raised, pair_latches};
use crate::waves::wording::WaveError;
use crate::{Blocks, Loops, NetId, Netlist, Node, RegisterNode};
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

impl ClockStep {
    pub fn of(source: &Netlist) -> Result<Self, WaveError> {
        let mut netlist = source.clone();
        dissolve_wires(&mut netlist).map_err(WaveError::Netlist)?;
        sweep(&mut netlist);
        let Raised { mut netlist, contradicting } = Raised::of(&netlist);
        if let Some(&net) = contradicting.first() {
            return Err(WaveError::Starts { net: netlist.net_name(net) });
        }
        pair_latches(&mut netlist);
        let name = |id: NetId| netlist.net_name(id);
        for (id, register) in netlist.registers() {
            if register.forcing != Forcing::Never {
                return Err(WaveError::Forced { net: name(id) });
            }
            if !register.kind.is_edge() {
                return Err(WaveError::Latch { net: name(id) });
            }
        }
        if let Some(core) = Loops::of(&netlist).cores().first() {
            return Err(WaveError::Loop { net: name(core[0]) });
        }
        let registers: Vec<NetId> = netlist.registers().map(|(id, _)| id).collect();
        let clock = clock(&netlist, &registers)?;
        Self::cut(&netlist, &registers, clock)
    }

    fn cut(netlist: &Netlist, registers: &[NetId], clock: Option<(NetId, bool)>) -> Result<Self, WaveError> {
        let view = View::of(netlist, registers).map_err(|id| WaveError::Loop { net: netlist.net_name(id) })?;
        let mut logic = view.network.clone();
        logic.outputs.truncate(netlist.outputs().len());
        // Each register has an inverter of its own before its data: searches and wave machines are the better for it.
        let inverters = Inverters::of(netlist);
        for &id in registers {
            let (root, is_opposite) = inverters.root(netlist.pins(id)[usize::from(RegisterNode::DATA)]);
            let data = view.signal[&root];
            let data = if is_opposite { logic.add(Function::NOT, [data; 2]) } else { data };
            logic.outputs.push(data);
        }
        let (logic, swept) = logic.swept_signals();
        let clock_input = clock.and_then(|(clock, _)| netlist.inputs().iter().position(|&id| id == clock));
        if let Some(input) = clock_input.filter(|&input| used_inputs(&logic)[input]) {
            return Err(WaveError::ClockIsRead { clock: netlist.net_name(netlist.inputs()[input]) });
        }
        let signal_blocks = SignalBlocks::of(netlist, &view).renumbered(&swept, logic.signals());
        let names = |ids: &[NetId]| ids.iter().map(|&id| netlist.net_name(id)).collect::<Vec<_>>();
        let bit = |&id: &NetId| StateBit {
            name: netlist.net_name(id),
            start: netlist.register(id).is_some_and(RegisterNode::starts_at),
        };
        Ok(Self {
            name: netlist.name.clone(),
            inputs: names(netlist.inputs()),
            outputs: names(netlist.outputs()),
            clock: clock_input,
            rises: clock.is_none_or(|(_, rises)| rises),
            state: registers.iter().map(bit).collect(),
            logic,
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

fn clock(netlist: &Netlist, registers: &[NetId]) -> Result<Option<(NetId, bool)>, WaveError> {
    let Some(&first) = registers.first() else { return Ok(None) };
    let name = |id: NetId| netlist.net_name(id);
    let clock = |id: NetId| {
        let rises = netlist.register(id).is_some_and(|register| register.kind == RegisterKind::Rising);
        (netlist.pins(id)[usize::from(RegisterNode::CLOCK)], rises)
    };
    let (input, rises) = clock(first);
    for &register in registers {
        let (own, own_rises) = clock(register);
        if !matches!(netlist.node(own), Node::Input(_)) {
            return Err(WaveError::GatedClock { net: name(register), clock: name(own) });
        }
        if own != input {
            let (nets, clocks) = ([first, register].map(name), [input, own].map(name));
            return Err(WaveError::TwoClocks { nets, clocks });
        }
        if own_rises != rises {
            let (rising, falling) = if rises { (first, register) } else { (register, first) };
            return Err(WaveError::BothEdges { rising: name(rising), falling: name(falling) });
        }
    }
    Ok(Some((input, rises)))
}
