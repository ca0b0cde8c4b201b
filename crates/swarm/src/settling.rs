//! How long a swarm takes to settle after its inputs switch, whatever its robots do before they have settled: ternary
//! simulation with bounded delays.
//!
//! The output of a robot is correct once its stimuli have been the same for as many cycles as its clock. Until then it
//! is unknown, unless the robot does not glitch and its previous output was the same and correct. A robot with an
//! unknown stimulus has an unknown output, unless the other stimulus decides it. A row has settled when no output is
//! unknown and none changes (docs/timing.md, "hold: auto"). Seger & Bryant, "Modeling of circuit delays in symbolic
//! simulation" (1989).

use crate::{Assembly, Member};
use nbc_base::model::Function;
use nbc_circuit::known::{TernaryBit, answer};

/// A swarm during the rows of a test; its outputs are known as far as the clocks of its robots determine them.
#[derive(Clone, Debug)]
pub struct Settling<'a> {
    members: &'a [Member],
    /// Cycles after which the output of each robot is correct, with the window over which it is measured.
    clocks: Vec<usize>,
    start: usize,
    /// Whether stimuli change within cycles, where the exclusive ors glitch (docs/own-clocks.md).
    is_late: bool,
    /// The stimuli of each robot, and the number of cycles for which they have been known and unchanged.
    sensed: Vec<(Vec<TernaryBit>, usize)>,
    bits: Vec<TernaryBit>,
    cycles: usize,
}

impl<'a> Settling<'a> {
    pub fn new(assembly: &'a Assembly, window: usize) -> Self {
        let members = &assembly.members[..];
        let clock = |member: &Member| member.robot.character.clock as usize + window - 1;
        Self {
            members,
            clocks: members.iter().map(clock).collect(),
            start: assembly.start_cycles(),
            is_late: assembly.world.lateness() > 0,
            sensed: members.iter().map(|member| (vec![None; member.senses.len()], 0)).collect(),
            bits: vec![None; members.len()],
            cycles: 0,
        }
    }

    /// After so many cycles every output is and stays correct; `None` if uncertain after `most`. Changes nothing.
    pub fn cycles_to_settle(&self, inputs: &[bool], most: usize) -> Option<usize> {
        let mut ahead = self.clone();
        let mut settled = 1;
        let longest = self.clocks.iter().copied().max().unwrap_or(1).max(self.start);
        for cycle in 1..=most + longest {
            let before = ahead.bits.clone();
            ahead.advance(inputs);
            if ahead.bits != before {
                settled = cycle;
            } else if ahead.is_at_rest() {
                return (settled <= most).then_some(settled);
            }
        }
        None
    }

    pub fn hold(&mut self, inputs: &[bool], cycles: usize) {
        (0..cycles).for_each(|_| self.advance(inputs));
    }

    pub fn bits(&self) -> &[Option<bool>] {
        &self.bits
    }

    fn advance(&mut self, inputs: &[bool]) {
        let starting = self.cycles < self.start;
        let others: Vec<TernaryBit> = match starting {
            true => self.members.iter().map(|member| Some(member.start)).collect(),
            false => self.bits.clone(),
        };
        for (i, member) in self.members.iter().enumerate() {
            let pattern: Vec<TernaryBit> = member.senses.iter().map(|signal| signal.bit(inputs, &others)).collect();
            let (before, held) = &self.sensed[i];
            let held = match pattern.iter().all(Option::is_some) {
                true if pattern == *before => held + 1,
                true => 1,
                false => 0,
            };
            self.bits[i] = self.output(i, &pattern, held);
            self.sensed[i] = (pattern, held);
        }
        self.cycles += 1;
    }

    fn output(&self, robot: usize, pattern: &[TernaryBit], held: usize) -> TernaryBit {
        let member = &self.members[robot];
        let answer = answer(member.robot.function(), pattern);
        let clock = self.clocks[robot];
        let glitches = member.robot.character.glitch_rate > 0.0
            || self.is_late && [Function::XOR, Function::XNOR].contains(&member.robot.function());
        let keeps = self.bits[robot] == answer && !glitches;
        // In one cycle a robot may react to its stimuli of that cycle, whatever it sensed before.
        let is_right = held >= clock || clock == 1 || keeps;
        if self.cycles + 1 < self.start || !is_right { None } else { answer }
    }

    /// Whether all have sensed the same for as long as they need. Outputs as in the cycle before stay.
    fn is_at_rest(&self) -> bool {
        self.cycles > self.start && self.sensed.iter().zip(&self.clocks).all(|((_, held), clock)| held >= clock)
    }
}
