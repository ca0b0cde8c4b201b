//! The simulation of a swarm as plain data: bodies, wires and inputs go in, the robots' bits come out.

use serde::{Deserialize, Serialize};

use crate::bit_rows;
use crate::sensing::Sensing;
use crate::{Assembly, Flip, Member, StimulusSource, SwarmConditions, SwarmTrace, simulate};
use nbc_base::model::{Body, Character, Column, Displacements, Fault, PhysicsWorld, Provenance, Robot, bodies};
use nbc_sim::Simulator;

/// The simulation of a swarm, without names: all that the resulting bits depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct SwarmTask {
    pub assembly: Assembly,
    pub conditions: SwarmConditions,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SwarmBits {
    /// The cycles in order; fewer than those of the task if it was stopped or a robot failed.
    #[serde(with = "bit_rows")]
    pub cycles: Vec<Vec<bool>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub flips: Vec<Flip>,
    pub fault: Option<(usize, Fault)>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct PlainMember {
    pub body: Body,
    pub clock: u32,
    pub senses: Vec<StimulusSource>,
    pub start: bool,
    /// What it senses in the first cycles instead of each source.
    pub held: Vec<Vec<bool>>,
}

#[derive(Serialize, Deserialize)]
struct Written {
    #[serde(with = "bodies")]
    bodies: Vec<Body>,
    members: Vec<WrittenMember>,
    world: PhysicsWorld,
    window: usize,
    beat: u32,
    #[serde(with = "bit_rows")]
    inputs: Vec<Vec<bool>>,
}

#[derive(Serialize, Deserialize)]
struct WrittenMember {
    clock: u32,
    senses: Vec<StimulusSource>,
    start: bool,
    #[serde(with = "bit_rows")]
    held: Vec<Vec<bool>>,
}

impl From<SwarmTask> for Written {
    fn from(SwarmTask { assembly, conditions }: SwarmTask) -> Self {
        let (mut bodies, mut members) = (Vec::new(), Vec::new());
        for Member { robot, senses, start, held, .. } in assembly.members {
            bodies.push(robot.body);
            members.push(WrittenMember { clock: robot.character.clock, senses, start, held });
        }
        let SwarmConditions { inputs, window, .. } = conditions;
        Self { bodies, members, world: assembly.world, window, beat: assembly.beat, inputs }
    }
}

impl TryFrom<Written> for SwarmTask {
    type Error = &'static str;

    fn try_from(written: Written) -> Result<Self, Self::Error> {
        let Written { bodies, members, world, window, beat, inputs } = written;
        let (width, robots) = (inputs.first().map_or(0, Vec::len), members.len());
        let is_there = |source: &StimulusSource| match *source {
            StimulusSource::Input(place) => place < width,
            StimulusSource::Robot(place) => place < robots,
            StimulusSource::Constant(_) => true,
        };
        let is_wired = |member: &WrittenMember| {
            matches!(member.senses.len(), 2 | 3)
                && member.held.len() == member.senses.len()
                && member.senses.iter().all(is_there)
        };
        let is_even = bodies.len() == robots && inputs.iter().all(|cycle| cycle.len() == width);
        if !is_even || window == 0 || beat == 0 || !members.iter().all(is_wired) {
            return Err("a swarm that cannot be simulated");
        }
        let member = |(body, member): (Body, WrittenMember)| {
            let WrittenMember { clock, senses, start, held } = member;
            PlainMember { body, clock, senses, start, held }
        };
        let mut task = Self::new(bodies.into_iter().zip(members).map(member).collect(), world, inputs, window);
        task.assembly.beat = beat;
        Ok(task)
    }
}

impl SwarmTask {
    /// `inputs` are the bits of the input ports in each cycle; displacements are measured over `window` cycles.
    pub fn of(assembly: &Assembly, inputs: Vec<Vec<bool>>, window: usize) -> Self {
        let plain = |member: &Member| PlainMember {
            body: member.robot.body.clone(),
            clock: member.robot.character.clock,
            senses: member.senses.clone(),
            start: member.start,
            held: member.held.clone(),
        };
        let members = assembly.members.iter().map(plain).collect();
        let task = Self::new(members, assembly.world, inputs, window);
        Self { assembly: Assembly { beat: assembly.beat, ..task.assembly }, ..task }
    }

    pub fn new(members: Vec<PlainMember>, world: PhysicsWorld, inputs: Vec<Vec<bool>>, window: usize) -> Self {
        let width = inputs.first().map_or(0, Vec::len);
        let ports = (width > 0).then(|| Column::new("", width));
        let assembly = Assembly {
            circuit: String::new(),
            inputs: ports.into_iter().collect(),
            members: members.into_iter().map(PlainMember::nameless).collect(),
            outputs: Vec::new(),
            shown: Vec::new(),
            beat: 1,
            world,
        };
        Self { assembly, conditions: SwarmConditions { inputs, window, poses: None } }
    }

    pub fn robots(&self) -> usize {
        self.assembly.members.len()
    }

    pub fn cycles(&self) -> usize {
        self.conditions.inputs.len()
    }
}

impl PlainMember {
    pub(super) fn nameless(self) -> Member {
        let displacement = Displacements::zero(self.senses.len());
        let robot = Robot {
            name: String::new(),
            behavior: displacement.behavior(),
            body: self.body,
            displacement,
            character: Character { clock: self.clock, ..Character::default() },
            provenance: Provenance::default(),
            genotype: None,
        };
        let (net, block) = (String::new(), Vec::new());
        Member { net, block, robot, senses: self.senses, start: self.start, held: self.held }
    }
}

impl SwarmBits {
    pub fn simulate(simulator: &Simulator, task: &SwarmTask) -> Self {
        let trace = simulate(simulator, &task.assembly, &task.conditions, &mut |_| ());
        let fault = trace.first_fault();
        Self { fault, flips: trace.flips, cycles: trace.cycles.into_iter().map(|cycle| cycle.bits).collect() }
    }

    pub fn trace(&self, assembly: &Assembly, inputs: &[Vec<bool>]) -> SwarmTrace {
        let mut trace = Sensing::replayed(assembly, &self.cycles, &self.flips, inputs).1;
        if let Some((robot, fault)) = self.fault {
            trace.robots[robot].fault = Some(fault);
        }
        trace
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::{GroundProfile, Palette, WorldFactors, WorldNoise};

    fn latch() -> Assembly {
        let body = Body::parse(&["343", "563"], &Palette::paper()).unwrap();
        let member = |net: &str, senses: [StimulusSource; 2], start| {
            let (senses, held) = (senses.to_vec(), vec![vec![true; 3], Vec::new()]);
            let plain = PlainMember { body: body.clone(), clock: 3, senses, start, held };
            Member { net: net.to_owned(), ..plain.nameless() }
        };
        let column = |name: &str| Column::new(name, 1);
        Assembly {
            circuit: "latch".to_owned(),
            inputs: vec![column("s"), column("r")],
            members: vec![
                member("q", [StimulusSource::Input(0), StimulusSource::Robot(1)], true),
                member("nq", [StimulusSource::Robot(0), StimulusSource::Input(1)], false),
            ],
            outputs: vec![column("q"), column("s")],
            shown: vec![StimulusSource::Robot(0), StimulusSource::Input(0)],
            beat: 2,
            world: PhysicsWorld::default(),
        }
        .in_world(PhysicsWorld {
            factors: WorldFactors { friction: 0.9, ..WorldFactors::default() },
            noise: WorldNoise { start: 0.5, missed: 0.4, weak: 0.1, dead: 0.1, seed: 3, ..WorldNoise::default() },
            ground: GroundProfile::new(&[0, 0, 0, 2]).unwrap(),
            ..PhysicsWorld::default()
        })
    }

    #[test]
    fn the_trace_of_bits_is_that_of_the_swarm_without_paths() {
        let (assembly, simulator) = (latch(), Simulator::default());
        let inputs: Vec<Vec<bool>> = (0..6).map(|cycle| vec![cycle % 2 == 0, cycle > 2]).collect();
        for window in [1, 2] {
            let conditions = SwarmConditions { inputs: inputs.clone(), window, poses: None };
            let full = simulate(&simulator, &assembly, &conditions, &mut |_| ());
            let bits = SwarmBits::simulate(&simulator, &SwarmTask::of(&assembly, inputs.clone(), window));
            let trace = bits.trace(&assembly, &inputs);
            assert_eq!((trace.cycles, trace.shown, trace.inputs), (full.cycles, full.shown, full.inputs));
            let without_path = |robot: &crate::RobotTrace| {
                let (com_x, fault) = (Vec::new(), None);
                crate::RobotTrace { com_x, fault, ..robot.clone() }
            };
            assert_eq!(trace.robots, full.robots.iter().map(without_path).collect::<Vec<_>>());
        }
    }
}
