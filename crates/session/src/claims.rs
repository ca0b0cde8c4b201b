//! Claims of a program, decided: a search in portions, and the rows of a test that show what refutes a property.

use crate::checked::Checked;
use crate::decided_claim::{DecidedClaim, text_of_test};
use crate::decided_property::DecidedProperty;
use crate::observer::Observer;
use crate::run_rows::RunPorts;
use crate::wording;
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::{Base, CircuitId, CircuitTest, Claim, Program, Property, PropertyKind, Stimulation};
use nbc_base::source::Span;
use nbc_circuit::elaborate::elaborate_environment;
use nbc_circuit::properties::{
    EmptyProof, EnvironmentStep, Monitored, PropertySearch, PropertyVerdict, SearchBudget, SystemRun,
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

impl Checked {
    /// Begins to decide a claim. The search ends when its budget does, or when the flag is raised.
    pub fn prove(&self, claim: &Claim, budget: SearchBudget, cancel: CancelFlag) -> Result<ClaimSearch, Diagnostics> {
        self.diagnosed(ClaimSearch::new(&self.program, claim, budget, cancel))
    }
}

impl ClaimSearch {
    fn new(
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
        let Claim { file, line, circuit, title, properties, .. } = &self.claim;
        let decided = |(number, (property, verdict)): (usize, (&Property, PropertyVerdict))| {
            let empty = self.search.empty_proof(number).map(|why| why_empty(why, property, properties));
            let shown = match &verdict {
                PropertyVerdict::Refuted(run) => Some(self.test(property, run)),
                PropertyVerdict::Proved(_) | PropertyVerdict::Undecided { .. } => None,
            };
            DecidedProperty {
                line: Some(property.line),
                test: shown.as_ref().map(text_of_test),
                shown,
                ..DecidedProperty::of((self.search.system(), number), property.text.clone(), &verdict, empty)
            }
        };
        let decided = self.claim.wanted().zip(self.search.verdicts()).enumerate().map(decided).collect();
        DecidedClaim {
            file: file.clone(),
            line: Some(*line),
            circuit: Some(circuit.to_string()),
            title: Some(title.clone()).filter(|title| !title.is_empty()),
            properties: decided,
            work: self.search.work(),
        }
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

fn why_empty(why: EmptyProof, property: &Property, all: &[Property]) -> String {
    let is_assumed = all.iter().any(|other| other.kind == PropertyKind::Assume);
    let under = if is_assumed { " under the assumptions" } else { "" };
    match why {
        EmptyProof::NoStep => "no step satisfies the assumptions".to_owned(),
        EmptyProof::NeverChecked if property.has_condition => format!("its condition is never true{under}"),
        EmptyProof::NeverChecked => format!("no run is long enough{under}"),
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
