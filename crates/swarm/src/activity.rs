//! The activity of a swarm's outputs in a simulation. Simulations have no expected outputs.

use serde::Serialize;

use crate::{RobotFault, SwarmTrace, WeakRobot};
use nbc_base::model::{Column, Simulation, Value};

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SimulationResult {
    pub file: String,
    pub line: usize,
    /// The circuit's name, with the values of its parameters.
    pub circuit: String,
    pub swarm: String,
    pub world: String,
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    pub weak_robots: Vec<WeakRobot>,
    /// The rows of the schedule in order, as far as they were completed.
    pub rows: Vec<RowActivity>,
    /// The robot that failed, so that the swarm had no outputs from then on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<RobotFault>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RowActivity {
    /// Its number among the rows of the schedule, from 1.
    pub row: usize,
    pub line: usize,
    pub inputs: Vec<Value>,
    /// Cycles for which they were held.
    pub cycles: usize,
    /// The values of the output ports at the end.
    pub observed: Vec<Value>,
    /// The number of changes of each output port from one cycle to the next.
    pub changes: Vec<usize>,
    /// The last cycle of the simulation, from 1, in which each output port changed; `None` if it did not change during
    /// the row.
    pub last_change: Vec<Option<usize>>,
}

/// The activity of the outputs, row by row. If the trace ends early, only complete rows are included.
pub fn activity(simulation: &Simulation, trace: &SwarmTrace) -> Vec<RowActivity> {
    let mut start = 0;
    let row = |(at, spell): (usize, &nbc_base::model::InputSpell)| {
        let cycles = start..start + spell.cycles as usize;
        start = cycles.end;
        if cycles.end > trace.cycles.len() {
            return None;
        }
        let outputs = |cycle: usize| trace.output_values(cycle);
        // The first cycle has no cycle before it.
        let changed = |port: usize| {
            cycles.clone().filter(move |&cycle| cycle > 0 && outputs(cycle - 1)[port] != outputs(cycle)[port])
        };
        let ports = 0..trace.outputs.len();
        Some(RowActivity {
            row: at + 1,
            line: spell.line,
            inputs: Value::of_ports(&trace.inputs, spell.inputs.iter().copied().map(Some), &spell.bases),
            cycles: cycles.len(),
            observed: cycles.end.checked_sub(1).map_or(Vec::new(), outputs),
            changes: ports.clone().map(|port| changed(port).count()).collect(),
            last_change: ports.map(|port| changed(port).next_back().map(|cycle| cycle + 1)).collect(),
        })
    };
    simulation.spells.iter().enumerate().map_while(row).collect()
}
