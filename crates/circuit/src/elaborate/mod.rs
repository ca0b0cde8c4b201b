//! Elaboration: from a checked circuit to a netlist. Each circuit is built once for each choice of its parameters, as a
//! module; a netlist is a flattened module. The structure of the source is kept: a `not` is a cell, and a loop
//! stays as it is.
//!
//! Widths, bits and parameters are computed here, so their errors are found here; an [`Inspector`] finds only these.

mod build;
mod dense;
mod driven;
mod emit;
mod flatten;
mod instance;
mod loops;
mod memories;
mod module;
mod numbers;
mod outside;
mod size;
mod starts;
mod stored;
mod table;
mod table_faults;
mod unroll;
mod width;
mod wording;

pub use build::KeptModules;
pub use module::MemoryPorts;
pub use table_faults::{table_fault, table_in_bits};
pub use wording::{not_a_pattern, two_else};

use crate::Netlist;
use nbc_base::budget::{OverBudget, WorkBudget};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Circuit, CircuitId, Column, Instance, Program};
use nbc_base::source::Span;

use build::Builder;
use module::{Module, ModuleId};

pub fn elaborate(program: &Program, instance: &Instance) -> Result<Netlist, Vec<Diagnostic>> {
    changed(program, instance, |_| {})
}

/// Its outputs are the bits of the net declared at `net`, in every iteration; the rest is there, without a listener.
pub fn elaborate_net(program: &Program, instance: &Instance, net: Span) -> Result<Netlist, Vec<Diagnostic>> {
    changed(program, instance, |module| module.show(net))
}

/// The netlist of a circuit whose outputs are followed by nets inside it, which are declared at these places.
pub fn elaborate_watched(program: &Program, instance: &Instance, nets: &[Span]) -> Result<Netlist, Vec<Diagnostic>> {
    changed(program, instance, |module| nets.iter().for_each(|&net| module.watch(net)))
}

fn changed(
    program: &Program,
    instance: &Instance,
    change: impl FnOnce(&mut Module),
) -> Result<Netlist, Vec<Diagnostic>> {
    let mut builder = Builder::new(program);
    let module = builder.instance(instance);
    if let Some(ModuleId(at)) = module {
        change(&mut builder.modules[at as usize]);
    }
    finish(builder, module, &instance.to_string())
}

/// The netlist of an environment, whose ports also have the accesses to its memories, and those of each memory.
pub fn elaborate_environment(
    program: &Program,
    circuit: CircuitId,
) -> Result<(Netlist, Vec<MemoryPorts>), Vec<Diagnostic>> {
    let mut builder = Builder::new(program);
    let module = builder.with_defaults(circuit);
    let memories = module.map_or(Vec::new(), |module| builder.module(module).memories.clone());
    let name = builder.circuit(circuit).name.clone();
    finish(builder, module, &name).map(|netlist| (netlist, memories))
}

pub fn elaborate_reference(program: &Program, circuit: &Circuit) -> Result<Netlist, Vec<Diagnostic>> {
    let mut builder = Builder::new(program);
    let module = builder.reference(circuit);
    finish(builder, module, &circuit.name)
}

pub fn is_same_instance(program: &Program, one: &Instance, other: &Instance) -> bool {
    let complete = |instance: &Instance| {
        let circuit = program.circuit(&instance.circuit)?;
        let mut given: Vec<_> = instance.arguments.iter().map(|&value| Some(value.into())).collect();
        given.resize(circuit.parameters.len(), None);
        instance::arguments(circuit, given, &[], circuit.span).ok()
    };
    one == other || (one.circuit == other.circuit && complete(one).is_some_and(|all| Some(all) == complete(other)))
}

fn finish(mut builder: Builder<'_>, module: Option<ModuleId>, name: &str) -> Result<Netlist, Vec<Diagnostic>> {
    let netlist = module.map(|module| flatten::flatten(&builder, module, name)).transpose();
    let netlist = netlist.unwrap_or_else(|fault| {
        builder.diagnostics.push(fault);
        None
    });
    match netlist {
        Some(netlist) if builder.diagnostics.iter().all(|diagnostic| !diagnostic.is_error()) => Ok(netlist),
        _ => Err(builder.diagnostics.into_iter().filter(Diagnostic::is_error).collect()),
    }
}

/// Builds circuits only to find their errors.
pub struct Inspector<'a>(Builder<'a>);

impl<'a> Inspector<'a> {
    /// `is_same` says of each circuit whether it is as it was when `kept` was made.
    pub fn new(program: &'a Program, budget: WorkBudget, kept: KeptModules, is_same: &[bool]) -> Self {
        let mut builder = Builder::within(program, budget);
        builder.keep(kept, is_same);
        Self(builder)
    }

    pub fn budget(&mut self) -> &mut WorkBudget {
        &mut self.0.budget
    }

    pub fn inspect(&mut self, circuit: CircuitId) {
        if let Some(module) = self.0.with_defaults(circuit) {
            self.0.look_for_loops(module);
        }
    }

    pub fn inspect_body(&mut self, circuit: &'a Circuit) {
        if let Some(module) = self.0.reference(circuit) {
            self.0.look_for_loops(module);
        }
    }

    /// The ports with these first parameters, if the circuit can be built; it is named at `place`.
    pub fn ports(&mut self, circuit: CircuitId, arguments: &[u64], place: Span) -> Option<(Vec<Column>, Vec<Column>)> {
        let known = self.0.diagnostics.len();
        let module = self.0.with_arguments(circuit, arguments, place);
        self.0.show_at(place, known);
        let module = module?;
        self.0.look_for_loops(module);
        Some(self.0.columns(module))
    }

    pub fn net(&mut self, circuit: CircuitId, arguments: &[u64], place: Span, name: &str) -> Option<(Column, Span)> {
        let module = self.0.with_arguments(circuit, arguments, place)?;
        self.0.inner_net(module, name)
    }

    pub fn has_memory(&mut self, circuit: CircuitId, arguments: &[u64], place: Span) -> bool {
        self.0.with_arguments(circuit, arguments, place).is_some_and(|module| self.0.has_memory(module))
    }

    pub fn finish(self) -> (Inspection, KeptModules) {
        let nets = self.0.used().flat_map(|module| &module.nets);
        let mut widths: Vec<_> = nets.filter_map(|net| Some((net.span, net.width?))).collect();
        widths.sort_unstable();
        widths.dedup();
        let (widths, instances) = (NetWidths(widths), self.0.instances().collect());
        let is_cancelled = self.0.over == Some(OverBudget::Cancelled);
        let diagnostics = self.0.diagnostics.clone();
        (Inspection { diagnostics, widths, instances, is_cancelled }, self.0.into_kept())
    }
}

#[derive(Clone, Debug, Default)]
pub struct Inspection {
    pub diagnostics: Vec<Diagnostic>,
    pub widths: NetWidths,
    pub instances: Vec<Instance>,
    pub is_cancelled: bool,
}

/// The widths of nets, in order of their declarations. A net of a circuit with parameters may have several.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NetWidths(Vec<(Span, u32)>);

impl NetWidths {
    pub fn of(&self, declared: Span) -> impl Iterator<Item = u32> + '_ {
        let start = self.0.partition_point(|(place, _)| *place < declared);
        self.0[start..].iter().take_while(move |(place, _)| *place == declared).map(|(_, width)| *width)
    }
}
