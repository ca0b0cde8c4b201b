//! Claims of a program, decided: a search in portions, and the rows of a test that show what refutes a property.

use crate::wording::ClaimError;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Base, CircuitTest, Claim, Program, Property, PropertyKind, Stimulation, TestRow};
use nbc_circuit::properties::{Monitored, PropertySearch, PropertyVerdict, SearchBudget, SystemRun, TransitionSystem};
use nbc_circuit::{CancelFlag, Logic, Netlist, elaborate, elaborate_reference};

/// A claim that is being decided. It can be dropped between any two portions.
pub struct ClaimSearch {
    claim: Claim,
    search: PropertySearch,
    /// For each input of the search, the input bit of the circuit.
    ports: Vec<usize>,
    /// The input bit that is the clock.
    clock: Option<usize>,
    circuit: Netlist,
    monitor: Netlist,
}

/// A claim with what is known of each of its properties, but for the assumptions.
#[derive(Clone, Debug)]
pub struct DecidedClaim {
    /// The claim.
    pub claim: Claim,
    /// What was searched.
    pub system: TransitionSystem,
    /// What is known.
    pub verdicts: Vec<PropertyVerdict>,
    /// For each property that is refuted, a test whose last row shows it. The circuit passes it as it is.
    pub tests: Vec<Option<CircuitTest>>,
    /// The work, as [`SearchBudget`] counts it.
    pub work: u64,
}

impl ClaimSearch {
    /// A search that has done nothing yet.
    ///
    /// # Errors
    /// When the circuit cannot be built, or has no steps.
    pub(super) fn new(
        program: &Program,
        claim: &Claim,
        budget: SearchBudget,
        cancel: CancelFlag,
    ) -> Result<Self, Vec<Diagnostic>> {
        let circuit = elaborate(program, &claim.circuit)?;
        let monitor = elaborate_reference(program, &claim.monitor)?;
        let fault = |why| {
            let circuit = claim.circuit.to_string();
            vec![ClaimError::NoSteps { circuit, why }.at(claim.span)]
        };
        let monitored = Monitored::of(&circuit, &monitor, &claim.properties, &cancel).map_err(fault)?;
        let Monitored { system, ports, clock } = monitored;
        let search = PropertySearch::new(system, budget, cancel);
        Ok(Self { claim: claim.clone(), search, ports, clock, circuit, monitor })
    }

    /// The search, to be advanced.
    pub fn search(&mut self) -> &mut PropertySearch {
        &mut self.search
    }

    /// What is known now.
    ///
    /// # Panics
    /// When the circuit does not do what the search says, which is a fault of the search.
    pub fn finish(self) -> DecidedClaim {
        let verdicts = self.search.verdicts();
        let properties: Vec<Property> = self.claim.wanted().cloned().collect();
        let shown = |(property, verdict): (&Property, &PropertyVerdict)| match verdict {
            PropertyVerdict::Refuted(run) => Some(self.test(property, run)),
            PropertyVerdict::Proved(_) | PropertyVerdict::Undecided { .. } => None,
        };
        let tests = properties.iter().zip(&verdicts).map(shown).collect();
        let (system, work) = (self.search.system().clone(), self.search.work());
        DecidedClaim { claim: self.claim, system, verdicts, tests, work }
    }

    /// The test that a run is: its outputs are those of the cells, one time step after the other.
    fn test(&self, property: &Property, run: &SystemRun) -> CircuitTest {
        let Claim { circuit, span, file, line, inputs, outputs, .. } = self.claim.clone();
        let mut logic = Logic::new(&self.circuit);
        let mut watcher = Watcher { logic: Logic::new(&self.monitor), said: Vec::new() };
        let bases: Vec<Base> = inputs.iter().chain(&outputs).map(Base::of_port).collect();
        let mut rows = Vec::new();
        for (step, values) in run.inputs.iter().enumerate() {
            let mut row = vec![false; self.circuit.inputs().len()];
            self.ports.iter().zip(values).for_each(|(&port, &value)| row[port] = value);
            let halves = if step > 0 && self.clock.is_some() { 2 } else { 1 };
            for half in 0..halves {
                if let Some(clock) = self.clock {
                    row[clock] = half == 1;
                }
                let shown = logic.settle(&row).expect("a circuit that has steps settles");
                let is_half = half + 1 < halves;
                let expected = shown.iter().map(|&value| (!is_half).then_some(value)).collect();
                let (inputs, bases) = (row.clone(), bases.clone());
                let (hold, given_up) = (None, None);
                rows.push(TestRow { inputs, expected, bases, hold, span, line, row: step + 1, is_half, given_up });
                if !is_half {
                    watcher.see(&row, &shown);
                }
            }
        }
        assert!(watcher.shows(&self.claim.properties, property), "the cells violate `{}` in this run", property.text);
        let (title, stimulation) = (property.text.clone(), Stimulation::Rows(rows));
        let (rows_from, worlds) = (None, Vec::new());
        CircuitTest { circuit, title, span, file, line, inputs, outputs, stimulation, rows_from, worlds }
    }
}

/// What is said of each step, by the cells of the monitor.
struct Watcher {
    logic: Logic,
    said: Vec<Vec<bool>>,
}

impl Watcher {
    fn see(&mut self, inputs: &[bool], outputs: &[bool]) {
        let row = |clock: bool| [inputs, outputs, &[clock]].concat();
        self.said.push(self.logic.settle(&row(false)).expect("a monitor settles"));
        self.logic.settle(&row(true)).expect("a monitor settles");
    }

    /// Whether the last step violates a property, and no step violates an assumption.
    fn shows(&self, properties: &[Property], wanted: &Property) -> bool {
        let mut at = 0;
        let mut is_shown = false;
        for property in properties {
            let own = at..at + property.outputs();
            at = own.end;
            let said = |step: usize| &self.said[step][own.clone()];
            let is_said = |step: usize| step >= property.before && (!property.has_condition || said(step)[0]);
            let holds = |step: usize| (property.kind == PropertyKind::Never) != said(step)[property.outputs() - 1];
            let last = self.said.len() - 1;
            if property.kind == PropertyKind::Assume && (0..=last).any(|step| is_said(step) && !holds(step)) {
                return false;
            }
            if property == wanted {
                let waits = property.within.unwrap_or(0);
                let begins = last.checked_sub(waits);
                is_shown = begins.is_some_and(|first| is_said(first) && !(first..=last).any(holds));
            }
        }
        is_shown
    }
}
