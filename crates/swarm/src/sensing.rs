//! The stimuli of the robots of a swarm, which follow from the outputs of other robots.

use crate::noise::RobotNoise;
use crate::{Assembly, CycleTrace, StimulusSource, SwarmTrace};
use nbc_base::model::{Pattern, WorldNoise};

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sensing {
    /// Cycles at the start in which robots sense the start values of the others.
    start: usize,
    beat: usize,
    outputs: Vec<bool>,
    held: Vec<Vec<Vec<bool>>>,
    noise: WorldNoise,
}

impl Sensing {
    pub fn of(assembly: &Assembly) -> Self {
        let outputs = assembly.members.iter().map(|member| member.start).collect();
        Self {
            start: assembly.start_cycles(),
            beat: assembly.beat as usize,
            outputs,
            held: assembly.members.iter().map(|member| member.held.clone()).collect(),
            noise: assembly.world.noise,
        }
    }

    /// What its robots sense in these first cycles, and its trace without their paths.
    pub fn replayed(assembly: &Assembly, cycles: &[Vec<bool>], inputs: &[Vec<bool>]) -> (Self, SwarmTrace) {
        let mut trace = SwarmTrace::begin(assembly);
        let mut sensing = Self::of(assembly);
        for (bits, inputs) in cycles.iter().zip(inputs) {
            let sensed = sensing.sense(&trace, trace.cycles.len(), inputs);
            sensing.take(trace.cycles.len(), bits);
            let outputs = trace.shown.iter().map(|&signal| signal.bit(inputs, bits)).collect();
            trace.cycles.push(CycleTrace { inputs: inputs.clone(), sensed, bits: bits.clone(), outputs });
        }
        (sensing, trace)
    }

    /// The stimuli of each robot during the cycle with this number, from 0, with these bits on the input ports.
    pub fn sense(&self, trace: &SwarmTrace, cycle: usize, inputs: &[bool]) -> Vec<Pattern> {
        (0..trace.robots.len()).map(|robot| self.sensed(trace, cycle, robot, inputs)).collect()
    }

    fn sensed(&self, trace: &SwarmTrace, cycle: usize, robot: usize, inputs: &[bool]) -> Pattern {
        match trace.cycles.last() {
            Some(last) if RobotNoise::new(&self.noise, robot).misses(cycle) => last.sensed[robot],
            _ => {
                let stimulus = |(source, held): (&StimulusSource, &Vec<bool>)| {
                    held.get(cycle).copied().unwrap_or_else(|| source.bit(inputs, &self.outputs))
                };
                let senses = trace.robots[robot].senses.iter().zip(&self.held[robot]);
                Pattern::of(senses.map(stimulus))
            }
        }
    }

    pub fn take(&mut self, cycle: usize, bits: &[bool]) {
        if cycle + 1 >= self.start && (cycle + 1).is_multiple_of(self.beat) {
            self.outputs.clear();
            self.outputs.extend_from_slice(bits);
        }
    }
}
