//! A machine as a plain transition system: and-gates between inputs, registers and what is said of every step.

use crate::and_graph::AndLiteral;
use crate::clause::ValuedBit;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SystemRegister {
    pub name: String,
    /// `None` if it may be either in the first step.
    pub start: Option<bool>,
    pub next: AndLiteral,
}

/// A machine, and properties of its steps. In every step its inputs have any values that fulfill the constraints.
/// Literals are counted as in AIGER: signal 0 is the constant 0, then the inputs, the registers, and the gates.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TransitionSystem {
    pub inputs: Vec<String>,
    pub registers: Vec<SystemRegister>,
    /// The pins of each gate; a gate reads earlier signals only.
    pub ands: Vec<[AndLiteral; 2]>,
    /// For each property, what is 1 in a step that violates it.
    pub bad: Vec<AndLiteral>,
    /// What is 1 in every step. What comes after a step in which one is 0 does not count, nor does that step.
    pub constraints: Vec<AndLiteral>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SystemRun {
    pub start: Vec<bool>,
    pub inputs: Vec<Vec<bool>>,
}

impl TransitionSystem {
    pub fn register(&self, at: usize) -> AndLiteral {
        2 * (1 + self.inputs.len() + at)
    }

    pub(super) fn signals(&self) -> usize {
        1 + self.inputs.len() + self.registers.len() + self.ands.len()
    }

    pub(super) fn has(&self, (at, value): ValuedBit) -> AndLiteral {
        self.register(at) ^ usize::from(!value)
    }

    pub(super) fn gets(&self, (at, value): ValuedBit) -> AndLiteral {
        self.registers[at].next ^ usize::from(!value)
    }

    pub(super) fn register_of(&self, literal: AndLiteral) -> Option<usize> {
        (literal / 2).checked_sub(1 + self.inputs.len()).filter(|&at| at < self.registers.len())
    }

    pub(super) fn gate_of(&self, literal: AndLiteral) -> Option<[AndLiteral; 2]> {
        let at = (literal / 2).checked_sub(1 + self.inputs.len() + self.registers.len())?;
        Some(self.ands[at])
    }

    pub(super) fn relevant(&self) -> Vec<usize> {
        let mut seen = vec![false; self.signals()];
        let mut open: Vec<AndLiteral> = self.bad.iter().chain(&self.constraints).copied().collect();
        while let Some(literal) = open.pop() {
            if std::mem::replace(&mut seen[literal / 2], true) {
                continue;
            }
            open.extend(self.register_of(literal).map(|at| self.registers[at].next));
            open.extend(self.gate_of(literal).into_iter().flatten());
        }
        (0..self.registers.len()).filter(|&at| seen[self.register(at) / 2]).collect()
    }

    pub fn values(&self, inputs: &[bool], state: &[bool]) -> Vec<bool> {
        assert_eq!(inputs.len(), self.inputs.len(), "a value for each input");
        assert_eq!(state.len(), self.registers.len(), "a value for each register");
        let mut values = Vec::with_capacity(self.signals());
        values.push(false);
        values.extend(inputs.iter().chain(state));
        for pins in &self.ands {
            let [a, b] = pins.map(|pin| is_on(&values, pin));
            values.push(a && b);
        }
        values
    }

    pub fn next(&self, values: &[bool]) -> Vec<bool> {
        self.registers.iter().map(|register| is_on(values, register.next)).collect()
    }

    pub fn along(&self, run: &SystemRun, literals: &[AndLiteral]) -> Vec<Vec<bool>> {
        let mut state = run.start.clone();
        let mut step = |inputs: &Vec<bool>| {
            let values = self.values(inputs, &state);
            state = self.next(&values);
            literals.iter().map(|&literal| is_on(&values, literal)).collect()
        };
        run.inputs.iter().map(&mut step).collect()
    }

    pub fn may_start(&self, state: &[bool]) -> bool {
        self.registers.iter().zip(state).all(|(register, &value)| register.start.is_none_or(|start| start == value))
    }

    /// Counted from 0; `None` if no step does, the run does not begin at the start, or a constraint fails before.
    pub fn violation(&self, property: usize, run: &SystemRun) -> Option<usize> {
        if !self.may_start(&run.start) {
            return None;
        }
        let mut state = run.start.clone();
        for (step, inputs) in run.inputs.iter().enumerate() {
            let values = self.values(inputs, &state);
            if !self.constraints.iter().all(|&constraint| is_on(&values, constraint)) {
                return None;
            }
            if is_on(&values, self.bad[property]) {
                return Some(step);
            }
            state = self.next(&values);
        }
        None
    }

    /// The run with as many inputs of 0 as can be, one after the other; it violates the property in the same step.
    pub(super) fn plainer(&self, property: usize, mut run: SystemRun) -> SystemRun {
        let step = self.violation(property, &run);
        for at in 0..run.inputs.len() {
            for input in 0..self.inputs.len() {
                if run.inputs[at][input] {
                    run.inputs[at][input] = false;
                    run.inputs[at][input] = self.violation(property, &run) != step;
                }
            }
        }
        run
    }
}

pub fn is_on(values: &[bool], literal: AndLiteral) -> bool {
    values[literal / 2] != (literal & 1 == 1)
}

/// The states in which some registers have given values, in order of the registers.
pub(super) type Cube = Vec<ValuedBit>;

pub(super) fn excludes_start(system: &TransitionSystem, cube: &[ValuedBit]) -> bool {
    cube.iter().any(|&(at, value)| system.registers[at].start == Some(!value))
}

pub(super) fn contains(large: &[ValuedBit], small: &[ValuedBit]) -> bool {
    large.iter().all(|literal| small.binary_search(literal).is_ok())
}
