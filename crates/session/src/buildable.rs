//! What a test, a build or a search would refuse before it simulates anything: libraries that lack robots, swarms that
//! cannot be made, rows that are no steps, environments whose files do not fit. A check of a program says it, too.

use crate::checked::Checked;
use crate::compile::map_onto;
use crate::options::RUNS;
use crate::wording::{self, for_circuit};
use crate::{script, waves};
use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Severity};
use nbc_base::model::{CircuitTest, Instance, Library, Origin, Program, RegisterStyle, Stimulation, Swarm, TestRow};
use nbc_base::source::{SourceWorld, Span};
use nbc_circuit::waves::ClockStep;
use nbc_circuit::{Effort, Loops, MapOptions, Netlist, RegisterForm, has_multiplexers, is_same_instance};
use nbc_lang::check::DEFAULT_LIBRARY;

/// Larger circuits are not made into wave machines during a check.
const SMALL: usize = 200;

/// `files` replace declared files, by name and path. Libraries of evolutions that have not run yet are skipped.
pub(super) fn faults(checked: &Checked, files: &[(String, String)]) -> Vec<Diagnostic> {
    let program = &checked.program;
    let mut look = Look { checked, program, faults: Vec::new() };
    for declared in &program.libraries {
        // The libraries of the program itself are whole, and need not be read.
        let is_elsewhere = matches!(declared.from, Origin::Folder(_) | Origin::Evolution(_));
        if declared.behaviors.is_some() || !declared.without.is_empty() || is_elsewhere {
            look.library(&declared.name);
        }
    }
    for swarm in &program.swarms {
        look.swarm(swarm);
    }
    let tested = program.tests.iter().map(|test| (&test.circuit, test.span));
    let simulated = program.simulations.iter().map(|simulation| (&simulation.circuit, simulation.span));
    for (circuit, place) in tested.chain(simulated) {
        if program.swarms.iter().all(|swarm| !is_same_instance(program, &swarm.circuit, circuit)) {
            look.circuit(circuit, DEFAULT_LIBRARY, place);
        }
    }
    for test in &program.tests {
        look.environment(test, files);
    }
    for evolution in program.evolutions.iter().filter(|evolution| program.own_evolutions.contains(&evolution.name)) {
        let library = evolution.start.as_ref().and_then(|start| program.library(&start.library));
        if library.is_some_and(|library| checked.has_run(library, RUNS)) {
            look.note(checked.with_start(evolution, RUNS).map(drop));
        }
    }
    look.faults
}

struct Look<'a> {
    checked: &'a Checked,
    program: &'a Program,
    faults: Vec<Diagnostic>,
}

impl Look<'_> {
    fn note(&mut self, result: Result<(), Vec<Diagnostic>>) {
        for fault in result.err().into_iter().flatten() {
            if !self.faults.contains(&fault) {
                self.faults.push(fault);
            }
        }
    }

    fn options(&self) -> MapOptions {
        MapOptions { cancel: self.checked.context.world.cancel(), ..MapOptions::default() }
    }

    /// `None` after an error, and for an evolution that has not run yet.
    fn library(&mut self, name: &str) -> Option<Library> {
        let declared = self.program.library(name)?;
        if !self.checked.has_run(declared, RUNS) {
            return None;
        }
        match self.checked.library(declared, RUNS) {
            Ok(library) => Some(library),
            Err(faults) => {
                self.note(Err(faults));
                None
            }
        }
    }

    fn is_whole(&self, library: &str) -> bool {
        let declared = self.program.library(library);
        declared.is_none_or(|declared| {
            let is_built_in = matches!(declared.from, Origin::Shipped | Origin::Three);
            is_built_in && declared.behaviors.is_none() && declared.without.is_empty()
        })
    }

    fn is_three(&self, library: &str) -> bool {
        self.program.library(library).is_some_and(|declared| declared.from == Origin::Three)
    }

    fn circuit(&mut self, circuit: &Instance, library: &str, place: Span) {
        if self.is_whole(library) {
            return;
        }
        let Some(robots) = self.library(library) else { return };
        let cells = nbc_swarm::cells(&robots);
        if !cells.is_complete() {
            let options = MapOptions { effort: Effort::Fast, ..self.options() };
            let made = self.checked.netlist(circuit).and_then(|source| {
                let source = Netlist::clone(&source);
                map_onto(source, &cells, &options, RegisterForm::Nands, place, Limit::SwarmGates)
            });
            self.note(made.map(drop));
        }
    }

    fn swarm(&mut self, swarm: &Swarm) {
        self.registers(swarm);
        match swarm.registers {
            RegisterStyle::MasterSlave => self.circuit(&swarm.circuit, &swarm.library, swarm.span),
            // The library `three` has multiplexers, and takes long to read.
            RegisterStyle::Mux if self.is_whole(&swarm.library) && self.is_three(&swarm.library) => {}
            RegisterStyle::Mux => {
                let Some(robots) = self.library(&swarm.library) else { return };
                if has_multiplexers(&nbc_swarm::cells(&robots)) {
                    self.circuit(&swarm.circuit, &swarm.library, swarm.span);
                } else {
                    self.note(Err(vec![for_circuit(wording::no_multiplexer(), swarm.span)]));
                }
            }
            RegisterStyle::Waves => self.waves(swarm),
        }
    }

    fn registers(&mut self, swarm: &Swarm) {
        // Anything can be a wave machine, and `master_slave` is the default.
        if swarm.registers != RegisterStyle::Mux {
            return;
        }
        let Ok(netlist) = self.checked.netlist(&swarm.circuit) else { return };
        if Loops::of(&netlist).cores().is_empty() && netlist.registers().next().is_none() {
            let circuit = swarm.circuit.to_string();
            self.note(Err(vec![wording::no_registers(&swarm.name, &circuit, swarm.span)]));
        }
    }

    /// A wave machine needs one clock, and each row of its tests must be a step.
    fn waves(&mut self, swarm: &Swarm) {
        let Ok(netlist) = self.checked.netlist(&swarm.circuit) else { return };
        let step = match ClockStep::of(&netlist) {
            Ok(step) => step,
            Err(error) => {
                return self.note(Err(vec![for_circuit(wording::no_waves(&error), swarm.span)]));
            }
        };
        // Only a step that may be too short, or a library that may lack a robot, is worth the work.
        if netlist.size() > SMALL {
            self.circuit(&swarm.circuit, &swarm.library, swarm.span);
        } else if (swarm.waves.step.is_some() || !self.is_whole(&swarm.library))
            && let Some(robots) = self.library(&swarm.library)
        {
            let made = waves::map_waves(Netlist::clone(&netlist), &robots, swarm.waves, &self.options());
            self.note(made.map(drop).map_err(|fault| vec![for_circuit(fault, swarm.span)]));
        }
        let clock = step.clock.map(|clock| (clock, step.rises));
        for test in
            self.program.tests.iter().filter(|test| is_same_instance(self.program, &test.circuit, &swarm.circuit))
        {
            let rows: Vec<TestRow> = match &test.stimulation {
                Stimulation::Rows(rows) => rows.clone(),
                // What such rows must show is found when they are performed.
                Stimulation::Script(script) => {
                    let rows = script.steps.iter().flat_map(|step| &step.rows);
                    rows.map(|row| TestRow { expected: Vec::new(), ..row.clone() }).collect()
                }
                Stimulation::All { .. } | Stimulation::Ever { .. } => continue,
            };
            self.note(waves::steps(test, &rows, clock, swarm.waves.step).map(drop));
        }
    }

    /// A missing file may still appear, so it is only a warning.
    fn environment(&mut self, test: &CircuitTest, files: &[(String, String)]) {
        if let Stimulation::Script(script) = &test.stimulation
            && script.environment.is_some()
        {
            let built = script::environment(&self.checked.context.world, self.program, test, script, files);
            self.note(built.map_err(|faults| faults.into_iter().map(later).collect()));
        }
    }
}

fn later(fault: Diagnostic) -> Diagnostic {
    let severity = if fault.code == Code::Unreadable { Severity::Warning } else { fault.severity };
    Diagnostic { severity, ..fault }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_robots_of_three_senses_have_multiplexers() {
        assert!(has_multiplexers(&nbc_swarm::cells(&crate::store::three_library())));
    }
}
