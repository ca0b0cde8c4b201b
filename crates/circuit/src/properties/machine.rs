//! The steps of a circuit, as and-gates.
//!
//! The steps are the rows of a test. A circuit whose registers have one clock makes a step when it rises, or when it
//! falls, as they store: the first step is before the first edge and shows the start values, and each later one shows
//! the outputs after an edge, with the inputs that were there at the edge. A circuit without a clock makes a step
//! whenever its inputs change and everything has settled, at the level of logic: all cells take the same time. It must
//! settle for all inputs.

use crate::and_graph::{AndGraph, AndLiteral};
use crate::lowering::as_nands;
use crate::network::{Network, View};
use crate::passes::{dissolve_wires, sweep};
use crate::properties::solver::{ClauseSolver, Solved};
use crate::properties::wording::NoSteps;
use crate::waves::{ClockStep, StateBit, WaveError};
use crate::{Logic, Loops, NetId, Netlist};
use nbc_base::source::CancelFlag;

const MOST_CELLS: usize = 400;

/// The most time steps after which such a circuit must have settled.
const MOST_TIME: usize = 64;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepClock {
    pub input: usize,
    /// Whether the registers store when it rises, not when it falls.
    pub rises: bool,
}

pub(super) struct Machine {
    pub(super) inputs: usize,
    pub(super) clock: Option<StepClock>,
    pub(super) state: Vec<StateBit>,
    kind: MachineKind,
}

enum MachineKind {
    /// Between edges: its inputs are the ports and the state, its outputs the ports and the next state.
    Clocked(Network),
    /// One time step, from ports and cells to ports and cells, and the number of steps after which nothing changes.
    Settling(Network, usize),
}

impl Machine {
    /// `allowed` reads the input ports; only inputs for which all its outputs are 1 count.
    ///
    /// # Panics
    /// When the netlist is not well formed.
    pub(super) fn of(netlist: &Netlist, allowed: &Network, cancel: &CancelFlag) -> Result<Self, NoSteps> {
        match ClockStep::of(netlist) {
            Ok(step) => Ok(Self::clocked(step)),
            Err(why) => Self::settling(netlist, why, allowed, cancel),
        }
    }

    fn clocked(step: ClockStep) -> Self {
        let ClockStep { inputs, clock, rises, state, logic, .. } = step;
        let clock = clock.map(|input| StepClock { input, rises });
        Self { inputs: inputs.len(), clock, state, kind: MachineKind::Clocked(logic) }
    }

    fn settling(netlist: &Netlist, why: WaveError, allowed: &Network, cancel: &CancelFlag) -> Result<Self, NoSteps> {
        let mut plain = as_nands(netlist);
        let is_plain = dissolve_wires(&mut plain).map(|()| sweep(&mut plain));
        if is_plain.is_err() || plain.cells().count() > MOST_CELLS {
            return Err(NoSteps::Memory(why));
        }
        debug_assert!(!Loops::of(&plain).cores().is_empty(), "a circuit without feedback is a step");
        let cells: Vec<NetId> = plain.cells().map(|(id, _)| id).collect();
        let step = View::of(&plain, &cells).expect("all loops are cut").network;
        let logic = Logic::new(&plain);
        let state: Vec<StateBit> =
            cells.iter().map(|&id| StateBit { name: plain.net_label(id), start: logic.value(id) }).collect();
        let inputs = plain.inputs().len();
        let time = settling_time(&step, allowed, &state, cancel)?;
        Ok(Self { inputs, clock: None, state, kind: MachineKind::Settling(step, time) })
    }

    pub(super) fn is_clocked(&self) -> bool {
        self.clock.is_some()
    }

    /// It has no state and does not read that clock, so that it can make its steps with the clock's edges.
    pub(super) fn ignores(&self, clock: usize) -> bool {
        match &self.kind {
            MachineKind::Clocked(logic) => self.state.is_empty() && !reads(logic, clock),
            MachineKind::Settling(..) => false,
        }
    }

    /// What the outputs show before the edge of a step, as far as it is known from these inputs.
    pub(super) fn shown_before(
        &self,
        graph: &mut AndGraph,
        inputs: &[Option<AndLiteral>],
        state: &[AndLiteral],
    ) -> Vec<Option<AndLiteral>> {
        let (MachineKind::Clocked(logic) | MachineKind::Settling(logic, _)) = &self.kind;
        let known: Vec<Option<AndLiteral>> = inputs.iter().copied().chain(state.iter().copied().map(Some)).collect();
        let mut shown = graph.known_outputs(logic, &known);
        shown.truncate(logic.outputs.len() - state.len());
        shown
    }

    /// `first` is 1 in the first step.
    pub(super) fn step(
        &self,
        graph: &mut AndGraph,
        inputs: &[AndLiteral],
        state: &[AndLiteral],
        first: AndLiteral,
    ) -> (Vec<AndLiteral>, Vec<AndLiteral>) {
        match &self.kind {
            MachineKind::Clocked(logic) => {
                let outputs = logic.outputs.len() - state.len();
                let after = applied(graph, logic, inputs, state).split_off(outputs);
                let now: Vec<AndLiteral> =
                    state.iter().zip(after).map(|(&before, after)| graph.choice(first, before, after)).collect();
                let mut shown = applied(graph, logic, inputs, &now);
                shown.truncate(outputs);
                (shown, now)
            }
            MachineKind::Settling(step, time) => {
                let settled = settled(graph, step, inputs, state, *time);
                let mut shown = applied(graph, step, inputs, &settled);
                shown.truncate(step.outputs.len() - state.len());
                (shown, settled)
            }
        }
    }
}

pub(super) fn reads(network: &Network, input: usize) -> bool {
    let mut used: Vec<bool> = (0..network.signals()).map(|signal| signal == 2 + input).collect();
    for (at, gate) in network.gates.iter().enumerate() {
        used[2 + network.inputs + at] =
            (0..2).any(|pin| gate.function.depends_on(pin) && used[gate.pins[pin] as usize]);
    }
    network.outputs.iter().any(|&output| used[output as usize])
}

fn applied(graph: &mut AndGraph, network: &Network, inputs: &[AndLiteral], state: &[AndLiteral]) -> Vec<AndLiteral> {
    graph.outputs(network, &[inputs, state].concat())
}

fn settled(
    graph: &mut AndGraph,
    step: &Network,
    inputs: &[AndLiteral],
    cells: &[AndLiteral],
    time: usize,
) -> Vec<AndLiteral> {
    let outputs = step.outputs.len() - cells.len();
    (0..time).fold(cells.to_vec(), |cells, _| applied(graph, step, inputs, &cells).split_off(outputs))
}

/// The most time steps until the circuit settles, from the start and from any settled state, for all allowed inputs.
fn settling_time(step: &Network, allowed: &Network, start: &[StateBit], cancel: &CancelFlag) -> Result<usize, NoSteps> {
    let inputs = allowed.inputs;
    // The inputs before, the inputs now, and the cells.
    let mut graph = AndGraph::new(2 * inputs + start.len());
    let sources =
        |graph: &AndGraph, range: std::ops::Range<usize>| range.map(|at| graph.source(at)).collect::<Vec<_>>();
    let before = sources(&graph, 0..inputs);
    let now = sources(&graph, inputs..2 * inputs);
    let cells = sources(&graph, 2 * inputs..2 * inputs + start.len());
    let kept = settled(&mut graph, step, &before, &cells, 1);
    let at_rest = same(&mut graph, &cells, &kept);
    let beginning = cells.iter().zip(start).fold(1, |all, (&cell, bit)| graph.and(all, cell ^ usize::from(!bit.start)));
    let permit = |graph: &mut AndGraph, inputs: &[AndLiteral]| {
        graph.outputs(allowed, inputs).into_iter().fold(1, |all, output| graph.and(all, output))
    };
    let [was_allowed, is_allowed] = [&before, &now].map(|inputs| permit(&mut graph, inputs));
    let rested = graph.and(at_rest, was_allowed);
    let from = graph.or(rested, beginning);
    let possible = graph.and(from, is_allowed);
    let mut last = cells;
    for time in 0..=MOST_TIME {
        let next = settled(&mut graph, step, &now, &last, 1);
        // Only some numbers are tried: each call of the solver reads all gates.
        if time.is_power_of_two() || time == 0 {
            let rests = same(&mut graph, &last, &next);
            let moves = graph.and(possible, rests ^ 1);
            match can_be(&graph, 2 * inputs + start.len(), moves, cancel) {
                Solved::No => return Ok(time),
                Solved::Open => return Err(NoSteps::Cancelled),
                Solved::Yes => {}
            }
        }
        last = next;
    }
    Err(NoSteps::Unsettled { most: MOST_TIME })
}

pub(super) fn same(graph: &mut AndGraph, one: &[AndLiteral], other: &[AndLiteral]) -> AndLiteral {
    one.iter().zip(other).fold(1, |all, (&a, &b)| {
        let equal = graph.choice(a, b, b ^ 1);
        graph.and(all, equal)
    })
}

fn can_be(graph: &AndGraph, sources: usize, literal: AndLiteral, cancel: &CancelFlag) -> Solved {
    let mut solver = ClauseSolver::new(cancel.clone());
    let mut made = vec![!solver.one()];
    made.extend((0..sources).map(|_| solver.fresh()));
    let value = |made: &[batsat::Lit], literal: AndLiteral| {
        if literal & 1 == 1 { !made[literal / 2] } else { made[literal / 2] }
    };
    for &[a, b] in &graph.ands.items {
        let both = solver.and(value(&made, a), value(&made, b));
        made.push(both);
    }
    let wanted = value(&made, literal);
    solver.solve(&[wanted], u64::MAX)
}
