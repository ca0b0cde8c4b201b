//! Builds modules, each once for each choice of parameters.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::elaborate::module::{
    Bit, Item, Making, Module, ModuleId, ModuleKey, ModuleNet, ModulePort, ModuleSignal, Passes, Scope, Sum,
};
use crate::elaborate::wording;
use nbc_base::budget::{Limit, OverBudget, WorkBudget};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{Circuit, CircuitId, Column, ExpressionId, Instance, NetSlot, Program};
use nbc_base::source::Span;

/// By the places of the limits in [`Limit::ALL`].
type Spent = [u64; Limit::ALL.len()];

/// The modules of a check, those inside others first.
#[derive(Default)]
pub struct KeptModules(Vec<(Module, Making)>);

pub(super) struct Builder<'a> {
    pub(super) program: &'a Program,
    /// References of tests, which are numbered after the program's circuits.
    references: Vec<&'a Circuit>,
    pub(super) modules: Vec<Module>,
    makings: Vec<Making>,
    /// Those of the last check.
    kept: BTreeMap<ModuleKey, ModuleId>,
    /// The module of each circuit and its parameters; `None` if it is invalid or under construction.
    known: BTreeMap<ModuleKey, Option<ModuleId>>,
    pub(super) diagnostics: Vec<Diagnostic>,
    noted: BTreeSet<Diagnostic>,
    /// Faults, also those that were noted before.
    faults: usize,
    depth: usize,
    /// For what is inside the module that is being built.
    inside: Spent,
    pub(super) inspected: Vec<bool>,
    pub(super) passes: Passes,
    pub(super) budget: WorkBudget,
    pub(super) over: Option<OverBudget>,
}

const MOST_FAULTS: usize = 10_000;

impl<'a> Builder<'a> {
    pub(super) fn new(program: &'a Program) -> Self {
        Self::within(program, WorkBudget::default())
    }

    pub(super) fn within(program: &'a Program, budget: WorkBudget) -> Self {
        Self {
            program,
            references: Vec::new(),
            modules: Vec::new(),
            makings: Vec::new(),
            kept: BTreeMap::new(),
            known: BTreeMap::new(),
            diagnostics: Vec::new(),
            noted: BTreeSet::new(),
            faults: 0,
            depth: 0,
            inside: [0; Limit::ALL.len()],
            inspected: Vec::new(),
            passes: Passes::new(),
            budget,
            over: None,
        }
    }

    pub(super) fn take(&mut self, limit: Limit, amount: u64, place: Span) -> Option<()> {
        if self.over.is_some() {
            return None;
        }
        let taken = self.budget.take(limit, amount);
        taken
            .map_err(|over| {
                self.over = Some(over);
                self.fault(over.at(place));
            })
            .ok()
    }

    pub(super) fn module(&self, id: ModuleId) -> &Module {
        &self.modules[id.0 as usize]
    }

    pub(super) fn circuit(&self, id: CircuitId) -> &'a Circuit {
        let at = id.0 as usize;
        self.program.circuits.get(at).unwrap_or_else(|| self.references[at - self.program.circuits.len()])
    }

    pub(super) fn reference(&mut self, circuit: &'a Circuit) -> Option<ModuleId> {
        self.references.push(circuit);
        self.with_defaults(CircuitId((self.program.circuits.len() + self.references.len() - 1) as u32))
    }

    pub(super) fn fault(&mut self, fault: Diagnostic) {
        self.faults += 1;
        if self.diagnostics.len() < MOST_FAULTS && self.noted.insert(fault.clone()) {
            self.diagnostics.push(fault);
        }
    }

    /// Moves the errors after the first `known` that are in another file to `place`, where the circuit is used.
    pub(super) fn show_at(&mut self, place: Span, known: usize) {
        for fault in &mut self.diagnostics[known..] {
            if fault.labels.first().is_some_and(|label| label.span.file != place.file) {
                wording::shown_at(fault, place);
            }
        }
    }

    pub(super) fn instance(&mut self, instance: &Instance) -> Option<ModuleId> {
        let circuits = &self.program.circuits;
        let Some(at) = circuits.iter().position(|circuit| circuit.name == instance.circuit) else {
            let meant = Suggestion::of(&instance.circuit, circuits.iter().map(|circuit| circuit.name.as_str()));
            self.fault(wording::unknown_circuit(&instance.circuit, &meant));
            return None;
        };
        let circuit = CircuitId(at as u32);
        self.with_arguments(circuit, &instance.arguments, self.circuit(circuit).span)
    }

    pub(super) fn with_arguments(&mut self, circuit: CircuitId, arguments: &[u64], place: Span) -> Option<ModuleId> {
        let mut given: Vec<_> = arguments.iter().map(|&value| Some(value.into())).collect();
        given.resize(self.circuit(circuit).parameters.len(), None);
        let arguments = self.arguments(circuit, given, &[], place)?;
        self.build(ModuleKey { circuit, arguments, absent: Vec::new() })
    }

    pub(super) fn with_defaults(&mut self, circuit: CircuitId) -> Option<ModuleId> {
        let parameters = &self.circuit(circuit).parameters;
        if parameters.iter().any(|parameter| parameter.default.is_none()) {
            return None;
        }
        let arguments = self.arguments(circuit, vec![None; parameters.len()], &[], self.circuit(circuit).span)?;
        self.build(ModuleKey { circuit, arguments, absent: Vec::new() })
    }

    pub(super) fn build(&mut self, key: ModuleKey) -> Option<ModuleId> {
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let place = self.circuit(key.circuit).span;
        if Limit::Hierarchy.permit(self.depth as u64 + 1).is_err() {
            self.fault(wording::too_deep(place));
            return None;
        }
        let kept = self.kept.get(&key).copied();
        let height = |id: ModuleId| self.makings[id.0 as usize].height;
        let fits = |&id: &ModuleId| Limit::Hierarchy.permit((self.depth + height(id)) as u64).is_ok();
        if let Some(id) = kept.filter(fits) {
            return self.adopt(id).map(|()| id);
        }
        let (faults, before) = (self.faults, self.spent());
        let around = std::mem::replace(&mut self.inside, [0; Limit::ALL.len()]);
        self.take(Limit::Modules, 1, place)?;
        self.known.insert(key.clone(), None);
        self.depth += 1;
        let module = ModuleBuilder::new(self, key.circuit).run(&key);
        self.depth -= 1;
        let now = self.spent();
        let own = Limit::ALL
            .iter()
            .zip(now)
            .zip(before)
            .zip(self.inside)
            .map(|(((limit, now), before), inside)| (*limit, now - before - inside));
        let spent = own.filter(|(_, amount)| *amount > 0).collect();
        self.inside = std::array::from_fn(|at| around[at] + now[at] - before[at]);
        let id = module.map(|module| {
            let levels = module.sites.iter().map(|site| self.makings[site.module.0 as usize].height);
            let height = levels.max().unwrap_or(0) + 1;
            let has_faults = self.faults > faults;
            self.add(module, Making { key: key.clone(), place, spent, has_faults, height, is_used: true })
        });
        self.known.insert(key, id);
        id
    }

    fn spent(&self) -> Spent {
        std::array::from_fn(|at| Limit::ALL[at].most() - self.budget.left(Limit::ALL[at]))
    }

    fn add(&mut self, module: Module, making: Making) -> ModuleId {
        self.modules.push(module);
        self.makings.push(making);
        self.inspected.push(false);
        ModuleId::new(self.modules.len() - 1)
    }

    /// Uses a module of the last check, and those inside it, as if they were built now.
    fn adopt(&mut self, id: ModuleId) -> Option<()> {
        let mut open = vec![id];
        while let Some(id) = open.pop() {
            let making = &mut self.makings[id.0 as usize];
            if std::mem::replace(&mut making.is_used, true) {
                continue;
            }
            let (place, spent) = (making.place, making.spent.clone());
            self.known.insert(making.key.clone(), Some(id));
            open.extend(self.module(id).sites.iter().map(|site| site.module));
            for (limit, amount) in spent {
                self.inside[limit as usize] += amount;
                self.take(limit, amount, place)?;
            }
        }
        Some(())
    }

    /// Takes the modules without faults whose circuits, and those inside, are as they were.
    pub(super) fn keep(&mut self, kept: KeptModules, is_same: &[bool]) {
        let mut places: Vec<Option<ModuleId>> = Vec::new();
        for (mut module, making) in kept.0 {
            let inside = module.sites.iter().map(|site| places[site.module.0 as usize]);
            let inside: Option<Vec<ModuleId>> = inside.collect();
            let is_same = is_same.get(making.key.circuit.0 as usize) == Some(&true);
            let inside = inside.filter(|_| is_same && making.is_used && !making.has_faults);
            places.push(inside.map(|inside| {
                module.sites.iter_mut().zip(inside).for_each(|(site, now)| site.module = now);
                let place = self.circuit(making.key.circuit).span;
                module.move_spans(making.place, place);
                let key = making.key.clone();
                let id = self.add(module, Making { place, is_used: false, ..making });
                self.kept.insert(key, id);
                id
            }));
        }
    }

    pub(super) fn used(&self) -> impl Iterator<Item = &Module> {
        self.modules.iter().zip(&self.makings).filter(|(_, making)| making.is_used).map(|(module, _)| module)
    }

    pub(super) fn into_kept(self) -> KeptModules {
        KeptModules(self.modules.into_iter().zip(self.makings).collect())
    }

    pub(super) fn instances(&self) -> impl Iterator<Item = Instance> + '_ {
        let built = self.known.iter().filter(|(key, module)| {
            let is_declared = (key.circuit.0 as usize) < self.program.circuits.len();
            module.is_some() && is_declared && key.absent.is_empty()
        });
        built.filter_map(|(key, _)| {
            let arguments = key.arguments.iter().map(|&value| u64::try_from(value).ok()).collect::<Option<_>>()?;
            Some(Instance { circuit: self.circuit(key.circuit).name.clone(), arguments })
        })
    }

    pub(super) fn columns(&self, id: ModuleId) -> (Vec<Column>, Vec<Column>) {
        let module = self.module(id);
        let columns = |ports: &[ModulePort]| ports.iter().map(|port| self.column(module, port)).collect();
        (columns(&module.inputs), columns(&module.outputs))
    }

    /// The net of that name which is no port, and where it is declared; `None` if there are several, as of a loop.
    pub(super) fn inner_net(&self, id: ModuleId, name: &str) -> Option<(Column, Span)> {
        let module = self.module(id);
        let ports = module.inputs.len() + module.outputs.len();
        let mut named = (ports..module.nets.len()).filter(|&net| module.nets[net].name == name);
        let net = named.next().filter(|_| named.next().is_none())?;
        let found = &module.nets[net];
        found.width.is_some().then(|| (self.column(module, &module.port(net)), found.span))
    }

    fn column(&self, module: &Module, port: &ModulePort) -> Column {
        let circuit = self.circuit(module.circuit);
        let net = circuit.nets[..circuit.inputs + circuit.outputs].get(port.net as usize);
        let members = net.and_then(|net| self.program.enumerations.get(net.members?));
        Column {
            name: port.name.clone(),
            width: port.width as usize,
            words: module.nets[port.net as usize].words.map(|words| words as usize),
            members: members.map(|members| Arc::new(members.clone())),
        }
    }
}

pub(super) struct ModuleBuilder<'a, 'b> {
    pub(super) builder: &'b mut Builder<'a>,
    pub(super) circuit: &'a Circuit,
    pub(super) module: Module,
    pub(super) frames: Vec<Scope>,
    pub(super) items: Vec<Item<'a>>,
    pub(super) constants: [Option<Bit>; 2],
    pub(super) unnamed: usize,
    pub(super) only_loops: bool,
    pub(super) failed: bool,
    pub(super) place: Span,
}

impl<'a, 'b> ModuleBuilder<'a, 'b> {
    fn new(builder: &'b mut Builder<'a>, id: CircuitId) -> Self {
        let circuit = builder.circuit(id);
        Self {
            builder,
            circuit,
            module: Module { circuit: id, ..Module::default() },
            frames: Vec::new(),
            items: Vec::new(),
            constants: [None; 2],
            unnamed: 0,
            only_loops: false,
            failed: false,
            place: circuit.span,
        }
    }

    fn run(mut self, key: &ModuleKey) -> Option<Module> {
        self.unroll(key.arguments.clone());
        if self.failed {
            return None;
        }
        self.ports(&key.absent)?;
        self.memory_ports();
        self.infer_widths();
        if self.failed {
            return None;
        }
        let is_stored = self.builder.program.stored == Some(key.circuit);
        if is_stored {
            self.stored(&key.arguments)?;
        }
        for at in 0..if is_stored { 0 } else { self.items.len() } {
            self.item(at as u32);
            if self.builder.over.is_some() {
                return None;
            }
        }
        self.driven_bits();
        self.undriven();
        self.contradicting_starts();
        self.total();
        (!self.failed).then_some(self.module)
    }

    pub(super) fn fault(&mut self, fault: Diagnostic) {
        self.failed |= fault.is_error();
        self.builder.fault(fault);
    }

    pub(super) fn take(&mut self, limit: Limit, amount: u64) -> Option<()> {
        let taken = self.builder.take(limit, amount, self.place);
        self.failed |= taken.is_none();
        taken
    }

    fn ports(&mut self, absent: &[u32]) -> Option<()> {
        let ports = self.circuit.inputs + self.circuit.outputs;
        for net in 0..ports {
            let width = match self.circuit.nets[net].width {
                Some(size) => self.width(size, 0)?,
                None => 1,
            };
            let words = self.declared_words(NetSlot(net as u32), 0);
            self.give_array(net, width, words);
            self.module.nets[net].width?;
            if net >= self.circuit.inputs {
                self.output(net);
            } else if absent.contains(&(net as u32)) {
                self.absent(net)?;
            } else {
                self.input(net);
            }
        }
        Some(())
    }

    pub(super) fn input(&mut self, net: usize) {
        let first = self.module.inputs.iter().map(|port| port.width).sum::<u32>();
        let port = self.module.port(net);
        for (at, bit) in (port.first..port.first + port.width).enumerate() {
            self.module.signals[bit as usize] = ModuleSignal::Input(first + at as u32);
        }
        self.module.inputs.push(port);
    }

    pub(super) fn output(&mut self, net: usize) {
        let port = self.module.port(net);
        self.module.output_bits.extend(port.first..port.first + port.width);
        self.module.outputs.push(port);
    }

    fn absent(&mut self, net: usize) -> Option<()> {
        let default = self.circuit.nets[net].default.expect("only inputs with a value are left out");
        let span = self.circuit.sizes[default.0 as usize].span;
        let value = self.unsigned(default, 0, span)?;
        let ModuleNet { first, width, .. } = self.module.nets[net];
        for (bit, value) in (first..).zip(self.fitting_bits(value, width?, span)?) {
            self.module.signals[bit as usize] = ModuleSignal::Constant(value);
        }
        Some(())
    }

    pub(super) fn give_array(&mut self, net: usize, width: u32, words: Option<u32>) {
        let bits = u64::from(width) * u64::from(words.unwrap_or(1));
        if Limit::Width.permit(bits).is_err() {
            let span = self.module.nets[net].span;
            self.fault(wording::net_width(bits.into(), span));
            return;
        }
        self.module.nets[net].words = words;
        self.give_width(net, bits as u32);
    }

    pub(super) fn give_width(&mut self, net: usize, width: u32) {
        // The first bit was counted when the net was opened.
        if self.take(Limit::Nets, u64::from(width).saturating_sub(1)).is_none() {
            return;
        }
        let first = self.module.signals.len() as u32;
        self.module.nets[net].width = Some(width);
        self.module.nets[net].first = first;
        let signal = |bit| ModuleSignal::Net { net: net as u32, bit, driver: None, by: 0 };
        self.module.signals.extend((0..width).map(signal));
    }

    pub(super) fn declared_width(&mut self, slot: NetSlot, frame: u32) -> Option<u32> {
        let size = self.circuit.nets[slot.0 as usize].width?;
        self.width(size, frame)
    }

    pub(super) fn declared_words(&mut self, slot: NetSlot, frame: u32) -> Option<u32> {
        let size = self.circuit.nets[slot.0 as usize].words?;
        self.width(size, frame)
    }

    fn undriven(&mut self) {
        if self.failed {
            return;
        }
        for net in self.circuit.inputs..self.module.nets.len() {
            let ModuleNet { first, width, name, span, .. } = &self.module.nets[net];
            let bits = *first..first + width.unwrap_or(0);
            let missing: Vec<_> = bits.filter(|&bit| !self.is_driven(bit)).map(|bit| bit - first).collect();
            let span = *span;
            if let Some(bits) = undriven_bits(name, &missing, width.unwrap_or(0)) {
                self.fault(wording::undriven(&bits, span));
            }
        }
    }

    fn is_driven(&self, bit: Bit) -> bool {
        !matches!(self.module.signals[bit as usize], ModuleSignal::Net { driver: None, .. })
    }

    fn total(&mut self) {
        let sum = Sum::of(&self.module, &self.builder.modules, self.circuit.name.len());
        let over = sum.counts().into_iter().find(|(limit, count)| limit.permit(*count).is_err());
        if let Some((limit, count)) = over {
            self.fault(wording::too_large(&self.circuit.name, count, limit, self.circuit.span));
        }
        self.module.sum = sum;
    }

    pub(super) fn span(&self, expression: ExpressionId) -> Span {
        self.circuit.expressions[expression.0 as usize].span
    }
}

fn undriven_bits(name: &str, missing: &[u32], width: u32) -> Option<String> {
    let (&first, rest) = missing.split_first()?;
    let run = rest.iter().zip(first + 1..).take_while(|(bit, next)| *bit == next).count() as u32;
    Some(match (first, run) {
        (0, run) if run + 1 == width => name.to_owned(),
        (bit, 0) => format!("{name}[{bit}]"),
        (low, run) => format!("{name}[{}..{low}]", low + run),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_bits_are_written_as_a_slice() {
        assert_eq!(undriven_bits("a", &[], 4), None);
        assert_eq!(undriven_bits("a", &[0], 1).unwrap(), "a");
        assert_eq!(undriven_bits("a", &[0, 1, 2, 3], 4).unwrap(), "a");
        assert_eq!(undriven_bits("a", &[2], 4).unwrap(), "a[2]");
        assert_eq!(undriven_bits("a", &[1, 2, 5], 8).unwrap(), "a[2..1]");
    }
}
