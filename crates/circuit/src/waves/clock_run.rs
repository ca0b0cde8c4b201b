//! A clocked circuit step by step at the level of logic, in 64 lanes at once. It is much faster than [`crate::Logic`],
//! because the cells of registers are not simulated, and every gate is computed once.

use crate::waves::ClockStep;

/// The number of lanes: bit `k` of a value is that of lane `k`, which knows nothing of the others.
pub const LANES: usize = 64;

#[derive(Clone, Debug)]
pub struct ClockRun {
    step: ClockStep,
    /// The input ports, the clock included, and then the state.
    inputs: Vec<u64>,
    values: Vec<u64>,
}

impl ClockRun {
    pub fn new(step: ClockStep) -> Self {
        let ports = step.inputs.iter().map(|_| 0);
        let inputs = ports.chain(step.state.iter().map(|bit| if bit.start { !0 } else { 0 })).collect();
        let mut run = Self { step, inputs, values: Vec::new() };
        run.compute();
        run
    }

    pub fn step(&self) -> &ClockStep {
        &self.step
    }

    /// In order of the ports. The value of the clock does not matter.
    pub fn apply(&mut self, inputs: &[u64]) {
        assert_eq!(inputs.len(), self.step.inputs.len(), "a value for each input");
        self.inputs[..inputs.len()].copy_from_slice(inputs);
        self.compute();
    }

    pub fn input(&self, port: usize) -> u64 {
        self.inputs[port]
    }

    pub fn state(&self, bit: usize) -> u64 {
        self.inputs[self.step.inputs.len() + bit]
    }

    pub fn output(&self, port: usize) -> u64 {
        self.values[self.step.logic.outputs[port] as usize]
    }

    pub fn advance(&mut self) {
        let ports = self.step.inputs.len();
        let next = &self.step.logic.outputs[self.step.outputs.len()..];
        for (bit, &signal) in self.inputs[ports..].iter_mut().zip(next) {
            *bit = self.values[signal as usize];
        }
        self.compute();
    }

    fn compute(&mut self) {
        self.step.logic.simulate_into(&self.inputs, &mut self.values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Logic;
    use crate::example::random_machine;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn every_lane_does_what_the_cells_do() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..50 {
            let source = random_machine(&mut random);
            let step = ClockStep::of(&source).unwrap();
            let (ports, outputs) = (step.inputs.len(), step.outputs.len());
            let clock = step.inputs.iter().position(|name| name == "clk");
            let mut run = ClockRun::new(step);
            let mut lanes: Vec<Logic> = (0..LANES).map(|_| Logic::new(&source)).collect();
            for _ in 0..10 {
                let inputs: Vec<u64> = (0..ports).map(|_| random.random()).collect();
                run.apply(&inputs);
                for (lane, logic) in lanes.iter_mut().enumerate() {
                    let bit = |port: usize, clocked: bool| {
                        if Some(port) == clock { clocked } else { inputs[port] >> lane & 1 == 1 }
                    };
                    let mut shown = |run: &ClockRun, clocked: bool| {
                        let bits: Vec<bool> = (0..ports).map(|port| bit(port, clocked)).collect();
                        let expected = logic.settle(&bits).unwrap();
                        let shown: Vec<bool> = (0..outputs).map(|port| run.output(port) >> lane & 1 == 1).collect();
                        assert_eq!(shown, expected, "lane {lane}");
                    };
                    shown(&run, false);
                    let mut after = run.clone();
                    after.advance();
                    shown(&after, true);
                }
                run.advance();
            }
        }
    }
}
