//! The solver of a search: it counts its work, and stops where a portion of the search ends.

use batsat::{Callbacks, ClauseKind, Lit, Solver, SolverInterface, SolverOpts, lbool};

use nbc_base::source::CancelFlag;

pub(crate) struct SolverLimits {
    learned: u64,
    most: u64,
    cancel: CancelFlag,
}

impl SolverLimits {
    pub(crate) fn new(cancel: CancelFlag) -> Self {
        Self { learned: 0, most: u64::MAX, cancel }
    }

    /// Ends the next call after so many learned clauses.
    pub(crate) fn permit(&mut self, portion: u64) {
        self.most = self.learned.saturating_add(portion);
    }
}

impl Callbacks for SolverLimits {
    fn on_new_clause(&mut self, _: &[Lit], source: ClauseKind) {
        self.learned += u64::from(source == ClauseKind::Learnt);
    }

    fn stop(&self) -> bool {
        self.learned >= self.most || self.cancel.is_raised()
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Solved {
    Yes,
    No,
    Open,
}

pub(super) struct ClauseSolver {
    solver: Solver<SolverLimits>,
    one: Lit,
    /// Whether it chooses values of gates, which helps where values are hard to find.
    chooses_gates: bool,
    calls: u64,
}

impl ClauseSolver {
    pub(super) fn new(cancel: CancelFlag) -> Self {
        // Learned clauses are not minimized along implications, which takes most of the time in unrolled steps.
        let mut solver = Solver::new(SolverOpts { ccmin_mode: 1, ..SolverOpts::default() }, SolverLimits::new(cancel));
        let one = Lit::new(solver.new_var_default(), true);
        solver.add_clause_reuse(&mut vec![one]);
        Self { solver, one, chooses_gates: true, calls: 0 }
    }

    pub(super) fn without_choice_of_gates(cancel: CancelFlag) -> Self {
        Self { chooses_gates: false, ..Self::new(cancel) }
    }

    pub(super) fn one(&self) -> Lit {
        self.one
    }

    pub(super) fn fresh(&mut self) -> Lit {
        Lit::new(self.solver.new_var_default(), true)
    }

    /// A new variable of which the solver does not choose the value: it follows from those of others, or may be 0.
    pub(super) fn follower(&mut self) -> Lit {
        Lit::new(self.solver.new_var(lbool::UNDEF, false), true)
    }

    pub(super) fn clause(&mut self, literals: &[Lit]) {
        self.solver.add_clause_reuse(&mut literals.to_vec());
    }

    pub(super) fn and(&mut self, a: Lit, b: Lit) -> Lit {
        let one = self.one;
        match (a, b) {
            _ if a == !one || b == !one || a == !b => !one,
            _ if a == one || a == b => b,
            _ if b == one => a,
            _ => {
                let both = if self.chooses_gates { self.fresh() } else { self.follower() };
                self.clause(&[!both, a]);
                self.clause(&[!both, b]);
                self.clause(&[both, !a, !b]);
                both
            }
        }
    }

    pub(super) fn solve(&mut self, assumed: &[Lit], portion: u64) -> Solved {
        self.calls += 1;
        self.solver.cb_mut().permit(portion);
        let solved = self.solver.solve_limited(assumed);
        if solved == lbool::TRUE {
            Solved::Yes
        } else if solved == lbool::FALSE {
            Solved::No
        } else {
            Solved::Open
        }
    }

    pub(super) fn is_on(&self, literal: Lit) -> bool {
        self.solver.value_lit(literal) == lbool::TRUE
    }

    pub(super) fn is_needed(&self, assumed: Lit) -> bool {
        self.solver.unsat_core_contains_var(assumed.var())
    }

    /// A unit for each call, each clause learned, and each hundred values derived; the same on every machine.
    pub(super) fn work(&self) -> u64 {
        self.calls + self.solver.cb().learned + self.solver.num_propagations() / 100
    }
}
