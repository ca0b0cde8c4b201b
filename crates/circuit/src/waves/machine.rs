//! Wave machines: cells of which each is a gate and a register, and the times at which they begin.

use std::collections::BTreeMap;

use crate::map::name_outputs;
use crate::waves::clock_step::{ClockStep, StateBit};
use crate::waves::graph::{Driver, Tap, WaveGraph};
use crate::waves::phases::Phases;
use crate::{BlockId, Cell, CellLibrary, NetId, Netlist};
use nbc_base::model::Function;

/// The beats before the first step in which robots take their shape and show their first outputs.
const WARM_UP: i64 = 3;

/// The functions that delay a net, with the number of pins that are connected to it.
const BUFFERS: [(Function, usize); 3] = [(Function::BUF, 1), (Function::AND, 2), (Function::OR, 2)];

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WaveOutput {
    /// The beat after the beginning of a step at whose end the port is read.
    pub phase: i64,
    /// The values of the first steps, which are those of registers before their first change.
    pub starts: Vec<bool>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WaveState {
    /// `Err` for a bit that never changes after its first steps.
    pub net: Result<NetId, bool>,
    pub later: i64,
    pub starts: Vec<bool>,
}

/// A clocked circuit of which every loop takes the same time, so that its state needs no latch, with as many threads
/// in it as a step has beats. A combinational circuit has steps of one beat.
#[derive(Clone, Debug)]
pub struct WaveMachine {
    /// The cells, and the ports of the source; nothing reads the clock.
    pub netlist: Netlist,
    /// The clock, as an index of the input ports, and whether a step is its rise; `None` for a circuit without state.
    pub clock: Option<(usize, bool)>,
    /// Beats of a step, and the number of threads: machines that run at once on the same robots.
    pub period: u32,
    /// Cycles of a beat.
    pub beat: u32,
    /// For each cell, the beat after the beginning of a step in which it reads its nets.
    pub phase: BTreeMap<NetId, i64>,
    /// For each input port that is read, the beat after the beginning of a step in which it is applied.
    pub inputs: Vec<Option<i64>>,
    pub outputs: Vec<WaveOutput>,
    /// The pins that read state, each with its values in the first steps.
    pub held: BTreeMap<(NetId, u8), Vec<bool>>,
    pub state: Vec<WaveState>,
    pub buffers: usize,
    /// Whether no phases of these gates need fewer such cells.
    pub has_fewest_buffers: bool,
    /// Each driver with the buffers after it, in order.
    chains: Vec<Vec<NetId>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    Start(bool),
    /// Its value at the end of the cycle with this number.
    Cycle(usize),
}

impl WaveMachine {
    /// The machine of a graph with these phases; `None` if no cell of the library delays a net.
    pub(super) fn new(
        step: &ClockStep,
        graph: &WaveGraph,
        blocks: &[BlockId],
        phases: &Phases,
        library: &CellLibrary,
        beat: u32,
    ) -> Option<Self> {
        let buffer = BUFFERS.into_iter().find(|(function, _)| library.get(*function).is_some())?;
        Some(Builder::new(step, graph, blocks, phases, buffer, beat).build())
    }

    pub fn cells(&self) -> usize {
        self.phase.len()
    }

    pub fn cycles_per_step(&self) -> usize {
        (self.period * self.beat) as usize
    }

    pub fn beginning(&self) -> i64 {
        let earliest = self.inputs.iter().flatten().copied().chain(self.outputs.iter().map(|output| output.phase));
        let earliest = earliest.min().unwrap_or(0).min(0);
        WARM_UP.max(i64::from(self.period)) - earliest
    }

    /// The beat in which a step of a thread reaches a phase; steps count from 1.
    fn beat_of(&self, step: i64, thread: usize, phase: i64) -> i64 {
        self.beginning() + (step - 1) * i64::from(self.period) + thread as i64 + phase
    }

    /// The row whose value an input port has in a cycle; rows count from 0 and end before `rows`.
    pub fn row_at(&self, input: usize, cycle: usize, rows: usize) -> usize {
        let beat = (cycle / self.beat as usize) as i64;
        let phase = self.inputs[input].unwrap_or(0);
        let step = (beat - self.beginning() - phase).div_euclid(i64::from(self.period)) + 1;
        (step - self.first_row()).clamp(0, rows as i64 - 1) as usize
    }

    pub fn reading(&self, output: usize, row: usize, thread: usize) -> Reading {
        let WaveOutput { phase, starts } = &self.outputs[output];
        match starts.get(row) {
            Some(&start) => Reading::Start(start),
            None => {
                let beat = self.beat_of(row as i64 + self.first_row(), thread, *phase);
                Reading::Cycle((beat as usize + 1) * self.beat as usize - 1)
            }
        }
    }

    /// The step of the first row: without state a row is a step; with state, the first row is before the first step.
    fn first_row(&self) -> i64 {
        i64::from(self.clock.is_none())
    }

    pub fn cycles(&self, rows: usize) -> usize {
        let last = |output| match self.reading(output, rows.saturating_sub(1), self.period as usize - 1) {
            Reading::Start(_) => 0,
            Reading::Cycle(cycle) => cycle + 1,
        };
        (0..self.outputs.len()).map(last).max().unwrap_or(0).max(1)
    }

    /// What a pin senses in the first cycles instead of its net, if it reads state.
    pub fn held_bits(&self, cell: NetId, pin: u8) -> Vec<bool> {
        let Some(starts) = self.held.get(&(cell, pin)) else { return Vec::new() };
        let begins = self.beat_of(1, 0, self.phase[&cell]);
        let ends = begins + starts.len() as i64 * i64::from(self.period);
        let bit = |beat: i64| starts[((beat - begins).div_euclid(i64::from(self.period)).max(0)) as usize];
        (0..ends).flat_map(|beat| std::iter::repeat_n(bit(beat), self.beat as usize)).collect()
    }

    pub fn chains(&self) -> Vec<(NetId, usize)> {
        self.chains.iter().map(|chain| (chain[0], chain.len() - 1)).filter(|(_, buffers)| *buffers > 0).collect()
    }

    pub fn thread_at(&self, cell: NetId, cycle: usize) -> usize {
        let beat = (cycle / self.beat as usize) as i64;
        (beat - self.beginning() - self.phase[&cell]).rem_euclid(i64::from(self.period)) as usize
    }
}

struct Builder<'a> {
    step: &'a ClockStep,
    graph: &'a WaveGraph,
    phases: &'a Phases,
    buffer: (Function, usize),
    machine: WaveMachine,
    chains: BTreeMap<Driver, Vec<NetId>>,
}

impl<'a> Builder<'a> {
    fn new(
        step: &'a ClockStep,
        graph: &'a WaveGraph,
        blocks: &[BlockId],
        phases: &'a Phases,
        buffer: (Function, usize),
        beat: u32,
    ) -> Self {
        let mut netlist = Netlist::new(&step.name);
        *netlist.blocks_mut() = step.blocks.clone();
        let mut chains = BTreeMap::new();
        for (at, name) in step.inputs.iter().enumerate() {
            chains.insert(Driver::Input(at), vec![netlist.add_input(name)]);
        }
        for (at, gate) in graph.gates.iter().enumerate() {
            let cell = Cell { function: gate.function, name: None, start: None, span: None };
            let id = netlist.add_loose_cell(cell);
            netlist.put_into(id, blocks[at]);
            chains.insert(Driver::Gate(at), vec![id]);
        }
        let machine = WaveMachine {
            netlist,
            clock: step.clock.map(|clock| (clock, step.rises)),
            period: phases.period,
            beat,
            phase: BTreeMap::new(),
            inputs: vec![None; graph.inputs],
            outputs: Vec::new(),
            held: BTreeMap::new(),
            state: Vec::new(),
            buffers: 0,
            has_fewest_buffers: phases.is_optimal,
            chains: Vec::new(),
        };
        Self { step, graph, phases, buffer, machine, chains }
    }

    fn build(mut self) -> WaveMachine {
        let (step, graph) = (self.step, self.graph);
        for (at, gate) in graph.gates.iter().enumerate() {
            let (cell, phase) = (self.chains[&Driver::Gate(at)][0], self.phases.gates[at]);
            self.machine.phase.insert(cell, phase);
            for (pin, tap) in (0..).zip(&gate.pins) {
                let net = self.net(tap, phase);
                self.machine.netlist.connect(cell, pin, net);
                if !tap.starts.is_empty() {
                    self.machine.held.insert((cell, pin), tap.starts.clone());
                }
            }
        }
        for ((tap, name), &phase) in graph.outputs.iter().zip(&step.outputs).zip(&self.phases.outputs) {
            let net = self.net(tap, phase);
            self.machine.netlist.add_output(name, net);
            // An input shows a step while it is applied, a cell at the end of the beat before its listeners read it.
            let shown = if self.machine.netlist.cell(net).is_some() { phase - 1 } else { phase };
            self.machine.outputs.push(WaveOutput { phase: shown, starts: tap.starts.clone() });
        }
        for (bit, tap) in step.state.iter().zip(&graph.state) {
            self.note_state(bit, tap);
        }
        name_outputs(&mut self.machine.netlist);
        self.machine.chains = std::mem::take(&mut self.chains).into_values().collect();
        self.begin_at_zero();
        self.machine
    }

    fn net(&mut self, tap: &Tap, phase: i64) -> NetId {
        let drives_from = match tap.driver {
            Driver::Constant(value) => return self.machine.netlist.add_constant(value),
            Driver::Input(port) => {
                self.machine.inputs[port] = Some(self.phases.inputs[port] + 1);
                self.phases.inputs[port]
            }
            Driver::Gate(gate) => self.phases.gates[gate],
        };
        let needed = phase + tap.later * i64::from(self.phases.period) - drives_from - 1;
        let needed = usize::try_from(needed).expect("every listener is later than its driver");
        let chain = self.chains.get_mut(&tap.driver).expect("every driver has a net");
        while chain.len() <= needed {
            let (function, pins) = self.buffer;
            let cell = Cell { function, name: None, start: None, span: None };
            let last = chain[chain.len() - 1];
            let net = self.machine.netlist.add_cell(cell, &[last; 2][..pins]);
            let block = self.machine.netlist.block(last);
            self.machine.netlist.put_into(net, block);
            self.machine.phase.insert(net, drives_from + chain.len() as i64);
            self.machine.buffers += 1;
            chain.push(net);
        }
        chain[needed]
    }

    fn note_state(&mut self, bit: &StateBit, tap: &Tap) {
        let net = match tap.driver {
            Driver::Constant(value) => Err(value),
            driver => Ok(self.chains[&driver][0]),
        };
        if let (Ok(net), 1) = (net, tap.later)
            && let Some(cell) = self.machine.netlist.cell_mut(net)
            && cell.name.is_none()
        {
            cell.name = Some(bit.name.clone());
        }
        self.machine.state.push(WaveState { net, later: tap.later, starts: tap.starts.clone() });
    }

    fn begin_at_zero(&mut self) {
        let machine = &mut self.machine;
        let earliest = machine.phase.values().chain(machine.inputs.iter().flatten()).min().copied().unwrap_or(0);
        machine.phase.values_mut().for_each(|phase| *phase -= earliest);
        machine.inputs.iter_mut().flatten().for_each(|phase| *phase -= earliest);
        machine.outputs.iter_mut().for_each(|output| output.phase -= earliest);
    }
}
