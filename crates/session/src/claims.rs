//! Claims of a program, decided: a search in portions, and the rows of a test that show what refutes a property.

use crate::observer::Observer;
use crate::run_rows::RunPorts;
use crate::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Base, CircuitId, CircuitTest, Claim, Program, Property, PropertyKind, Stimulation};
use nbc_base::source::Span;
use nbc_circuit::elaborate::elaborate_environment;
use nbc_circuit::properties::{
    EmptyProof, EnvironmentStep, Monitored, PropertySearch, PropertyVerdict, SearchBudget, SystemRun, TransitionSystem,
};
use nbc_circuit::{CancelFlag, Logic, Netlist, elaborate_reference, elaborate_watched};

/// A search for the verdicts on a claim. It can be dropped between any two portions.
pub struct ClaimSearch {
    claim: Claim,
    search: PropertySearch,
    ports: RunPorts,
    circuit: Netlist,
    monitor: Netlist,
}

/// A claim with a verdict on each of its properties except assumptions.
#[derive(Clone, Debug)]
pub struct DecidedClaim {
    pub claim: Claim,
    pub system: TransitionSystem,
    pub verdicts: Vec<PropertyVerdict>,
    /// Why a proof is vacuous.
    pub empty: Vec<Option<EmptyProof>>,
    /// For each refuted property, a test whose last row shows it. The circuit passes the test.
    pub tests: Vec<Option<CircuitTest>>,
    /// The work, as [`SearchBudget`] counts it.
    pub work: u64,
}

impl DecidedClaim {
    /// The tests that refute properties, with the numbers of these.
    pub fn refuted(&self) -> impl Iterator<Item = (usize, &CircuitTest)> {
        self.tests.iter().enumerate().filter_map(|(property, test)| Some((property, test.as_ref()?)))
    }
}

impl ClaimSearch {
    pub(super) fn new(
        program: &Program,
        claim: &Claim,
        budget: SearchBudget,
        cancel: CancelFlag,
    ) -> Result<Self, Vec<Diagnostic>> {
        let inner: Vec<Span> = claim.inner.iter().map(|net| net.declared).collect();
        let circuit = elaborate_watched(program, &claim.circuit, &inner)?;
        let monitor = elaborate_reference(program, &claim.monitor)?;
        let fault = |why| vec![wording::no_steps(&claim.circuit.to_string(), &why, claim.span)];
        let environment = claim.environment.map(|place| environment(program, place)).transpose()?;
        let monitored = Monitored::of(&circuit, &monitor, &claim.properties, environment.as_ref(), &cancel);
        let Monitored { system, checks, ports, given, clock } = monitored.map_err(fault)?;
        let search = PropertySearch::new(system, budget, cancel).with_checks(checks);
        Ok(Self { claim: claim.clone(), search, ports: RunPorts { ports, given, clock }, circuit, monitor })
    }

    pub fn search(&mut self) -> &mut PropertySearch {
        &mut self.search
    }

    /// Searches a portion, and reports how many properties are decided. Whether there is more to do.
    pub fn advance(&mut self, observer: &mut dyn Observer) -> bool {
        self.search.advance();
        observer.progress(self.search.decided() as u64, self.search.system().bad.len() as u64);
        !self.search.is_done()
    }

    /// Panics if the circuit contradicts the search, which is a fault of the search.
    pub fn finish(self) -> DecidedClaim {
        let verdicts = self.search.verdicts();
        let properties: Vec<Property> = self.claim.wanted().cloned().collect();
        let shown = |(property, verdict): (&Property, &PropertyVerdict)| match verdict {
            PropertyVerdict::Refuted(run) => Some(self.test(property, run)),
            PropertyVerdict::Proved(_) | PropertyVerdict::Undecided { .. } => None,
        };
        let tests = properties.iter().zip(&verdicts).map(shown).collect();
        let empty = (0..verdicts.len()).map(|property| self.search.empty_proof(property)).collect();
        let (system, work) = (self.search.system().clone(), self.search.work());
        DecidedClaim { claim: self.claim, system, verdicts, empty, tests, work }
    }

    fn test(&self, property: &Property, run: &SystemRun) -> CircuitTest {
        let Claim { circuit, span, file, line, inputs, outputs, .. } = self.claim.clone();
        let mut watcher = Watcher { logic: Logic::new(&self.monitor), said: Vec::new() };
        let bases: Vec<Base> = inputs.iter().chain(&outputs).map(Base::of_port).collect();
        let mut rows = self.ports.rows(&self.circuit, (self.search.system(), run), &bases, (span, line));
        let bits = outputs.iter().map(|port| port.width).sum();
        for row in &mut rows {
            // Only the rows of steps check something.
            if let Some(shown) = row.expected.iter().copied().collect::<Option<Vec<bool>>>() {
                watcher.see(&row.inputs, &shown);
            }
            // A test has no columns of nets inside.
            row.expected.truncate(bits);
        }
        assert!(watcher.shows(&self.claim.properties, property), "the cells violate `{}` in this run", property.text);
        let (title, stimulation) = (property.text.clone(), Stimulation::Rows(rows));
        let (rows_from, worlds) = (None, Vec::new());
        CircuitTest { circuit, title, span, file, line, inputs, outputs, stimulation, rows_from, worlds }
    }
}

/// Memories that begin with a file may hold anything.
fn environment(program: &Program, place: CircuitId) -> Result<EnvironmentStep, Vec<Diagnostic>> {
    let (netlist, memories) = elaborate_environment(program, place)?;
    let circuit = &program.circuits[place.0 as usize];
    let is_empty = circuit.memories.iter().map(|memory| memory.contents.is_none()).collect();
    EnvironmentStep::new(&netlist, memories, is_empty)
        .map_err(|fault| vec![wording::bad_environment(&fault, circuit.span)])
}

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
