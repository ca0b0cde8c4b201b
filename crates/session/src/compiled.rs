//! The plan of a circuit's swarm, and the swarm.

use crate::mapping::Mapping;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Hold, Instance, Library, NamedWorld, RegisterStyle, WaveTimes};
use nbc_circuit::Timing;
use nbc_swarm::{Assembly, WeakRobot};

/// A declared swarm with its robots.
#[derive(Clone, Debug, PartialEq)]
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

/// A circuit compiled to a swarm.
#[derive(Clone, Debug)]
pub struct Compiled {
    pub plan: Plan,
    pub mapping: Mapping,
    pub timing: Timing,
    pub assembly: Assembly,
    pub weak_robots: Vec<WeakRobot>,
    pub warnings: Vec<Diagnostic>,
}

impl Compiled {
    pub(super) fn clocks(&self) -> Vec<u32> {
        self.assembly.members.iter().map(|member| member.robot.character.clock).collect()
    }

    pub(super) fn in_world(&self, world: NamedWorld) -> Self {
        let mut moved = Self { plan: self.plan.clone().in_world(world), ..self.clone() };
        for member in &mut moved.assembly.members {
            let own = moved.plan.library.robots.iter().find(|robot| robot.name == member.robot.name);
            let own = own.expect("a member is of the library");
            member.robot.body.clone_from(&own.body);
            member.robot.character.clock = own.character.clock;
        }
        if self.pace() != moved.pace() {
            moved.mapping.cells = nbc_swarm::cells(&moved.plan.library);
            moved.timing = moved.plan.timing(&moved.mapping);
        }
        Self { assembly: moved.assembly.in_world(moved.plan.world.world), ..moved }
    }

    /// All of its world on which the times of its robots depend.
    pub(super) fn pace(&self) -> (u32, f64) {
        let world = &self.plan.world.world;
        (world.lateness(), world.noise.drift)
    }
}
