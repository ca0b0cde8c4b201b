//! An identifier of a program's physics. All machines that work for a search must have the same.

use std::fmt;

use nbc_base::fnv::Fnv;
use nbc_base::model::{Body, ImageOrder, Pattern, PhysicsWorld, Schedule, SearchObjective, Setting, Spell, Trial};
use nbc_sim::Simulator;
use nbc_swarm::evolve::Rivals;
use nbc_swarm::{EvaluationProtocol, EvaluationTask, evaluate_tasks};

pub const PROGRAM: &str = nbc_base::VERSION;
const STEPS: u32 = 8;
const BODIES: usize = 2;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PhysicsId(pub u64);

impl fmt::Display for PhysicsId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl PhysicsId {
    /// The hash of the bits of two short trajectories, and of the evaluations of their bodies.
    pub fn compute(simulator: &Simulator) -> Self {
        let bodies: Vec<Body> = (0..BODIES).map(|shift| Body::patchwork(5, shift)).collect();
        let schedule = Schedule { spells: Pattern::PAIRS.map(|pattern| Spell::of(pattern, STEPS)).to_vec() };
        let trial = |body: &Body| Trial { body: body.clone(), schedule: schedule.clone() };
        let trials: Vec<Trial> = bodies.iter().map(trial).collect();
        let mut hash = Fnv::default();
        for trajectory in simulator.run_trials(&Setting::default(), &trials) {
            let numbers = trajectory.com_x.iter().chain(&trajectory.com_y);
            numbers.for_each(|number| hash.add(&number.to_bits().to_le_bytes()));
        }
        let tasks: Vec<EvaluationTask> =
            bodies.into_iter().map(|body| EvaluationTask { body, rivals: Rivals::none(2), expected: None }).collect();
        let (objective, behaviors, world) = (SearchObjective::Distance, Vec::new(), PhysicsWorld::default());
        let protocol = EvaluationProtocol {
            stimuli: 2,
            objective,
            behaviors,
            variable: schedule,
            shown: ImageOrder::Apart,
            fixed_steps: STEPS,
            world,
            others: Vec::new(),
        };
        hash.add(format!("{:?}", evaluate_tasks(simulator, &protocol, &tasks)).as_bytes());
        Self(hash.value())
    }

    /// The part of a subject that separates programs with different physics or versions.
    pub fn token(self) -> String {
        format!("{}-{self}", PROGRAM.replace('.', "_"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_sim::{Kernel, LaneBackend};

    #[test]
    fn every_kernel_has_the_same_physics() {
        let scalar = Simulator::new(LaneBackend { kernel: Kernel::SCALAR, ..LaneBackend::default() });
        assert_eq!(PhysicsId::compute(&scalar), PhysicsId::compute(&Simulator::default()));
    }
}
