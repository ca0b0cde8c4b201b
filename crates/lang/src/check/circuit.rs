//! Circuits: resolves names of nets, parameters and circuits, and counts operands. Widths are checked when the circuit
//! is built.

use std::collections::BTreeMap;

use crate::check::constant;
use crate::check::names::Home;
use crate::check::uses::{NameKind, NameUse};
use crate::check::vocabulary::Vocabulary;
use crate::check::wording;
use crate::syntax::tree;
use nbc_base::diag::{Code, Diagnostic, Suggestion, suggest};
use nbc_base::model::{
    Block, Circuit, CircuitId, Condition, Expression, ExpressionId, ExpressionKind, FreeNumber, Net, NetSlot,
    Parameter, SizeId, SizeKind, Statement, Target,
};
use nbc_base::source::Span;

/// The kind of an environment's output that prints text, and its width: whether it prints, and the character.
const TEXT: &str = "text";
const TEXT_BITS: i128 = 9;

#[derive(Clone, Debug, Default)]
pub(crate) struct Headers {
    pub(crate) circuits: Vec<Header>,
}

#[derive(Clone, Debug)]
pub(crate) struct Header {
    pub(crate) name: String,
    pub(crate) parameters: Vec<String>,
    pub(crate) inputs: Vec<String>,
    /// For each input, whether a call may leave it out.
    pub(crate) optional: Vec<bool>,
    pub(crate) outputs: Vec<String>,
    pub(crate) places: [Vec<Span>; 2],
}

impl Header {
    pub(crate) fn of(circuit: &tree::CircuitSyntax) -> Self {
        let names = |ports: &[tree::Port]| ports.iter().map(|port| port.name.text.clone()).collect();
        Self {
            name: circuit.name.text.clone(),
            parameters: circuit.parameters.iter().map(|parameter| parameter.name.text.clone()).collect(),
            inputs: names(&circuit.inputs),
            optional: circuit.inputs.iter().map(|port| port.absent.is_some()).collect(),
            outputs: names(&circuit.outputs),
            places: [
                circuit.parameters.iter().map(|parameter| parameter.name.span).collect(),
                circuit.inputs.iter().chain(&circuit.outputs).map(|port| port.name.span).collect(),
            ],
        }
    }

    /// All that a call depends on.
    pub(crate) fn face(&self) -> (&str, [&[String]; 3], &[bool]) {
        (&self.name, [&self.parameters, &self.inputs, &self.outputs], &self.optional)
    }

    /// Of a circuit without parameters.
    pub(crate) fn read(circuit: &Circuit) -> Self {
        let (inputs, rest) = circuit.nets.split_at(circuit.inputs);
        let names = |nets: &[Net]| nets.iter().map(|net| net.name.clone()).collect();
        let ports = &circuit.nets[..circuit.inputs + circuit.outputs];
        Self {
            name: circuit.name.clone(),
            parameters: Vec::new(),
            inputs: names(inputs),
            optional: vec![false; inputs.len()],
            outputs: names(&rest[..circuit.outputs]),
            places: [Vec::new(), ports.iter().map(|net| net.span).collect()],
        }
    }

    pub(crate) fn parameter(&self, name: &tree::NameSyntax) -> Option<NameUse> {
        let at = self.parameters.iter().position(|known| *known == name.text)?;
        Some(NameUse { place: name.span, declared: self.places[0][at], kind: NameKind::Number })
    }

    pub(crate) fn port(&self, name: &tree::NameSyntax) -> Option<NameUse> {
        let at = self.inputs.iter().chain(&self.outputs).position(|known| *known == name.text)?;
        Some(NameUse { place: name.span, declared: self.places[1][at], kind: NameKind::Net })
    }

    pub(crate) fn signature(&self) -> String {
        let input = |(name, optional): (&String, &bool)| if *optional { format!("{name}?") } else { name.clone() };
        let inputs: Vec<String> = self.inputs.iter().zip(&self.optional).map(input).collect();
        format!("{}({}) -> ({})", self.name, inputs.join(", "), self.outputs.join(", "))
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Binding {
    Variable(u32, Span),
    Net(NetSlot),
}

pub(crate) struct CircuitChecker<'a> {
    pub(crate) body: &'a tree::BodySyntax,
    pub(crate) declared: Vocabulary<'a>,
    pub(crate) headers: &'a Headers,
    pub(crate) home: Home,
    pub(crate) is_environment: bool,
    pub(crate) steps: Option<NetSlot>,
    pub(crate) circuit: Circuit,
    pub(crate) scopes: Vec<BTreeMap<&'a str, Binding>>,
    pub(crate) used: Vec<bool>,
    pub(crate) driven: Vec<bool>,
    integers: BTreeMap<u32, SizeId>,
    pub(crate) reads: Vec<(NetSlot, ExpressionId)>,
    pub(crate) calls: Vec<(CircuitId, Span)>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) uses: Vec<NameUse>,
}

#[derive(Clone)]
pub(crate) struct CheckedCircuit {
    pub(crate) circuit: Circuit,
    pub(crate) calls: Vec<(CircuitId, Span)>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) uses: Vec<NameUse>,
}

impl CheckedCircuit {
    pub(crate) fn of(circuit: Circuit) -> Self {
        Self { circuit, calls: Vec::new(), diagnostics: Vec::new(), uses: Vec::new() }
    }
}

/// Checks properties of steps, in which `before` is a register clocked by the last input.
pub(crate) fn monitor(source: &tree::CircuitSyntax, declared: Vocabulary<'_>, headers: &Headers) -> CheckedCircuit {
    let clock = NetSlot(source.inputs.len() as u32 - 1);
    circuit(source, Home::Own, declared, headers, Some(clock))
}

pub(crate) fn circuit(
    source: &tree::CircuitSyntax,
    home: Home,
    declared: Vocabulary<'_>,
    headers: &Headers,
    steps: Option<NetSlot>,
) -> CheckedCircuit {
    let circuit = Circuit {
        name: source.name.text.clone(),
        span: source.name.span,
        parameters: Vec::new(),
        nets: Vec::new(),
        inputs: source.inputs.len(),
        outputs: source.outputs.len(),
        sizes: Vec::new(),
        expressions: Vec::new(),
        tables: Vec::new(),
        body: Block::default(),
        variables: 0,
        memories: Vec::new(),
        bits: Vec::new(),
    };
    let mut checker = CircuitChecker {
        body: &source.body,
        declared,
        headers,
        home,
        is_environment: source.is_environment,
        steps,
        circuit,
        scopes: vec![BTreeMap::new()],
        used: Vec::new(),
        driven: Vec::new(),
        integers: BTreeMap::new(),
        reads: Vec::new(),
        calls: Vec::new(),
        diagnostics: Vec::new(),
        uses: Vec::new(),
    };
    checker.parameters(&source.parameters);
    checker.ports(source);
    checker.circuit.body = checker.block(&source.body.statements);
    checker.loose_ends();
    let CircuitChecker { circuit, calls, diagnostics, uses, .. } = checker;
    CheckedCircuit { circuit, calls, diagnostics, uses }
}

impl<'a> CircuitChecker<'a> {
    fn parameters(&mut self, parameters: &'a [tree::ParameterSyntax]) {
        for parameter in parameters {
            let default = parameter.default.map(|size| self.size(size));
            let slot = self.variable(&parameter.name);
            assert_eq!(slot as usize, self.circuit.parameters.len());
            let (name, span) = (parameter.name.text.clone(), parameter.name.span);
            self.circuit.parameters.push(Parameter { name, span, default });
        }
    }

    fn ports(&mut self, source: &'a tree::CircuitSyntax) {
        for port in source.inputs.iter().chain(&source.outputs) {
            self.port(port, source.outputs.iter().any(|output| std::ptr::eq(output, port)));
        }
        for slot in 0..source.inputs.len() {
            self.driven[slot] = true;
        }
        for used in &mut self.used[source.inputs.len()..] {
            *used = true;
        }
    }

    fn variable(&mut self, name: &'a tree::NameSyntax) -> u32 {
        let slot = self.circuit.variables as u32;
        self.circuit.variables += 1;
        self.bind(name, Binding::Variable(slot, name.span));
        slot
    }

    fn port(&mut self, port: &'a tree::Port, is_output: bool) -> NetSlot {
        let width = port.width.map(|size| self.size(size));
        let is_text = port.members.as_ref().is_some_and(|name| name.text == TEXT) && is_output && self.is_environment;
        let named = port.members.as_ref().filter(|_| !is_text);
        let members = named.and_then(|name| self.members(name));
        let width = match members {
            None if is_text => Some(self.push_size(SizeKind::Literal(TEXT_BITS), port.name.span)),
            Some((_, bits)) => {
                if port.width.is_some() {
                    self.diagnostics.push(wording::enumeration_and_width(&port.name));
                }
                Some(self.push_size(SizeKind::Literal(bits.into()), port.name.span))
            }
            None => width,
        };
        let words = port.words.map(|size| self.size(size));
        let default = port.absent.map(|size| self.size(size));
        let slot = self.declare(&port.name, width);
        let net = &mut self.circuit.nets[slot.0 as usize];
        (net.words, net.default, net.members) = (words, default, members.map(|(place, _)| place));
        net.is_text = is_text;
        slot
    }

    fn members(&mut self, name: &tree::NameSyntax) -> Option<(usize, u32)> {
        match self.declared.names.enumerations.resolve(name, self.home) {
            Ok(place) => Some((place, self.declared.all.get(place)?.width)),
            Err(fault) => {
                self.diagnostics.push(fault);
                None
            }
        }
    }

    pub(crate) fn declare(&mut self, name: &'a tree::NameSyntax, width: Option<SizeId>) -> NetSlot {
        let slot = self.add_net(name.text.clone(), name.span, width);
        self.bind(name, Binding::Net(slot));
        slot
    }

    pub(crate) fn add_net(&mut self, name: String, span: Span, width: Option<SizeId>) -> NetSlot {
        let slot = NetSlot(self.circuit.nets.len() as u32);
        let is_quiet = name.starts_with('_');
        let (words, default, members, selects) = (None, None, None, None);
        self.circuit.nets.push(Net { name, span, width, words, default, members, selects, is_text: false });
        self.used.push(is_quiet);
        self.driven.push(false);
        slot
    }

    fn bind(&mut self, name: &'a tree::NameSyntax, binding: Binding) {
        self.refer(name.span, binding);
        let scope = self.scopes.last_mut().expect("a circuit has a scope");
        if let Some(first) = scope.insert(&name.text, binding) {
            // A second message for the other one of the two nets would be redundant.
            for net in [first, binding] {
                if let Binding::Net(slot) = net {
                    self.used[slot.0 as usize] = true;
                    self.driven[slot.0 as usize] = true;
                }
            }
            let first = match first {
                Binding::Variable(_, span) => span,
                Binding::Net(slot) => self.circuit.nets[slot.0 as usize].span,
            };
            self.diagnostics.push(wording::duplicate("name", name, first));
        }
    }

    pub(crate) fn refer(&mut self, place: Span, binding: Binding) {
        let (declared, kind) = match binding {
            Binding::Variable(_, declared) => (declared, NameKind::Number),
            Binding::Net(slot) => (self.circuit.nets[slot.0 as usize].span, NameKind::Net),
        };
        self.uses.push(NameUse { place, declared, kind });
    }

    pub(crate) fn lookup(&self, name: &str) -> Option<Binding> {
        self.scopes.iter().rev().find_map(|scope| scope.get(name)).copied()
    }

    fn block(&mut self, statements: &'a [tree::StatementSyntax]) -> Block {
        let first = if self.scopes.len() == 1 { 0 } else { self.circuit.nets.len() as u32 };
        self.declare_nets(statements);
        let last = self.circuit.nets.len() as u32;
        let statements = statements.iter().filter_map(|statement| self.statement(statement)).collect();
        Block { nets: first..last, statements }
    }

    /// Nets may be used before they are driven, so a block's nets are declared before its statements are read.
    fn declare_nets(&mut self, statements: &'a [tree::StatementSyntax]) {
        for statement in statements {
            match &statement.kind {
                tree::StatementKind::Nets(nets) => nets.iter().for_each(|port| self.declared_net(port)),
                // A name for an integer has its meaning in the lines after it.
                tree::StatementKind::Let { name, value } => {
                    let value = self.size(*value);
                    let variable = self.variable(name);
                    self.integers.insert(variable, value);
                }
                _ => {}
            }
        }
        for statement in statements {
            let tree::StatementKind::Drive { targets, grouping, .. } = &statement.kind else { continue };
            for target in targets.iter().filter(|target| target.name.text != "_") {
                if self.lookup(&target.name.text).is_none() {
                    // The parts of a value have a width of their own, as declared nets.
                    let width = (*grouping == tree::Grouping::Joined).then(|| self.one(target.name.span));
                    self.declare(&target.name, width);
                }
            }
        }
    }

    fn declared_net(&mut self, port: &'a tree::Port) {
        let slot = self.port(port, false);
        if self.circuit.nets[slot.0 as usize].width.is_none() {
            // A declared net without a width is one bit wide, like a port.
            let width = self.one(port.name.span);
            self.circuit.nets[slot.0 as usize].width = Some(width);
        }
        if self.is_environment && port.words.is_some() {
            self.memory(slot, port);
        } else if let Some(contents) = &port.contents {
            self.diagnostics.push(wording::contents_of_net(&port.name.text, contents.span));
        }
    }

    fn statement(&mut self, statement: &'a tree::StatementSyntax) -> Option<Statement> {
        match &statement.kind {
            tree::StatementKind::Nets(_) => None,
            tree::StatementKind::Drive { targets, grouping, value } => self.drive(targets, *grouping, *value),
            tree::StatementKind::Let { name, .. } => {
                let Some(Binding::Variable(variable, _)) = self.lookup(&name.text) else { return None };
                Some(Statement::Let { variable, value: self.integers.remove(&variable)? })
            }
            tree::StatementKind::If { left, comparison, right, then, otherwise, .. } => {
                let (left, right) = (self.size(*left), self.size(*right));
                let [then, otherwise] = [then, otherwise].map(|statements| self.inner_block(statements));
                let condition = Condition { left, comparison: *comparison, right };
                Some(Statement::If { condition, then, otherwise })
            }
            tree::StatementKind::For { variable, from, to, statements } => {
                let span = self.body.sizes[from.0 as usize].span.to(self.body.sizes[to.0 as usize].span);
                let (from, to) = (self.size(*from), self.size(*to));
                self.scopes.push(BTreeMap::new());
                let variable = self.variable(variable);
                let body = self.block(statements);
                self.scopes.pop();
                Some(Statement::For { variable, from, to, span, body })
            }
        }
    }

    fn inner_block(&mut self, statements: &'a [tree::StatementSyntax]) -> Block {
        self.scopes.push(BTreeMap::new());
        let block = self.block(statements);
        self.scopes.pop();
        block
    }

    fn drive(
        &mut self,
        targets: &'a [tree::TargetSyntax],
        grouping: tree::Grouping,
        value: tree::ExpressionSyntaxId,
    ) -> Option<Statement> {
        if let [target] = targets
            && let Some(written) = self.written_word(target)
        {
            return self.write_word(written, value);
        }
        let first = self.circuit.nets.len() as u32;
        let statement = self.plain_drive(targets, grouping, value);
        self.with_reads(first, statement)
    }

    fn plain_drive(
        &mut self,
        targets: &'a [tree::TargetSyntax],
        grouping: tree::Grouping,
        value: tree::ExpressionSyntaxId,
    ) -> Option<Statement> {
        let joined = grouping == tree::Grouping::Joined;
        let lowered: Vec<_> = targets.iter().map(|target| self.target(target)).collect();
        let span = self.body.expressions[value.0 as usize].span;
        let start_fault = self.start_fault(targets, value);
        let root = value;
        let value = self.expression(root, if joined { 1 } else { targets.len() });
        let fault = (!joined).then(|| self.value_count(root, value, targets, span));
        self.diagnostics.extend(fault.flatten());
        self.diagnostics.extend(start_fault);
        Some(Statement::Drive { targets: lowered.into_iter().collect::<Option<_>>()?, joined, value })
    }

    fn target(&mut self, target: &'a tree::TargetSyntax) -> Option<Target> {
        let start = target.start.map(|size| self.size(size));
        if target.name.text == "_" {
            return Some(Target { net: None, word: None, bits: None, start, span: target.span });
        }
        let binding = self.lookup(&target.name.text).expect("the targets of a block are declared first");
        self.refer(target.name.span, binding);
        let slot = match binding {
            Binding::Net(slot) => slot,
            Binding::Variable(_, first) => {
                self.diagnostics.push(wording::duplicate("name", &target.name, first));
                return None;
            }
        };
        let (word, bits) = self.constant_bits(slot, [target.index.as_ref(), target.second.as_ref()])?;
        self.driven[slot.0 as usize] = true;
        self.target_faults(target, slot).map_or(Some(()), |fault| {
            self.diagnostics.push(fault);
            None
        })?;
        Some(Target { net: Some(slot), word, bits, start, span: target.span })
    }

    fn target_faults(&self, target: &tree::TargetSyntax, slot: NetSlot) -> Option<Diagnostic> {
        let net = &self.circuit.nets[slot.0 as usize];
        let slot = slot.0 as usize;
        if slot < self.circuit.inputs {
            return Some(wording::driven_input(&net.name, net.span, target.span));
        }
        let is_port = slot < self.circuit.inputs + self.circuit.outputs;
        let open = target.index.is_some() && net.width.is_none() && !is_port;
        open.then(|| wording::unknown_width(&net.name, target.span))
    }

    fn loose_ends(&mut self) {
        // After an unknown name it is not certain which nets are read.
        let typo = self.diagnostics.iter().any(|fault| fault.code == Code::Unknown);
        for (slot, net) in self.circuit.nets.iter().enumerate() {
            if !self.driven[slot] {
                let what = if slot < self.circuit.inputs + self.circuit.outputs { "output" } else { "net" };
                self.diagnostics.push(wording::undriven(what, &net.name, net.span));
            } else if !self.used[slot] && !typo && self.home != Home::Prelude {
                let what = if slot < self.circuit.inputs { "input" } else { "net" };
                self.diagnostics.push(wording::unused(what, &net.name, net.span));
            }
        }
    }

    pub(crate) fn net(&mut self, name: &tree::NameSyntax) -> Option<NetSlot> {
        match self.lookup(&name.text) {
            Some(binding @ Binding::Net(slot)) => {
                self.used[slot.0 as usize] = true;
                self.refer(name.span, binding);
                Some(slot)
            }
            Some(Binding::Variable(..)) => {
                self.diagnostics.push(wording::number_for_net(name));
                None
            }
            None => {
                self.diagnostics.push(self.unknown_net(name));
                None
            }
        }
    }

    pub(crate) fn named_constant(&mut self, name: &tree::NameSyntax) -> Option<ExpressionKind> {
        let declared = self.declared;
        match self.lookup(&name.text) {
            Some(binding @ Binding::Variable(slot, _)) => {
                self.refer(name.span, binding);
                let size = self.push_size(SizeKind::Variable(slot), name.span);
                Some(ExpressionKind::Unsized(FreeNumber::Size(size)))
            }
            Some(Binding::Net(_)) => None,
            None => {
                if let Some((place, member)) = declared.member(&name.text, self.home) {
                    declared.names.members.refer_to(&name.text, name.span, self.home);
                    return Some(ExpressionKind::Bits(declared.all[place].bits(member.value)));
                }
                let value = declared.names.integers.find(&name.text, self.home)?;
                declared.names.integers.refer_to(&name.text, name.span, self.home);
                let size = self.push_size(SizeKind::Literal(value), name.span);
                Some(ExpressionKind::Unsized(FreeNumber::Size(size)))
            }
        }
    }

    fn unknown_net(&self, name: &tree::NameSyntax) -> Diagnostic {
        if let Some(circuit) = self.declared.names.circuits.find(&name.text, self.home) {
            return wording::circuit_for_net(name, &self.headers.circuits[circuit].signature());
        }
        if let Some(bit) = constant::truth(&name.text) {
            return wording::truth(name, bit);
        }
        let meant = if self.diagnostics.len() >= suggest::MOST {
            Suggestion::None
        } else {
            Suggestion::of(&name.text, self.nets_in_scope().chain(self.declared.names.members.all()))
        };
        if !matches!(meant, Suggestion::Near(_)) && constant::is_unknown(&name.text) {
            return wording::unknown_bit(name);
        }
        wording::unknown("net", name, &meant)
    }

    fn nets_in_scope(&self) -> impl Iterator<Item = &'a str> {
        let nets = |(name, binding): (&&'a str, &Binding)| matches!(binding, Binding::Net(_)).then_some(*name);
        self.scopes.iter().rev().flat_map(move |scope| scope.iter().filter_map(nets)).collect::<Vec<_>>().into_iter()
    }

    pub(crate) fn push(&mut self, kind: ExpressionKind, span: Span) -> ExpressionId {
        self.circuit.expressions.push(Expression { kind, span });
        ExpressionId(self.circuit.expressions.len() as u32 - 1)
    }
}
