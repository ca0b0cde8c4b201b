//! Tests against another circuit for ever: a search decides whether an output ever differs.

use crate::decided_property::DecidedProperty;
use crate::run_rows::RunPorts;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Base, Circuit, CircuitTest, Instance, Program, TestRow};
use nbc_circuit::properties::{Monitored, PropertySearch, PropertyVerdict, SearchBudget, TransitionSystem};
use nbc_circuit::{CancelFlag, Netlist, Settled, elaborate_reference};
use nbc_swarm::RowVerdict;

#[derive(Clone, Debug)]
pub(super) struct Equivalence {
    system: TransitionSystem,
    ports: RunPorts,
    /// The tested circuit and the other one.
    circuits: [Netlist; 2],
    cancel: CancelFlag,
}

impl Equivalence {
    pub(super) fn new(
        program: &Program,
        test: &CircuitTest,
        tested: Netlist,
        (other, reference): (&Instance, &Circuit),
        cancel: CancelFlag,
    ) -> Result<Self, Vec<Diagnostic>> {
        let circuits = [tested, elaborate_reference(program, reference)?];
        let monitored = Monitored::of_two(circuits.each_ref(), &cancel)
            .map_err(|(at, why)| vec![wording::no_steps(&[&test.circuit, other][at].to_string(), &why, test.span)])?;
        let Monitored { system, ports, given, clock, .. } = monitored;
        Ok(Self { system, ports: RunPorts { ports, given, clock }, circuits, cancel })
    }

    pub(super) fn search(&self) -> PropertySearch {
        PropertySearch::new(self.system.clone(), SearchBudget::SHORT, self.cancel.clone())
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.cancel.is_raised()
    }

    /// The verdict in words, whether the circuits are equal, and the rows of the shortest run in which they differ; the
    /// other circuit's outputs are expected. Panics if the circuits contradict the search, which is a fault of the
    /// search.
    pub(super) fn judge(&self, test: &CircuitTest, search: &PropertySearch) -> (String, bool, Vec<RowVerdict>) {
        let verdict = search.verdicts().remove(0);
        let known = DecidedProperty::of((&self.system, 0), String::new(), &verdict, None);
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
            PropertyVerdict::Undecided { .. } => format!("undecided, {}", known.how),
            _ => format!("{} {}", known.verdict, known.how),
        };
        (how, matches!(verdict, PropertyVerdict::Proved(_)), rows)
    }
}
