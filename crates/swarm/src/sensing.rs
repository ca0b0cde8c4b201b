//! The stimuli of the robots of a swarm, which follow from the outputs of other robots.

use crate::noise::RobotNoise;
use crate::{Assembly, CycleTrace, Flip, RobotTrace, StimulusSource, SwarmTrace};
use nbc_base::model::{CYCLE_STEPS, Pattern, WorldNoise};

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sensing {
    /// Env steps at the start in which robots sense the start values of the others.
    start: u32,
    /// In env steps.
    beat: u32,
    outputs: Vec<bool>,
    /// The stimuli of each robot; empty before the first cycle.
    pub sensed: Vec<Pattern>,
    held: Vec<Vec<Vec<bool>>>,
    noise: WorldNoise,
}

impl Sensing {
    pub fn of(assembly: &Assembly) -> Self {
        let outputs = assembly.members.iter().map(|member| member.start).collect();
        Self {
            start: assembly.start_cycles() as u32 * CYCLE_STEPS,
            beat: assembly.beat * CYCLE_STEPS,
            outputs,
            sensed: Vec::new(),
            held: assembly.members.iter().map(|member| member.held.clone()).collect(),
            noise: assembly.world.noise,
        }
    }

    /// What its robots sense in these first cycles, and its trace without their paths.
    pub fn replayed(
        assembly: &Assembly,
        cycles: &[Vec<bool>],
        flips: &[Flip],
        inputs: &[Vec<bool>],
    ) -> (Self, SwarmTrace) {
        let mut trace = SwarmTrace::begin(assembly);
        let mut sensing = Self::of(assembly);
        let mut heard = vec![false; assembly.members.len()];
        let mut flips_left = flips;
        for (bits, inputs) in cycles.iter().zip(inputs) {
            let cycle = trace.cycles.len();
            let end = (cycle + 1) as u32 * CYCLE_STEPS;
            sensing.sense(&trace, cycle, inputs);
            let sensed = sensing.sensed.clone();
            let within = flips_left.partition_point(|flip| flip.env_step < end);
            for together in flips_left[..within].chunk_by(|one, next| one.env_step == next.env_step) {
                together.iter().for_each(|flip| heard[flip.robot] ^= true);
                sensing.take(together[0].env_step, &heard);
                sensing.sense(&trace, cycle, inputs);
            }
            flips_left = &flips_left[within..];
            sensing.take(end, bits);
            heard.clone_from(bits);
            let outputs = trace.shown.iter().map(|&signal| signal.bit(inputs, bits)).collect();
            let inputs = inputs.clone();
            trace.cycles.push(CycleTrace { inputs, sensed, bits: bits.clone(), outputs });
        }
        trace.flips = flips.to_vec();
        (sensing, trace)
    }

    /// Finds the stimuli of each robot in the cycle with this number, from 0, with these bits on the input ports.
    pub fn sense(&mut self, trace: &SwarmTrace, cycle: usize, inputs: &[bool]) {
        let sensed = |(robot, trace): (usize, &RobotTrace)| match self.sensed.get(robot) {
            Some(&before) if RobotNoise::new(&self.noise, robot).misses(cycle) => before,
            _ => {
                let stimulus = |(source, held): (&StimulusSource, &Vec<bool>)| {
                    held.get(cycle).copied().unwrap_or_else(|| source.bit(inputs, &self.outputs))
                };
                Pattern::of(trace.senses.iter().zip(&self.held[robot]).map(stimulus))
            }
        };
        self.sensed = trace.robots.iter().enumerate().map(sensed).collect();
    }

    /// Takes the outputs as they are after this many env steps.
    pub fn take(&mut self, env_steps: u32, bits: &[bool]) {
        if env_steps >= self.start && (!env_steps.is_multiple_of(CYCLE_STEPS) || env_steps.is_multiple_of(self.beat)) {
            self.outputs.clear();
            self.outputs.extend_from_slice(bits);
        }
    }
}
