//! Simulations: a declared swarm under a schedule of its inputs, without a demand on its outputs.

use crate::diag::Diagnostic;
use crate::model::{CYCLE_STEPS, Program, Simulation};
use crate::pipeline::{Options, SwarmRun, compile, plan};
use crate::swarm::{self, Exposure, SimulationResult};

/// A simulation with what came of it.
#[derive(Clone, Debug)]
pub struct SimulationRun {
    /// What the outputs did.
    pub result: SimulationResult,
    /// What the swarm did.
    pub swarm: SwarmRun,
    /// What is legal and surely not meant.
    pub warnings: Vec<Diagnostic>,
}

/// Runs a simulation in full physics, calling `observe` with the cycles done and the cycles in all after each.
///
/// # Errors
/// When the swarm's circuit cannot be compiled, or its robots cannot be read.
///
/// # Panics
/// When the simulation is of another program.
pub fn run_simulation(
    program: &Program,
    simulation: &Simulation,
    options: &Options,
    observe: &mut dyn FnMut(usize, usize),
) -> Result<SimulationRun, Vec<Diagnostic>> {
    let swarm = program.swarm(&simulation.swarm).expect("a simulation names a swarm of its program");
    let compiled = compile(program, plan(program, &swarm.circuit, Some(swarm), options)?, simulation.span)?;
    let held = simulation.spells.iter().flat_map(|spell| std::iter::repeat_n(&spell.inputs, spell.cycles as usize));
    let window = compiled.plan.window as usize;
    let exposure = Exposure { inputs: held.cloned().collect(), cycle_steps: CYCLE_STEPS, window };
    let cycles = exposure.inputs.len();
    let trace = swarm::simulate(&options.simulator, &compiled.assembly, &exposure, &mut |done| observe(done, cycles));
    let result = SimulationResult {
        file: simulation.file.clone(),
        line: simulation.line,
        circuit: swarm.circuit.to_string(),
        swarm: swarm.name.clone(),
        inputs: trace.inputs.clone(),
        outputs: trace.outputs.clone(),
        weak_robots: compiled.weak_robots.clone(),
        rows: swarm::activity(simulation, &trace),
    };
    let warnings = compiled.warnings.clone();
    Ok(SimulationRun { result, swarm: SwarmRun { compiled, trace }, warnings })
}
