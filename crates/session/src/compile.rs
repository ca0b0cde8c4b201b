//! Compilation of a circuit from source to swarm: elaborate, map, prove, time, assemble.

use std::sync::Arc;

use crate::checked::Checked;
use crate::compiled::{Compiled, Plan};
use crate::context::lock;
use crate::mapping::Mapping;
use crate::options::CompileOptions;
use crate::waves::map_waves;
use crate::wording::{self, for_circuit};
use nbc_base::budget::Limit;
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::{Instance, NamedWorld, Program, RegisterStyle};
use nbc_base::source::Span;
use nbc_circuit::passes::sweep;
use nbc_circuit::{
    CellLibrary, MapOptions, MappingObjective, Netlist, RegisterForm, elaborate_net, has_multiplexers, kept,
    latches_as_registers, lower, map_with, prove,
};
use nbc_swarm::Assembly;

/// Swarms of a source that are not compiled again.
const RECENT: usize = 4;

impl Checked {
    /// Maps a circuit onto the robots of its swarm, and proves the result.
    pub fn map(&self, circuit: &Instance, options: &CompileOptions) -> Result<Mapping, Diagnostics> {
        self.diagnosed(self.plan(circuit, options).and_then(|plan| {
            let source = Netlist::clone(&*self.netlist(circuit)?);
            map(source, &plan, &options.mapping(), self.place(circuit), Limit::Cells)
        }))
    }

    pub fn map_net(&self, circuit: &Instance, net: Span, options: &CompileOptions) -> Result<Mapping, Diagnostics> {
        let plan = self.plan(circuit, options);
        self.diagnosed(plan.and_then(|plan| map_net(&self.program, &plan, net, options.mapping())))
    }

    /// Maps a circuit onto cells that need not be robots, and proves the result.
    pub fn map_onto(
        &self,
        circuit: &Instance,
        cells: &CellLibrary,
        options: &CompileOptions,
    ) -> Result<Mapping, Diagnostics> {
        self.diagnosed(self.netlist(circuit).and_then(|source| {
            let (source, place) = (Netlist::clone(&source), self.place(circuit));
            map_onto(source, cells, &options.mapping(), RegisterForm::Nands, place, Limit::Cells)
        }))
    }

    /// Compiles a circuit to the swarm that is declared for it: elaborate, map, prove, time, assemble.
    pub fn compile(&self, circuit: &Instance, options: &CompileOptions) -> Result<Compiled, Diagnostics> {
        let plan = self.plan(circuit, options);
        self.diagnosed(plan.and_then(|plan| self.compiled(plan, options, self.place(circuit))))
    }

    pub(super) fn compiled(
        &self,
        plan: Plan,
        options: &CompileOptions,
        place: Span,
    ) -> Result<Compiled, Vec<Diagnostic>> {
        let (objective, effort) = (options.objective, options.effort);
        let is_same = |(by, with, known): &&(_, _, Compiled)| (*by, *with) == (objective, effort) && known.plan == plan;
        let known = lock(&self.context.compiled).iter().find(is_same).map(|(.., known)| known.clone());
        let mut compiled = match known {
            Some(known) => known,
            None => {
                let source = Netlist::clone(&*self.netlist(&plan.circuit)?);
                let mapping = map(source, &plan, &options.mapping(), place, Limit::SwarmGates)?;
                permit(&mapping.netlist, Limit::Robots, place)?;
                let timing = plan.timing(&mapping);
                let mut assembly = assemble(&mapping, &plan, objective);
                name_values(&self.program, &plan.circuit, &mut assembly);
                let weak_robots = nbc_swarm::weak_robots(&assembly);
                Compiled { plan, mapping, timing, assembly, weak_robots, warnings: Vec::new() }
            }
        };
        // What was cancelled may have more robots than needed.
        if !options.cancel.is_raised() {
            let mut recent = lock(&self.context.compiled);
            recent.retain(|(.., known)| known.plan != compiled.plan);
            recent.insert(0, (objective, effort, compiled.clone()));
            recent.truncate(RECENT);
        }
        let circuit = compiled.plan.circuit.to_string();
        let warnings = compiled.weak_robots.iter().map(|weak| wording::weak_robot(&circuit, weak, place));
        compiled.warnings = warnings.collect();
        Ok(compiled)
    }
}

/// Panics if the mapped netlist is not proved equal to its source, which is a fault of the compiler.
pub(super) fn synthesize(
    source: Netlist,
    cells: &CellLibrary,
    options: &MapOptions,
    form: RegisterForm,
) -> Result<Mapping, Diagnostic> {
    // Latches that were written as cells become multiplexers, too.
    let raised = match form {
        RegisterForm::Nands => None,
        RegisterForm::Multiplexers => latches_as_registers(&source).ok(),
    };
    let read = raised.as_ref().unwrap_or(&source);
    let mapped = map_with(read, cells, options).map_err(|error| wording::unmapped(&error))?;
    let proof = prove(read, &mapped)
        .unwrap_or_else(|error| panic!("the compiled circuit `{}` differs from its source: {error}", source.name));
    let netlist = lower(&mapped, cells, form).map_err(|error| wording::unmapped(&error))?;
    let kept = if form == RegisterForm::Multiplexers { kept(&mapped) } else { Vec::new() };
    Ok(Mapping { source, netlist, cells: cells.clone(), proof, kept, waves: None })
}

/// `gates` limits the size of the source.
pub(super) fn map_onto(
    source: Netlist,
    cells: &CellLibrary,
    options: &MapOptions,
    form: RegisterForm,
    place: Span,
    gates: Limit,
) -> Result<Mapping, Vec<Diagnostic>> {
    permit(&source, gates, place)?;
    synthesize(source, cells, options, form).map_err(|fault| vec![for_circuit(fault, place)])
}

fn permit(netlist: &Netlist, limit: Limit, place: Span) -> Result<(), Vec<Diagnostic>> {
    limit.permit(netlist.size() as u64).map_err(|over| vec![over.at(place)])
}

fn map(
    source: Netlist,
    plan: &Plan,
    options: &MapOptions,
    place: Span,
    gates: Limit,
) -> Result<Mapping, Vec<Diagnostic>> {
    let cells = nbc_swarm::cells(&plan.library);
    let map = |source, form| map_onto(source, &cells, options, form, place, gates);
    match plan.registers {
        RegisterStyle::MasterSlave => map(source, RegisterForm::Nands),
        RegisterStyle::Mux if has_multiplexers(&cells) => map(source, RegisterForm::Multiplexers),
        RegisterStyle::Mux => Err(vec![for_circuit(wording::no_multiplexer(), place)]),
        RegisterStyle::Waves => {
            need_beat(std::slice::from_ref(&plan.world), place)?;
            permit(&source, gates, place)?;
            let mapping = map_waves(source, &plan.library, plan.waves, options);
            mapping.map_err(|fault| vec![for_circuit(fault, place)])
        }
    }
}

/// Wave machines run only in worlds in which all robots are heard at one time.
pub(super) fn need_beat(worlds: &[NamedWorld], place: Span) -> Result<(), Vec<Diagnostic>> {
    match worlds.iter().find(|world| world.world.lateness() > 0) {
        Some(world) => Err(vec![for_circuit(wording::waves_need_a_beat(&world.name), place)]),
        None => Ok(()),
    }
}

fn map_net(program: &Program, plan: &Plan, net: Span, options: MapOptions) -> Result<Mapping, Vec<Diagnostic>> {
    let source = elaborate_net(program, &plan.circuit, net)?;
    let mapping = synthesize(source, &nbc_swarm::cells(&plan.library), &options, RegisterForm::Nands);
    let mut mapping = mapping.map_err(|fault| vec![for_circuit(fault, net)])?;
    // The proof was of all that was elaborated. What is shown is the part of the net.
    sweep(&mut mapping.source);
    Ok(mapping)
}

fn assemble(mapping: &Mapping, plan: &Plan, objective: MappingObjective) -> Assembly {
    let assembly = match &mapping.waves {
        None => nbc_swarm::assemble(&mapping.netlist, &plan.library),
        Some(machine) => {
            let library = nbc_swarm::within_beat(&plan.library, machine.beat, objective);
            nbc_swarm::assemble_waves(machine, &library)
        }
    };
    assembly.in_world(plan.world.world)
}

fn name_values(program: &Program, circuit: &Instance, assembly: &mut Assembly) {
    let Some(circuit) = program.circuit(&circuit.circuit) else { return };
    for net in &circuit.nets[..circuit.inputs + circuit.outputs] {
        let Some(members) = net.members.and_then(|place| program.enumerations.get(place)) else { continue };
        let ports = assembly.inputs.iter_mut().chain(&mut assembly.outputs);
        for port in ports.filter(|port| port.name == net.name && port.width == members.width as usize) {
            port.members = Some(Arc::new(members.clone()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Session, TestOptions};
    use nbc_base::source::MemoryWorld;
    use nbc_swarm::Level;

    #[test]
    fn a_circuit_is_compiled_once_for_its_tests_and_again_for_other_robots() {
        let mut session = Session::new(MemoryWorld::default());
        let rows = "{\n a | q\n 0 | 1\n}\n";
        let text = format!("circuit f(a) -> (q) {{ q = not a }}\ntest f \"one\" {rows}test f \"two\" {rows}");
        session.update("a.nb", 0, text);
        let checked = session.open("a.nb").unwrap();
        let mut options = TestOptions { level: Some(Level::Physics), ..TestOptions::default() };
        let compiled = |options: &TestOptions| {
            for test in &checked.program.tests {
                assert_eq!(checked.cases(test, options).unwrap().len(), 1);
            }
            lock(&checked.context.compiled).len()
        };
        assert_eq!(compiled(&options), 1);
        options.compile.without = vec!["nand_5x5".to_owned()];
        assert_eq!(compiled(&options), 2);
    }
}
