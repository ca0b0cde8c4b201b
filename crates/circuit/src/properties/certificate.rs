//! What proves a property, and a check of it that shares nothing with the search but the solver: every step is written
//! out whole, as the system says it, in a new solver.

use std::collections::BTreeSet;

use batsat::{BasicSolver, Lit, SolverInterface, lbool};

use crate::and_graph::AndLiteral;
use crate::clause::{Clause, ValuedBit};
use crate::properties::system::TransitionSystem;

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum InductiveProof {
    /// Together with other properties it holds in a step if all of them hold in so many steps before, whose states are
    /// different, and they hold in the first steps.
    Steps { steps: usize, together: BTreeSet<usize> },
    /// An invariant: in every step, a register of each clause has the given value.
    Invariant {
        clauses: Vec<Clause>,
        /// Other properties that hold in every step, and without which the clauses might not.
        given: BTreeSet<usize>,
    },
}

impl InductiveProof {
    /// Properties that it takes as given need proofs of their own.
    pub fn proves(&self, system: &TransitionSystem, property: usize) -> bool {
        match self {
            Self::Steps { steps, together } => {
                let required: Vec<AndLiteral> = together.iter().map(|&one| system.bad[one] ^ 1).collect();
                together.contains(&property)
                    && *steps > 0
                    && holds_first(system, &required, *steps)
                    && holds_after(system, &required, *steps)
            }
            Self::Invariant { clauses, given } => {
                let starts =
                    |clause: &Clause| clause.iter().any(|&(at, value)| system.registers[at].start == Some(value));
                !given.contains(&property) && clauses.iter().all(starts) && is_kept(system, property, clauses, given)
            }
        }
    }
}

fn holds_first(system: &TransitionSystem, required: &[AndLiteral], steps: usize) -> bool {
    let mut written = Written::default();
    written.steps(system, steps);
    for (at, register) in system.registers.iter().enumerate() {
        if let Some(start) = register.start {
            written.require(0, system.register(at) ^ usize::from(!start));
        }
    }
    // The violation of the last step is excluded by its own call, so that constraints of later steps do not matter.
    (0..steps).all(|step| {
        written.constrain(system, step);
        written.cannot(step, required)
    })
}

fn holds_after(system: &TransitionSystem, required: &[AndLiteral], steps: usize) -> bool {
    let mut written = Written::default();
    written.steps(system, steps + 1);
    let relevant = system.relevant();
    for step in 0..steps {
        written.constrain(system, step);
        required.iter().for_each(|&literal| written.require(step, literal));
        for later in step + 1..=steps {
            written.differ(system, &relevant, [step, later]);
        }
    }
    written.constrain(system, steps);
    written.cannot(steps, required)
}

fn is_kept(system: &TransitionSystem, property: usize, clauses: &[Clause], given: &BTreeSet<usize>) -> bool {
    let mut written = Written::default();
    written.steps(system, 2);
    written.constrain(system, 0);
    given.iter().for_each(|&other| written.require(0, system.bad[other] ^ 1));
    let literals = |clause: &[ValuedBit]| -> Vec<AndLiteral> { clause.iter().map(|&bit| system.has(bit)).collect() };
    clauses.iter().for_each(|clause| written.clause(0, &literals(clause)));
    let is_violated = |written: &mut Written, clause: &Clause| {
        let opposite: Vec<Lit> = literals(clause).into_iter().map(|literal| !written.literal(1, literal)).collect();
        written.can(&opposite)
    };
    let bad = written.literal(0, system.bad[property]);
    !written.can(&[bad]) && !clauses.iter().any(|clause| is_violated(&mut written, clause))
}

#[derive(Default)]
struct Written {
    solver: BasicSolver,
    variables: Vec<Vec<Lit>>,
}

impl Written {
    fn steps(&mut self, system: &TransitionSystem, steps: usize) {
        for step in 0..steps {
            let signals: Vec<Lit> =
                (0..system.signals()).map(|_| Lit::new(self.solver.new_var_default(), true)).collect();
            self.variables.push(signals);
            self.require(step, 1);
            let first = system.signals() - system.ands.len();
            for (at, &[a, b]) in system.ands.iter().enumerate() {
                let out = 2 * (first + at);
                self.clause(step, &[out ^ 1, a]);
                self.clause(step, &[out ^ 1, b]);
                self.clause(step, &[out, a ^ 1, b ^ 1]);
            }
            for (at, register) in system.registers.iter().enumerate().filter(|_| step > 0) {
                let (now, before) = (self.literal(step, system.register(at)), self.literal(step - 1, register.next));
                self.solver.add_clause_reuse(&mut vec![!now, before]);
                self.solver.add_clause_reuse(&mut vec![now, !before]);
            }
        }
    }

    fn literal(&self, step: usize, literal: AndLiteral) -> Lit {
        let variable = self.variables[step][literal / 2];
        if literal & 1 == 1 { !variable } else { variable }
    }

    fn clause(&mut self, step: usize, literals: &[AndLiteral]) {
        let mut clause: Vec<Lit> = literals.iter().map(|&literal| self.literal(step, literal)).collect();
        self.solver.add_clause_reuse(&mut clause);
    }

    fn require(&mut self, step: usize, literal: AndLiteral) {
        self.clause(step, &[literal]);
    }

    fn constrain(&mut self, system: &TransitionSystem, step: usize) {
        system.constraints.iter().for_each(|&literal| self.require(step, literal));
    }

    fn differ(&mut self, system: &TransitionSystem, registers: &[usize], steps: [usize; 2]) {
        let mut any = Vec::new();
        for &at in registers {
            let [a, b] = steps.map(|step| self.literal(step, system.register(at)));
            let differs = Lit::new(self.solver.new_var_default(), true);
            self.solver.add_clause_reuse(&mut vec![!differs, a, b]);
            self.solver.add_clause_reuse(&mut vec![!differs, !a, !b]);
            any.push(differs);
        }
        self.solver.add_clause_reuse(&mut any);
    }

    fn cannot(&mut self, step: usize, required: &[AndLiteral]) -> bool {
        let required: Vec<Lit> = required.iter().map(|&literal| self.literal(step, literal)).collect();
        required.into_iter().all(|literal| !self.can(&[!literal]))
    }

    fn can(&mut self, literals: &[Lit]) -> bool {
        self.solver.solve_limited(literals) == lbool::TRUE
    }
}
