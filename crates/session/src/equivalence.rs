//! Tests against another circuit for ever: a search decides whether an output ever differs.

use crate::property_report::PropertyReport;
use crate::run_rows::RunPorts;
use crate::wording::ClaimError;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Base, Circuit, CircuitTest, Instance, Program, TestRow};
use nbc_circuit::properties::{Monitored, PropertySearch, PropertyVerdict, SearchBudget, TransitionSystem};
use nbc_circuit::{CancelFlag, Netlist, Settled, elaborate_reference};
use nbc_swarm::RowVerdict;

/// Two circuits that should be equal for ever.
#[derive(Clone, Debug)]
pub(super) struct Equivalence {
    system: TransitionSystem,
    ports: RunPorts,
    /// The tested circuit and the other one.
    circuits: [Netlist; 2],
    cancel: CancelFlag,
}

impl Equivalence {
    /// The tested circuit and the one that it is tested against.
    pub(super) fn new(
        program: &Program,
        test: &CircuitTest,
        tested: Netlist,
        (other, reference): (&Instance, &Circuit),
        cancel: CancelFlag,
    ) -> Result<Self, Vec<Diagnostic>> {
        let circuits = [tested, elaborate_reference(program, reference)?];
        let monitored = Monitored::of_two(circuits.each_ref(), &cancel).map_err(|(at, why)| {
            let circuit = [&test.circuit, other][at].to_string();
            vec![ClaimError::NoSteps { circuit, why }.at(test.span)]
        })?;
        let Monitored { system, ports, given, clock, .. } = monitored;
        Ok(Self { system, ports: RunPorts { ports, given, clock }, circuits, cancel })
    }

    /// A search that has done nothing yet.
    pub(super) fn search(&self) -> PropertySearch {
        PropertySearch::new(self.system.clone(), SearchBudget::SHORT, self.cancel.clone())
    }

    /// Whether the search was stopped.
    pub(super) fn is_stopped(&self) -> bool {
        self.cancel.is_raised()
    }

    /// What is known, in words, and whether the circuits are equal. The rows are those of the shortest run in which
    /// they are not: expected is what the other circuit shows.
    ///
    /// # Panics
    /// When the circuits do not do what the search says, which is a fault of the search.
    pub(super) fn judge(&self, test: &CircuitTest, search: &PropertySearch) -> (String, bool, Vec<RowVerdict>) {
        let verdict = search.verdicts().remove(0);
        let known = PropertyReport::of(&self.system, 0, String::new(), &verdict);
        let rows = match &verdict {
            PropertyVerdict::Refuted(run) => {
                let bases: Vec<Base> = test.inputs.iter().chain(&test.outputs).map(Base::of_port).collect();
                let rows = self.ports.rows(&self.circuits[1], (&self.system, run), &bases, (test.span, test.line));
                let mut tested = Settled::new(&self.circuits[0]);
                let judge = |rows: &[TestRow]| nbc_swarm::judge_logic(test, rows, &mut tested).collect::<Vec<_>>();
                let rows: Vec<RowVerdict> = rows.chunks(Settled::ROWS).flat_map(judge).collect();
                assert!(rows.last().is_some_and(|row| !row.passed), "the circuits differ in the last row");
                rows
            }
            PropertyVerdict::Proved(_) | PropertyVerdict::Undecided { .. } => Vec::new(),
        };
        let how = match verdict {
            PropertyVerdict::Undecided { .. } => format!("undecided, {}", known.how()),
            _ => format!("{} {}", known.verdict, known.how()),
        };
        (how, matches!(verdict, PropertyVerdict::Proved(_)), rows)
    }
}
