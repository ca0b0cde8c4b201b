//! A part of a live swarm's run, simulated again with its poses recorded, for pictures and pages.

use crate::compiled::Compiled;
use crate::observer::Observer;
use crate::simulation::{self, SimulationRun};
use crate::swarm_run::{DrivenSwarm, LIVE_CYCLES, Physics};
use nbc_base::model::{InputSpell, Simulation};
use nbc_base::source::{FileId, Span};
use nbc_swarm::{Room, SwarmSnapshot};

#[derive(Clone, Debug)]
pub struct Excerpt {
    pub compiled: Compiled,
    pub start: SwarmSnapshot,
    pub inputs: Vec<Vec<bool>>,
}

pub(super) fn replay(physics: &Physics, excerpt: &Excerpt, observer: &mut dyn Observer) -> SimulationRun {
    let Excerpt { compiled, start, inputs } = excerpt;
    // The robots are where they were in their world, so this is the world of live swarms.
    let mut swarm = physics.swarm(compiled, LIVE_CYCLES);
    swarm.restore(start);
    swarm.record(Room::SWARM, inputs.len());
    let before = swarm.trace().cycles.len();
    let (mut trace, end) = DrivenSwarm::new(swarm, inputs.clone()).run(&compiled.assembly, observer);
    trace.forget_first(before);
    simulation::finish(&simulation(excerpt), compiled.clone(), trace, end)
}

fn simulation(excerpt: &Excerpt) -> Simulation {
    let plan = &excerpt.compiled.plan;
    let spell = |same: &[Vec<bool>]| InputSpell {
        inputs: same[0].clone(),
        bases: Vec::new(),
        cycles: same.len() as u32,
        line: 0,
    };
    Simulation {
        swarm: plan.swarm.clone().unwrap_or_else(|| plan.circuit.to_string()),
        circuit: plan.circuit.clone(),
        span: Span::new(FileId(0), 0, 0),
        file: String::new(),
        line: 0,
        inputs: excerpt.compiled.assembly.inputs.clone(),
        spells: excerpt.inputs.chunk_by(|a, b| a == b).map(spell).collect(),
        world: None,
    }
}
