//! The steps of a transition system one after the other as clauses, made when they are asked for.

use batsat::Lit;

use crate::and_graph::AndLiteral;
use crate::properties::solver::ClauseSolver;
use crate::properties::system::{SystemRun, TransitionSystem};
use nbc_base::source::CancelFlag;

pub(super) struct Unrolled {
    pub(super) solver: ClauseSolver,
    /// If false, the first state may be any.
    from_start: bool,
    steps: Vec<Vec<Option<Lit>>>,
}

impl Unrolled {
    pub(super) fn new(from_start: bool, cancel: CancelFlag) -> Self {
        Self { solver: ClauseSolver::new(cancel), from_start, steps: Vec::new() }
    }

    /// A step from any state, in which gates follow from the inputs and the state.
    pub(super) fn any_step(cancel: CancelFlag) -> Self {
        Self { solver: ClauseSolver::without_choice_of_gates(cancel), from_start: false, steps: Vec::new() }
    }

    pub(super) fn literal(&mut self, system: &TransitionSystem, step: usize, literal: AndLiteral) -> Lit {
        // What is still to be defined, the first last.
        let mut open = vec![(step, literal / 2)];
        while let Some(&(step, signal)) = open.last() {
            if self.known(system, step, signal).is_some() {
                open.pop();
                continue;
            }
            let literal = 2 * signal;
            let made = if signal == 0 {
                Some(!self.solver.one())
            } else if let Some([a, b]) = system.gate_of(literal) {
                match [a, b].map(|pin| self.known(system, step, pin / 2)) {
                    [Some(x), Some(y)] => Some(self.solver.and(signed(x, a), signed(y, b))),
                    [x, _] => {
                        open.push((step, if x.is_none() { a / 2 } else { b / 2 }));
                        None
                    }
                }
            } else if let Some(at) = system.register_of(literal) {
                let register = &system.registers[at];
                match (step, self.from_start, register.start) {
                    (0, true, Some(start)) => Some(signed(self.solver.one(), usize::from(!start))),
                    (0, _, _) => Some(self.solver.fresh()),
                    _ => {
                        let before = self.known(system, step - 1, register.next / 2);
                        if before.is_none() {
                            open.push((step - 1, register.next / 2));
                        }
                        before.map(|before| signed(before, register.next))
                    }
                }
            } else {
                Some(self.solver.fresh())
            };
            if let Some(made) = made {
                self.steps[step][signal] = Some(made);
                open.pop();
            }
        }
        signed(self.known(system, step, literal / 2).expect("it was defined"), literal)
    }

    fn known(&mut self, system: &TransitionSystem, step: usize, signal: usize) -> Option<Lit> {
        while self.steps.len() <= step {
            self.steps.push(vec![None; system.signals()]);
        }
        self.steps[step][signal]
    }

    pub(super) fn require(&mut self, system: &TransitionSystem, step: usize, literal: AndLiteral) {
        let literal = self.literal(system, step, literal);
        self.solver.clause(&[literal]);
    }

    fn is_on(&self, step: usize, signal: usize) -> bool {
        let made = self.steps.get(step).and_then(|signals| signals[signal]);
        made.is_some_and(|literal| self.solver.is_on(literal))
    }

    pub(super) fn shows(&self, step: usize, literal: AndLiteral) -> bool {
        self.is_on(step, literal / 2) != (literal & 1 == 1)
    }

    pub(super) fn state(&self, system: &TransitionSystem, step: usize) -> Vec<bool> {
        (0..system.registers.len()).map(|at| self.is_on(step, system.register(at) / 2)).collect()
    }

    pub(super) fn inputs(&self, system: &TransitionSystem, step: usize) -> Vec<bool> {
        (0..system.inputs.len()).map(|at| self.is_on(step, at + 1)).collect()
    }

    pub(super) fn run(&self, system: &TransitionSystem, steps: usize) -> SystemRun {
        let start = system.registers.iter().zip(self.state(system, 0));
        SystemRun {
            start: start.map(|(register, found)| register.start.unwrap_or(found)).collect(),
            inputs: (0..steps).map(|step| self.inputs(system, step)).collect(),
        }
    }
}

fn signed(positive: Lit, literal: AndLiteral) -> Lit {
    if literal & 1 == 1 { !positive } else { positive }
}
