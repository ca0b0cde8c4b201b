//! A run of a transition system as rows of a test.

use nbc_base::model::{Base, TestRow};
use nbc_base::source::Span;
use nbc_circuit::properties::{AndLiteral, StepClock, SystemRun, TransitionSystem};
use nbc_circuit::{Logic, Netlist};

#[derive(Clone, Debug)]
pub(super) struct RunPorts {
    /// Input bits of the circuit without the clock.
    pub(super) ports: Vec<usize>,
    pub(super) given: Vec<AndLiteral>,
    /// Each step after the first is an edge of it.
    pub(super) clock: Option<StepClock>,
}

impl RunPorts {
    /// The row before an edge checks nothing; if the clock rises, it is the first half of a pulse.
    pub(super) fn rows(
        &self,
        circuit: &Netlist,
        (system, run): (&TransitionSystem, &SystemRun),
        bases: &[Base],
        (span, line): (Span, usize),
    ) -> Vec<TestRow> {
        let mut logic = Logic::new(circuit);
        let mut rows: Vec<TestRow> = Vec::new();
        let mut row = 0;
        for (step, values) in system.along(run, &self.given).into_iter().enumerate() {
            let mut inputs = vec![false; circuit.inputs().len()];
            self.ports.iter().zip(values).for_each(|(&port, value)| inputs[port] = value);
            let edge = self.clock.filter(|_| step > 0);
            let halves = if edge.is_some() { 2 } else { 1 };
            for half in 0..halves {
                if let Some(StepClock { input, rises }) = self.clock {
                    inputs[input] = (half == 1) == rises;
                }
                let shown = logic.settle(&inputs).expect("a circuit that has steps settles");
                let is_checked = half + 1 == halves;
                let is_half = !is_checked && edge.is_some_and(|clock| clock.rises);
                row += usize::from(!is_half);
                let number = row + usize::from(is_half);
                rows.push(TestRow {
                    inputs: inputs.clone(),
                    expected: shown.into_iter().map(|value| is_checked.then_some(value)).collect(),
                    bases: bases.to_vec(),
                    hold: None,
                    span,
                    line,
                    row: number,
                    is_half,
                    given_up: None,
                });
            }
        }
        rows
    }
}
