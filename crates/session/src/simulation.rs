//! Simulations: a declared swarm under a schedule of its inputs, without expected outputs.

use crate::checked::Checked;
use crate::compiled::Compiled;
use crate::observer::Observer;
use crate::options::CompileOptions;
use crate::swarm_run::{Physics, RunEnd, SwarmRun};
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::Simulation;
use nbc_swarm::{SimulationResult, SwarmTrace};

/// A simulation with its results.
#[derive(Clone, Debug)]
pub struct SimulationRun {
    pub result: SimulationResult,
    pub end: RunEnd,
    pub swarm: SwarmRun,
    pub warnings: Vec<Diagnostic>,
}

impl SimulationRun {
    pub fn passed(&self) -> bool {
        self.result.fault.is_none()
    }
}

pub(super) fn compiled(
    checked: &Checked,
    simulation: &Simulation,
    options: &CompileOptions,
) -> Result<Compiled, Diagnostics> {
    let swarm = checked.program.swarm(&simulation.swarm);
    checked.diagnosed(checked.plan_of(&simulation.circuit, swarm, options).and_then(|mut plan| {
        plan.world = simulation.world.clone().unwrap_or(plan.world);
        checked.compiled(plan, options, simulation.span)
    }))
}

pub(super) fn run(
    physics: &Physics,
    simulation: &Simulation,
    compiled: Compiled,
    observer: &mut dyn Observer,
) -> SimulationRun {
    let held = simulation.spells.iter().flat_map(|spell| std::iter::repeat_n(&spell.inputs, spell.cycles as usize));
    let (trace, end) = physics.run(&compiled, held.cloned().collect(), observer);
    finish(simulation, compiled, trace, end)
}

pub(super) fn finish(simulation: &Simulation, compiled: Compiled, trace: SwarmTrace, end: RunEnd) -> SimulationRun {
    let result = SimulationResult {
        file: simulation.file.clone(),
        line: simulation.line,
        circuit: compiled.plan.circuit.to_string(),
        swarm: simulation.swarm.clone(),
        world: compiled.plan.world.name.clone(),
        inputs: trace.inputs.clone(),
        outputs: trace.outputs.clone(),
        weak_robots: compiled.weak_robots.clone(),
        rows: nbc_swarm::activity(simulation, &trace),
        fault: trace.fault(),
    };
    let warnings = compiled.warnings.clone();
    SimulationRun { result, end, swarm: SwarmRun { compiled, trace }, warnings }
}
