//! The simulations and the tests of a program, once its circuits and swarms are known.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::slice;

use crate::check::against;
use crate::check::circuit::{CheckedCircuit, circuit};
use crate::check::instance::instance;
use crate::check::names::Home;
use crate::check::program::Assembly;
use crate::check::quantity;
use crate::check::simulate::{Schedules, spells};
use crate::check::test;
use crate::check::uses::{NameKind, NameUse};
use crate::check::vocabulary::Vocabulary;
use crate::check::wording;
use crate::syntax::tree::{self, DeclarationKind, NameSyntax, TestItem, TestTable};
use nbc_base::budget::{CYCLE_BITS, Limit};
use nbc_base::diag::{Code, Diagnostic};
use nbc_base::model::{
    Circuit, CircuitId, CircuitTest, Column, Instance, Program, RowSource, Script, Simulation, Stimulation, TestRow,
};
use nbc_base::source::Span;
use nbc_circuit::Inspector;

impl<'a> Assembly<'a> {
    pub(super) fn simulations(&mut self, program: &Program, inspector: &mut Inspector<'_>) -> Vec<Simulation> {
        let mut simulations = Vec::new();
        for declaration in self.declarations.own() {
            let DeclarationKind::Simulate(source) = &declaration.kind else { continue };
            let Some(simulated) = self.simulated(&source.swarm, program) else { continue };
            let Some((inputs, _)) = self.ports(&simulated, source.swarm.span, inspector) else { continue };
            if let tree::With::Spells { columns, spells } = &source.with {
                self.ports_named(&simulated.circuit, columns);
                spells.iter().for_each(|spell| self.members_named(columns, &spell.cells, &inputs));
            }
            let schedules = Schedules { names: &self.names.schedules, declared: &program.schedules };
            let at = source.swarm.span;
            let spells =
                spells(&source.with, at, &inputs, Home::Own, schedules, self.declarations.sources, &mut self.faults);
            let cycles = spells.iter().map(|spell| u64::from(spell.cycles)).sum();
            self.permit_cycles(cycles, &inputs, at);
            let world = self.world(source.world.as_ref());
            let (file, line) = self.declarations.line(declaration.span);
            let (swarm, span) = (source.swarm.text.clone(), source.swarm.span);
            simulations.push(Simulation { swarm, circuit: simulated, span, file, line, inputs, spells, world });
        }
        simulations
    }

    /// The circuit of the swarm of that name or, if there is none, the circuit of that name.
    fn simulated(&mut self, name: &NameSyntax, program: &Program) -> Option<Instance> {
        let is_circuit = self.names.circuits.find(&name.text, Home::Own).is_some();
        if self.names.swarms.find(&name.text, Home::Own).is_none() && is_circuit {
            let circuit = self.names.circuits.resolve(name, Home::Own).ok()?;
            return Some(Instance::from(self.circuits.headers.circuits[circuit].name.as_str()));
        }
        match self.names.swarms.resolve(name, Home::Own) {
            Ok(swarm) => swarm.map(|swarm| program.swarms[swarm].circuit.clone()),
            Err(fault) => {
                self.faults.push(fault);
                None
            }
        }
    }

    pub(super) fn test(
        &mut self,
        span: Span,
        source: &'a tree::Test,
        program: &Program,
        inspector: &mut Inspector<'_>,
    ) -> Option<CircuitTest> {
        let worlds = source.worlds.iter().filter_map(|world| self.world(Some(world))).collect();
        let tested = self.instance(&source.circuit, program)?;
        let (inputs, outputs) = self.ports(&tested, source.circuit.name.span, inspector)?;
        let ports = (&inputs[..], &outputs[..]);
        let environment = match &source.environment {
            Some(name) => Some(self.environment(name, &tested, ports, program, inspector)?),
            None => None,
        };
        let stimulation = match &source.kind {
            tree::TestKind::Table(table) => {
                self.ports_named(&tested.circuit, &table.inputs);
                self.ports_named(&tested.circuit, &table.outputs);
                self.rows_named(&tested.circuit, table, &table.rows, ports);
                let given = environment.as_ref().map_or(Vec::new(), |(_, given)| given.clone());
                let ports = test::Ports { circuit: &tested.circuit, inputs: &inputs, outputs: &outputs, given };
                let (sources, room) = (self.declarations.sources, (inspector.budget(), source.worlds.len().max(1)));
                let steps = test::steps(table, &ports, room, sources, &mut self.faults);
                let cycles = steps.iter().flat_map(|step| &step.rows).map(|row| u64::from(row.hold.unwrap_or(1)));
                self.permit_cycles(cycles.sum(), &inputs, source.circuit.name.span);
                let environment = environment.map(|(environment, _)| environment);
                if environment.is_some() || steps.iter().any(|step| step.until.is_some()) {
                    Stimulation::Script(Script { environment, steps })
                } else {
                    Stimulation::Rows(steps.into_iter().flat_map(|step| step.rows).collect())
                }
            }
            tree::TestKind::FromFile { path, .. } => {
                if environment.is_some() {
                    self.faults.push(wording::rows_from_file(&tested.circuit, path.span));
                    return None;
                }
                let rows = self.rows_from_file(path, &tested.circuit, ports, source.worlds.len().max(1), inspector)?;
                self.permit_cycles(rows.len() as u64, &inputs, path.span);
                Stimulation::Rows(rows)
            }
            tree::TestKind::Against(other) => {
                let (_, reference) = self.against(&source.circuit, other, program, inspector, ports)?;
                Stimulation::All { reference }
            }
            tree::TestKind::Ever(other) => {
                let (other, reference) = self.against(&source.circuit, other, program, inspector, ports)?;
                Stimulation::Ever { other, reference }
            }
            tree::TestKind::Reference(body) => {
                let reference = Box::new(self.reference(&tested, &source.circuit.name, body, ports, program)?);
                Stimulation::All { reference }
            }
        };
        if let Stimulation::All { .. } = stimulation {
            let place = source.circuit.name.span;
            self.all_inputs((&inputs, &outputs), source.worlds.len().max(1), inspector, place)?;
            let circuit = self.circuits.place(&tested.circuit);
            if circuit.is_some_and(|circuit| inspector.has_memory(circuit, &tested.arguments, place)) {
                self.faults.push(wording::all_inputs_of_memory(&tested.circuit, place));
            }
        }
        let rows_from = match &source.kind {
            tree::TestKind::FromFile { path, at_least } => Some(self.row_source(path, at_least.as_ref())?),
            _ => None,
        };
        let title = source.title.as_ref().map_or(String::new(), |title| title.text.clone());
        let (file, line) = self.declarations.line(span);
        Some(CircuitTest { circuit: tested, title, span, file, line, inputs, outputs, stimulation, rows_from, worlds })
    }

    fn rows_from_file(
        &mut self,
        path: &tree::Text,
        circuit: &str,
        (inputs, outputs): (&[Column], &[Column]),
        worlds: usize,
        inspector: &mut Inspector<'_>,
    ) -> Option<Vec<TestRow>> {
        let source = self.declarations.sources.file(*self.rows.get(&path.span)?);
        let read = test::file_rows(source, circuit, inputs, outputs, (inspector.budget(), worlds), path.span);
        read.map_err(|faults| self.faults.extend(faults)).ok()
    }

    fn row_source(&mut self, path: &tree::Text, at_least: Option<&tree::Quantity>) -> Option<RowSource> {
        let file = self.declarations.sources.file(*self.rows.get(&path.span)?).name.clone();
        let percent = at_least.map(quantity::percent).transpose();
        let at_least = percent.map_err(|fault| self.faults.push(fault)).ok()?;
        Some(RowSource { file, at_least })
    }

    fn rows_named(
        &mut self,
        circuit: &str,
        table: &TestTable,
        items: &[TestItem],
        (inputs, outputs): (&[Column], &[Column]),
    ) {
        for item in items {
            match item {
                TestItem::Repeat { rows, .. } => self.rows_named(circuit, table, rows, (inputs, outputs)),
                TestItem::Row(row) => {
                    self.members_named(&table.inputs, &row.inputs, inputs);
                    self.members_named(&table.outputs, &row.outputs, outputs);
                    let Some(until) = &row.until else { continue };
                    let output = slice::from_ref(&until.output);
                    self.ports_named(circuit, output);
                    until.value.iter().for_each(|value| self.members_named(output, slice::from_ref(value), outputs));
                }
            }
        }
    }

    fn members_named(&mut self, columns: &[NameSyntax], values: &[NameSyntax], ports: &[Column]) {
        let used = |(column, value): (&NameSyntax, &NameSyntax)| {
            let port = ports.iter().find(|port| port.name == column.text)?;
            let declared = port.members.as_ref()?.member(&value.text)?.span;
            Some(NameUse { place: value.span, declared, kind: NameKind::Member })
        };
        self.inner.extend(columns.iter().zip(values).filter_map(used));
    }

    /// The inputs of an environment are outputs of the circuit, or inputs with columns; its outputs are inputs of the
    /// circuit, or what it prints. Returns also the inputs that it gives.
    pub(super) fn environment(
        &mut self,
        name: &NameSyntax,
        tested: &Instance,
        (inputs, outputs): (&[Column], &[Column]),
        program: &Program,
        inspector: &mut Inspector<'_>,
    ) -> Option<(CircuitId, Vec<String>)> {
        let place = match self.names.circuits.resolve(name, Home::Own) {
            Ok(place) => CircuitId(place as u32),
            Err(fault) => {
                self.faults.push(fault);
                return None;
            }
        };
        if !program.environments.contains(&place) {
            self.faults.push(wording::no_environment(name));
            return None;
        }
        if !self.circuits.is_sound(place) {
            return None;
        }
        let (own_inputs, own_outputs) = inspector.ports(place, &[], name.span)?;
        let circuit = &program.circuits[place.0 as usize];
        let declared = |columns: Vec<Column>, count: usize| columns.into_iter().take(count).collect::<Vec<_>>();
        let (own_inputs, own_outputs) = (declared(own_inputs, circuit.inputs), declared(own_outputs, circuit.outputs));
        let before = self.faults.len();
        let mut same = |own: &Column, others: &[&[Column]]| {
            let found = others.iter().flat_map(|ports| ports.iter()).find(|port| port.name == own.name);
            if let Some(port) = found.filter(|port| port.width != own.width) {
                self.faults.push(wording::environment_width(&own.name, own.width, port.width, name.span));
            }
            found.is_some()
        };
        let mut given = Vec::new();
        for own in &own_outputs {
            if same(own, &[inputs]) {
                given.push(own.name.clone());
            }
        }
        let mut unknown = Vec::new();
        for own in &own_inputs {
            if given.contains(&own.name) || !same(own, &[outputs, inputs]) {
                unknown.push(wording::environment_port(&own.name, &tested.circuit, name.span));
            }
        }
        self.faults.extend(unknown);
        (self.faults.len() == before).then_some((place, given))
    }

    pub(super) fn same_titles(&mut self) {
        let mut known = BTreeMap::new();
        for (_, test) in self.declarations.own_tests() {
            let Some(title) = &test.title else { continue };
            let instance = test
                .circuit
                .arguments
                .last()
                .map_or(test.circuit.name.span, |last| test.circuit.name.span.to(last.span));
            let circuit = self.declarations.sources.text(instance);
            let world: Vec<&String> = test.worlds.iter().map(|world| &world.text).collect();
            match known.entry((circuit, &title.text, world)) {
                Entry::Vacant(entry) => _ = entry.insert(title.span),
                Entry::Occupied(first) => {
                    let circuit = &test.circuit.name.text;
                    self.faults.push(wording::same_title(circuit, &title.text, *first.get(), title.span));
                }
            }
        }
    }

    pub(super) fn instance(&mut self, source: &tree::InstanceSyntax, program: &Program) -> Option<Instance> {
        let declared = Vocabulary::of(&self.names, program);
        let named = instance(source, Home::Own, declared, &self.circuits.headers);
        named.map_err(|fault| self.faults.push(fault)).ok()
    }

    fn against(
        &mut self,
        tested: &tree::InstanceSyntax,
        other: &tree::InstanceSyntax,
        program: &Program,
        inspector: &mut Inspector<'_>,
        ports: (&[Column], &[Column]),
    ) -> Option<(Instance, Box<Circuit>)> {
        let names = [&tested.name, &other.name];
        let other = self.instance(other, program)?;
        let (inputs, outputs) = self.ports(&other, names[1].span, inspector)?;
        let circuit = self.circuits.place(&other.circuit)?;
        let mut arguments: Vec<Option<u64>> = other.arguments.iter().copied().map(Some).collect();
        arguments.resize(program.circuits[circuit.0 as usize].parameters.len(), None);
        let reference = against::reference(names, ports, (circuit, &arguments), (&inputs, &outputs));
        let reference = Box::new(reference.map_err(|fault| self.faults.push(fault)).ok()?);
        Some((other, reference))
    }

    fn reference(
        &mut self,
        instance: &Instance,
        tested: &NameSyntax,
        body: &tree::BodySyntax,
        ports: (&[Column], &[Column]),
        program: &Program,
    ) -> Option<Circuit> {
        let mut body = body.clone();
        let mut port = |column: &Column| against::port(column, tested.span, &mut body);
        let (inputs, outputs) = (ports.0.iter().map(&mut port).collect(), ports.1.iter().map(&mut port).collect());
        let name = NameSyntax { text: format!("{instance} as tested"), span: tested.span };
        let source = tree::CircuitSyntax { is_environment: false, name, parameters: Vec::new(), inputs, outputs, body };
        let checked = circuit(&source, Home::Own, Vocabulary::of(&self.names, program), &self.circuits.headers, None);
        self.beside_ports(checked, tested, &instance.circuit)
    }

    /// A checked circuit with the ports of another, named at `tested`, some of which it may ignore.
    pub(super) fn beside_ports(
        &mut self,
        checked: CheckedCircuit,
        tested: &NameSyntax,
        circuit: &str,
    ) -> Option<Circuit> {
        let sound = !self.declarations.is_broken(tested.span) && !checked.diagnostics.iter().any(Diagnostic::is_error);
        let called = checked.calls.iter().all(|&(callee, _)| self.circuits.is_sound(callee));
        let (ports, own): (Vec<_>, Vec<_>) = checked.uses.into_iter().partition(|found| found.declared == tested.span);
        let names: Vec<_> = ports
            .into_iter()
            .filter(|found| found.place != tested.span)
            .map(|found| NameSyntax { text: self.declarations.sources.text(found.place).to_owned(), span: found.place })
            .collect();
        self.ports_named(circuit, &names);
        self.inner.extend(own);
        self.faults.extend(checked.diagnostics.into_iter().filter(|fault| fault.code != Code::Unused));
        (sound && called).then_some(checked.circuit)
    }

    fn all_inputs(
        &mut self,
        (inputs, outputs): (&[Column], &[Column]),
        worlds: usize,
        inspector: &mut Inspector<'_>,
        span: Span,
    ) -> Option<()> {
        let bits: usize = inputs.iter().map(|column| column.width).sum();
        if Limit::TriedBits.permit(bits as u64).is_err() {
            self.faults.push(wording::many_inputs(bits, Limit::TriedBits.most(), span));
            return None;
        }
        let columns = inputs.iter().chain(outputs).map(|column| column.width as u64 + 1);
        let taken = test::take_rows(inspector.budget(), (worlds as u64) << bits, columns.sum());
        self.note(taken.map_err(|over| over.at(span))).then_some(())
    }

    fn permit_cycles(&mut self, cycles: u64, inputs: &[Column], span: Span) {
        let bits = inputs.iter().map(|column| column.width as u64).sum::<u64>() + CYCLE_BITS;
        let permitted = Limit::CycleBits.permit(cycles.saturating_mul(bits));
        self.note(permitted.map_err(|over| over.at(span)));
    }
}
