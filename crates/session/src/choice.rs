//! Finds the circuit, test or simulation that a user names.

use crate::checked::Checked;
use crate::wording;
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::{Circuit, CircuitTest, Instance, Program, Simulation, Swarm};
use nbc_circuit::is_same_instance;

/// A choice of a circuit. The source decides what is `None`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Choice {
    pub circuit: Option<String>,
    pub swarm: Option<String>,
}

impl Checked {
    /// The chosen circuit, that of the chosen swarm, or else the last one of the source that is not an environment.
    pub fn circuit(&self, choice: &Choice) -> Result<Instance, Diagnostics> {
        match (&choice.circuit, &choice.swarm) {
            (Some(circuit), _) => self.named(circuit),
            (None, Some(swarm)) => match declared_swarm(&self.program, swarm) {
                Ok(swarm) => Ok(swarm.circuit.clone()),
                Err(fault) => Err(self.fail(vec![fault])),
            },
            (None, None) => self.last_circuit().map_err(|fault| self.fail(vec![fault])),
        }
    }

    pub fn tests<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a CircuitTest> {
        let is_called = move |test: &&CircuitTest| {
            test.title == name
                || test.circuit.circuit == name
                || test.circuit.to_string() == name
                || swarms_of(&self.program, &test.circuit).iter().any(|swarm| swarm.name == name)
        };
        self.program.tests.iter().filter(is_called)
    }

    pub fn simulations<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Simulation> {
        let is_called =
            move |simulation: &&Simulation| simulation.swarm == name || simulation.circuit.to_string() == name;
        self.program.simulations.iter().filter(is_called)
    }

    fn named(&self, circuit: &str) -> Result<Instance, Diagnostics> {
        let mut sources = self.sources.clone();
        let file = sources.add("--circuit", circuit);
        let named = nbc_lang::check::named(&self.program, &sources, file);
        let named = named.and_then(|named| self.with_parameters(named));
        named.map_err(|fault| Diagnostics { list: vec![fault], sources })
    }

    fn with_parameters(&self, named: Instance) -> Result<Instance, Diagnostic> {
        let parameters = self.program.circuit(&named.circuit).map_or(&[][..], |circuit| &circuit.parameters);
        let missing = parameters.iter().skip(named.arguments.len()).find(|parameter| parameter.default.is_none());
        match missing {
            None => Ok(named),
            Some(parameter) => Err(wording::no_number(&named.circuit, &parameter.name, parameters.len())),
        }
    }

    fn last_circuit(&self) -> Result<Instance, Diagnostic> {
        let program = &self.program;
        let is_environment = |at: usize| program.environments.iter().any(|environment| environment.0 as usize == at);
        let own = program.circuits.iter().enumerate().filter(|(_, circuit)| Some(circuit.span.file) == self.file);
        let Some((_, last)) = own.rev().find(|&(at, _)| !is_environment(at)) else {
            return Err(wording::no_circuit());
        };
        self.declared(last).map_or_else(|| self.with_parameters(last.name.as_str().into()), Ok)
    }

    /// With its defaults, or else the parameters of its swarm or its test.
    fn declared(&self, circuit: &Circuit) -> Option<Instance> {
        if circuit.parameters.iter().all(|parameter| parameter.default.is_some()) {
            return Some(circuit.name.as_str().into());
        }
        let swarms = self.program.swarms.iter().map(|swarm| &swarm.circuit);
        let tests = self.program.tests.iter().map(|test| &test.circuit);
        swarms.chain(tests).find(|used| used.circuit == circuit.name).cloned()
    }

    /// With its defaults, or else the parameters of its swarm, its test or a call.
    pub fn in_use(&self, circuit: &Circuit) -> Option<Instance> {
        let called = || self.instances.iter().find(|used| used.circuit == circuit.name).cloned();
        self.declared(circuit).or_else(called)
    }

    pub fn swarms(&self, circuit: &Instance) -> Vec<&Swarm> {
        swarms_of(&self.program, circuit)
    }
}

pub(super) fn swarms_of<'p>(program: &'p Program, circuit: &Instance) -> Vec<&'p Swarm> {
    program.swarms.iter().filter(|swarm| is_same_instance(program, &swarm.circuit, circuit)).collect()
}

pub fn check_swarm_is_clear(program: &Program, circuit: &Instance, chosen: Option<&str>) -> Result<(), Diagnostic> {
    match (chosen, &swarms_of(program, circuit)[..]) {
        (None, [first, second, ..]) => Err(wording::several_swarms(&circuit.to_string(), [&first.name, &second.name])),
        _ => Ok(()),
    }
}

pub(super) fn declared_swarm<'p>(program: &'p Program, name: &str) -> Result<&'p Swarm, Diagnostic> {
    let known = || program.swarms.iter().map(|swarm| swarm.name.as_str());
    program.swarm(name).ok_or_else(|| wording::unknown("swarm", name, known()))
}
