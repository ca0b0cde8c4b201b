//! The trace of a swarm: every robot's path, and every net's bit in every cycle.

use serde::{Deserialize, Serialize};

use crate::{Assembly, Member, Recording, RobotFault, StimulusSource};
use nbc_base::model::{CYCLE_STEPS, Column, Fault, Function, Pattern, Value};

/// A swarm's run from its start to the end of its stimulation, or to the cycle in which a robot failed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SwarmTrace {
    pub circuit: String,
    pub inputs: Vec<Column>,
    pub outputs: Vec<Column>,
    pub shown: Vec<StimulusSource>,
    pub samples_per_cycle: usize,
    pub robots: Vec<RobotTrace>,
    /// The cycles, first to last. One in which a robot failed has no outputs and is not among them.
    pub cycles: Vec<CycleTrace>,
    /// The outputs that changed within cycles, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub flips: Vec<Flip>,
    #[serde(skip)]
    pub recording: Recording,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobotTrace {
    pub net: String,
    /// The names of the calls that the robot comes from, the outermost first.
    #[serde(skip)]
    pub block: Vec<String>,
    #[serde(serialize_with = "as_text")]
    pub function: Function,
    pub robot: String,
    pub senses: Vec<StimulusSource>,
    pub sensed_nets: Vec<String>,
    /// Horizontal place of the center of mass in voxels: the start, then `samples_per_cycle` samples a cycle.
    pub com_x: Vec<f64>,
    pub fault: Option<Fault>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CycleTrace {
    pub inputs: Vec<bool>,
    pub sensed: Vec<Pattern>,
    /// Each robot's output at the cycle's end.
    pub bits: Vec<bool>,
    pub outputs: Vec<bool>,
}

/// The change of a robot's output within a cycle of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Flip {
    /// The env steps from the start of the simulation.
    pub env_step: u32,
    pub robot: usize,
}

impl SwarmTrace {
    pub(super) const SAMPLES_PER_CYCLE: usize = 12;

    pub(super) fn begin(assembly: &Assembly) -> Self {
        let robot = |member: &Member| RobotTrace {
            net: member.net.clone(),
            block: member.block.clone(),
            function: member.robot.function(),
            robot: member.robot.name.clone(),
            senses: member.senses.clone(),
            sensed_nets: member.senses.iter().map(|&source| assembly.source_name(source)).collect(),
            com_x: Vec::new(),
            fault: None,
        };
        Self {
            circuit: assembly.circuit.clone(),
            inputs: assembly.inputs.clone(),
            outputs: assembly.outputs.clone(),
            shown: assembly.shown.clone(),
            samples_per_cycle: Self::SAMPLES_PER_CYCLE,
            robots: assembly.members.iter().map(robot).collect(),
            cycles: Vec::new(),
            flips: Vec::new(),
            recording: Recording::default(),
        }
    }

    pub fn input_values(&self, cycle: usize) -> Vec<Value> {
        Value::of_ports(&self.inputs, self.cycles[cycle].inputs.iter().copied().map(Some), &[])
    }

    pub fn forget_first(&mut self, cycles: usize) {
        self.cycles.drain(..cycles);
        self.flips.clear();
        for robot in &mut self.robots {
            robot.com_x.drain(..cycles * self.samples_per_cycle);
        }
    }

    pub(super) fn first_fault(&self) -> Option<(usize, Fault)> {
        let faults = self.robots.iter().enumerate().filter_map(|(k, robot)| Some((k, robot.fault?)));
        faults.min_by_key(|(_, fault)| fault.env_step)
    }

    pub fn fault(&self) -> Option<RobotFault> {
        let (k, Fault { env_step, kind }) = self.first_fault()?;
        let RobotTrace { net, robot, .. } = &self.robots[k];
        let cycle = (env_step.saturating_sub(1) / CYCLE_STEPS) as usize;
        Some(RobotFault { net: net.clone(), robot: robot.clone(), cycle, env_step, kind })
    }

    pub(super) fn forget_unfinished(&mut self, start: u32) {
        self.flips.retain(|flip| flip.env_step <= start);
        for robot in &mut self.robots {
            robot.com_x.truncate(robot.com_x.len() - self.samples_per_cycle);
        }
        self.recording.forget_cycle();
    }

    pub fn displacement(&self, k: usize, cycle: usize) -> f64 {
        let path = &self.robots[k].com_x;
        path[(cycle + 1) * self.samples_per_cycle] - path[cycle * self.samples_per_cycle]
    }

    /// Those shown by outputs, then those of named nets (outer ones before those inside circuits), then the others.
    pub fn by_interest(&self) -> Vec<usize> {
        let rank = |robot: usize| {
            let net = &self.robots[robot].net;
            let is_shown = self.shown.contains(&StimulusSource::Robot(robot));
            (!is_shown, is_unnamed(net), net.matches('/').count())
        };
        let mut robots: Vec<usize> = (0..self.robots.len()).collect();
        robots.sort_by_key(|&robot| rank(robot));
        robots
    }

    pub fn output_values(&self, cycle: usize) -> Vec<Value> {
        Value::of_ports(&self.outputs, self.cycles[cycle].outputs.iter().copied().map(Some), &[])
    }
}

/// Whether a net has a compiler-made name: `n` and a number.
fn is_unnamed(net: &str) -> bool {
    net.strip_prefix('n').is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_digit()))
}

fn as_text<S: serde::Serializer>(value: &impl std::fmt::Display, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(value)
}
