//! The plan of a circuit's swarm: the declared swarm with its robots, hold and window.

use crate::choice::{check_swarm_is_clear, declared_swarm, swarms_of};
use crate::mapping::Mapping;
use crate::options::CompileOptions;
use crate::robots::RobotSources;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Hold, Instance, Library, NamedWorld, Program, RegisterStyle, Swarm, WaveTimes};
use nbc_circuit::Timing;
use nbc_lang::check::DEFAULT_LIBRARY;

#[derive(Clone, Debug)]
pub struct Plan {
    pub circuit: Instance,
    pub swarm: Option<String>,
    pub library: Library,
    /// For rows without a hold of their own.
    pub hold: Hold,
    pub window: u32,
    pub registers: RegisterStyle,
    pub waves: WaveTimes,
    pub world: NamedWorld,
}

pub(super) fn plans(
    sources: RobotSources<'_>,
    program: &Program,
    circuit: &Instance,
    options: &CompileOptions,
) -> Result<Vec<Plan>, Vec<Diagnostic>> {
    let swarms = swarms_of(program, circuit);
    match (&options.swarm, &swarms[..]) {
        (Some(name), swarms) => {
            let swarm = chosen(program, circuit, name, swarms).map_err(|fault| vec![fault])?;
            Ok(vec![of_swarm(sources, program, circuit, Some(swarm), options)?])
        }
        (None, []) => Ok(vec![of_swarm(sources, program, circuit, None, options)?]),
        (None, swarms) => {
            swarms.iter().map(|swarm| of_swarm(sources, program, circuit, Some(swarm), options)).collect()
        }
    }
}

pub(super) fn plan(
    sources: RobotSources<'_>,
    program: &Program,
    circuit: &Instance,
    options: &CompileOptions,
) -> Result<Plan, Vec<Diagnostic>> {
    check_swarm_is_clear(program, circuit, options.swarm.as_deref()).map_err(|fault| vec![fault])?;
    Ok(plans(sources, program, circuit, options)?.remove(0))
}

pub(super) fn of_swarm(
    sources: RobotSources<'_>,
    program: &Program,
    circuit: &Instance,
    declaration: Option<&Swarm>,
    options: &CompileOptions,
) -> Result<Plan, Vec<Diagnostic>> {
    let library = robots(sources, program, declaration.map(|swarm| swarm.library.as_str()), options)?;
    let plan = Plan {
        circuit: circuit.clone(),
        swarm: declaration.map(|swarm| swarm.name.clone()),
        library: nbc_swarm::prefer(library, options.objective),
        hold: declaration.map_or(Hold::Auto, |swarm| swarm.hold),
        window: declaration.map_or(1, |swarm| swarm.window),
        registers: declaration.map_or(RegisterStyle::default(), |swarm| swarm.registers),
        waves: declaration.map_or(WaveTimes::default(), |swarm| swarm.waves),
        world: NamedWorld::default(),
    };
    Ok(plan.in_world(declaration.map_or_else(|| program.default_world(), |swarm| swarm.world.clone())))
}

impl Plan {
    /// Where robots are heard in their own time, their clocks are longer.
    pub(super) fn in_world(mut self, world: NamedWorld) -> Self {
        for robot in &mut self.library.robots {
            let clock = &mut robot.character.clock;
            *clock = *clock + world.world.lateness() - self.world.world.lateness();
        }
        Self { world, ..self }
    }

    pub(super) fn timing(&self, mapping: &Mapping) -> Timing {
        let mut timing = mapping.timing();
        timing.hold = self.stretched(timing.hold as usize) as u32;
        timing
    }

    /// Cycles of the world in which each robot makes so many of its own.
    pub(super) fn stretched(&self, cycles: usize) -> usize {
        (cycles as f64 * (1.0 + self.world.world.noise.drift)).ceil() as usize
    }
}

pub(super) fn robots(
    sources: RobotSources<'_>,
    program: &Program,
    library: Option<&str>,
    options: &CompileOptions,
) -> Result<Library, Vec<Diagnostic>> {
    let mut library = match (&options.robots, program.library(library.unwrap_or(DEFAULT_LIBRARY))) {
        (Some(robots), _) => robots.clone(),
        (None, Some(declared)) => sources.library(declared, &options.runs)?,
        (None, None) => sources.built_in.shipped().clone(),
    };
    library.robots.retain(|robot| !options.without.contains(&robot.name));
    Ok(library)
}

fn chosen<'p>(
    program: &'p Program,
    circuit: &Instance,
    name: &str,
    swarms: &[&'p Swarm],
) -> Result<&'p Swarm, Diagnostic> {
    let swarm = declared_swarm(program, name)?;
    if swarms.iter().any(|one| one.name == swarm.name) {
        return Ok(swarm);
    }
    Err(wording::swarm_of_other_circuit(name, &swarm.circuit.to_string(), &circuit.to_string()))
}
