//! Circuits: resolves names of nets, parameters and circuits, and counts operands. Widths are checked when the circuit
//! is built.

use std::collections::BTreeMap;

use crate::check::constant;
use crate::check::names::{Home, NameTable, duplicate};
use crate::check::uses::{NameKind, NameUse};
use crate::check::wording::{CircuitError, NameError};
use crate::syntax::tree;
use nbc_base::diag::{Code, Diagnostic, Suggestion, suggest};
use nbc_base::model::{
    Block, Circuit, CircuitId, Expression, ExpressionId, ExpressionKind, Net, NetSlot, Parameter, SizeId, Statement,
    Target,
};
use nbc_base::source::Span;

/// The interface of circuits, enough to check calls.
#[derive(Clone, Debug, Default)]
pub(crate) struct Headers {
    pub(crate) circuits: Vec<Header>,
}

/// The interface of a circuit.
#[derive(Clone, Debug)]
pub(crate) struct Header {
    pub(crate) name: String,
    pub(crate) parameters: Vec<String>,
    pub(crate) inputs: Vec<String>,
    pub(crate) outputs: Vec<String>,
    /// The places of the parameters, and of the ports in order.
    pub(crate) places: [Vec<Span>; 2],
}

impl Header {
    pub(crate) fn of(circuit: &tree::CircuitSyntax) -> Self {
        let names = |ports: &[tree::Port]| ports.iter().map(|port| port.name.text.clone()).collect();
        Self {
            name: circuit.name.text.clone(),
            parameters: circuit.parameters.iter().map(|parameter| parameter.name.text.clone()).collect(),
            inputs: names(&circuit.inputs),
            outputs: names(&circuit.outputs),
            places: [
                circuit.parameters.iter().map(|parameter| parameter.name.span).collect(),
                circuit.inputs.iter().chain(&circuit.outputs).map(|port| port.name.span).collect(),
            ],
        }
    }

    /// The parameter that an argument names.
    pub(crate) fn parameter(&self, name: &tree::NameSyntax) -> Option<NameUse> {
        let at = self.parameters.iter().position(|known| *known == name.text)?;
        Some(NameUse { place: name.span, declared: self.places[0][at], kind: NameKind::Number })
    }

    /// The port that a column names.
    pub(crate) fn port(&self, name: &tree::NameSyntax) -> Option<NameUse> {
        let at = self.inputs.iter().chain(&self.outputs).position(|known| *known == name.text)?;
        Some(NameUse { place: name.span, declared: self.places[1][at], kind: NameKind::Net })
    }

    /// The interface as declared, without widths.
    pub(crate) fn signature(&self) -> String {
        format!("{}({}) -> ({})", self.name, self.inputs.join(", "), self.outputs.join(", "))
    }
}

/// The meaning of a name in a circuit.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Binding {
    Variable(u32, Span),
    Net(NetSlot),
}

/// A circuit that is being checked.
pub(crate) struct CircuitChecker<'a> {
    pub(crate) body: &'a tree::BodySyntax,
    pub(crate) names: &'a NameTable,
    pub(crate) headers: &'a Headers,
    pub(crate) home: Home,
    pub(crate) circuit: Circuit,
    pub(crate) scopes: Vec<BTreeMap<&'a str, Binding>>,
    /// For each net, whether it is read.
    pub(crate) used: Vec<bool>,
    /// For each net, whether it is driven.
    driven: Vec<bool>,
    pub(crate) calls: Vec<(CircuitId, Span)>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) uses: Vec<NameUse>,
}

/// A checked circuit with its diagnostics and the circuits it calls.
pub(crate) struct CheckedCircuit {
    pub(crate) circuit: Circuit,
    pub(crate) calls: Vec<(CircuitId, Span)>,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) uses: Vec<NameUse>,
}

/// Checks one circuit.
pub(crate) fn circuit(
    source: &tree::CircuitSyntax,
    home: Home,
    names: &NameTable,
    headers: &Headers,
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
    };
    let mut checker = CircuitChecker {
        body: &source.body,
        names,
        headers,
        home,
        circuit,
        scopes: vec![BTreeMap::new()],
        used: Vec::new(),
        driven: Vec::new(),
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
            let width = port.width.map(|size| self.size(size));
            self.declare(&port.name, width);
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

    fn declare(&mut self, name: &'a tree::NameSyntax, width: Option<SizeId>) -> NetSlot {
        let slot = NetSlot(self.circuit.nets.len() as u32);
        self.circuit.nets.push(Net { name: name.text.clone(), span: name.span, width });
        self.used.push(name.text.starts_with('_'));
        self.driven.push(false);
        self.bind(name, Binding::Net(slot));
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
            self.diagnostics.push(duplicate("name", name, first));
        }
    }

    /// Notes the use of a name.
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

    /// Nets may be used before they are driven, so the nets of a block are declared before its statements are read.
    fn declare_nets(&mut self, statements: &'a [tree::StatementSyntax]) {
        for statement in statements {
            if let tree::StatementKind::Nets(nets) = &statement.kind {
                for port in nets {
                    // A declared net without a width is one bit wide, like a port.
                    let width = match port.width {
                        Some(size) => self.size(size),
                        None => self.one(port.name.span),
                    };
                    self.declare(&port.name, Some(width));
                }
            }
        }
        for statement in statements {
            if let tree::StatementKind::Drive { targets, .. } = &statement.kind {
                for target in targets.iter().filter(|target| target.name.text != "_") {
                    if self.lookup(&target.name.text).is_none() {
                        self.declare(&target.name, None);
                    }
                }
            }
        }
    }

    fn statement(&mut self, statement: &'a tree::StatementSyntax) -> Option<Statement> {
        match &statement.kind {
            tree::StatementKind::Nets(_) => None,
            tree::StatementKind::Drive { targets, value, .. } => self.drive(targets, *value),
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

    fn drive(&mut self, targets: &'a [tree::TargetSyntax], value: tree::ExpressionSyntaxId) -> Option<Statement> {
        let lowered: Vec<_> = targets.iter().map(|target| self.target(target)).collect();
        let span = self.body.expressions[value.0 as usize].span;
        let start_fault = self.start_fault(targets, value);
        let root = value;
        let value = self.expression(root, targets);
        if let Some(fault) = self.value_count(root, value, targets, span) {
            self.diagnostics.push(fault);
        }
        self.diagnostics.extend(start_fault);
        Some(Statement::Drive { targets: lowered.into_iter().collect::<Option<_>>()?, value })
    }

    fn target(&mut self, target: &'a tree::TargetSyntax) -> Option<Target> {
        let start = target.start.map(|size| self.size(size));
        if target.name.text == "_" {
            return Some(Target { net: None, bits: None, start, span: target.span });
        }
        let binding = self.lookup(&target.name.text).expect("the targets of a block are declared first");
        self.refer(target.name.span, binding);
        let slot = match binding {
            Binding::Net(slot) => slot,
            Binding::Variable(_, first) => {
                self.diagnostics.push(duplicate("name", &target.name, first));
                return None;
            }
        };
        let bits = target.index.map(|index| self.index(&index));
        self.driven[slot.0 as usize] = true;
        self.target_faults(target, slot).map_or(Some(()), |fault| {
            self.diagnostics.push(fault);
            None
        })?;
        Some(Target { net: Some(slot), bits, start, span: target.span })
    }

    fn target_faults(&self, target: &tree::TargetSyntax, slot: NetSlot) -> Option<Diagnostic> {
        let net = &self.circuit.nets[slot.0 as usize];
        let slot = slot.0 as usize;
        if slot < self.circuit.inputs {
            let error = CircuitError::DrivenInput { net: net.name.clone(), declared: net.span };
            return Some(error.at(target.span));
        }
        let is_port = slot < self.circuit.inputs + self.circuit.outputs;
        let open = target.index.is_some() && net.width.is_none() && !is_port;
        open.then(|| CircuitError::UnknownWidth { net: net.name.clone() }.at(target.span))
    }

    pub(crate) fn index(&mut self, index: &tree::Index) -> (SizeId, SizeId) {
        let high = self.size(index.high);
        (high, index.low.map_or(high, |low| self.size(low)))
    }

    /// Reports nets that are never driven and nets that are never read.
    fn loose_ends(&mut self) {
        // After an unknown name it is not certain which nets are read.
        let typo = self.diagnostics.iter().any(|fault| fault.code == Code::Unknown);
        for (slot, net) in self.circuit.nets.iter().enumerate() {
            let name = net.name.clone();
            if !self.driven[slot] {
                let what = if slot < self.circuit.inputs + self.circuit.outputs { "output" } else { "net" };
                self.diagnostics.push(CircuitError::Undriven { what, net: name }.at(net.span));
            } else if !self.used[slot] && !typo && !matches!(self.home, Home::Prelude | Home::Foreign) {
                let what = if slot < self.circuit.inputs { "input" } else { "net" };
                self.diagnostics.push(CircuitError::Unused { what, net: name }.at(net.span));
            }
        }
    }

    /// The net for a name in an expression.
    pub(crate) fn net(&mut self, name: &tree::NameSyntax) -> Option<NetSlot> {
        match self.lookup(&name.text) {
            Some(binding @ Binding::Net(slot)) => {
                self.used[slot.0 as usize] = true;
                self.refer(name.span, binding);
                Some(slot)
            }
            Some(Binding::Variable(..)) => {
                self.diagnostics.push(NameError::NumberForNet { name: name.text.clone() }.at(name.span));
                None
            }
            None => {
                self.diagnostics.push(self.unknown_net(name));
                None
            }
        }
    }

    fn unknown_net(&self, name: &tree::NameSyntax) -> Diagnostic {
        let circuit = self.names.find(&name.text, self.home);
        let circuit = circuit.map(|circuit| self.headers.circuits[circuit].signature());
        if let (None, Some(bit)) = (&circuit, constant::truth(&name.text)) {
            return NameError::Truth { word: name.text.clone(), bit }.at(name.span);
        }
        let meant = if circuit.is_some() || self.diagnostics.len() >= suggest::MOST {
            Suggestion::None
        } else {
            Suggestion::of(&name.text, self.nets_in_scope())
        };
        if circuit.is_none() && !matches!(meant, Suggestion::Near(_)) && constant::is_unknown(&name.text) {
            return NameError::UnknownBit { word: name.text.clone() }.at(name.span);
        }
        NameError::UnknownNet { name: name.text.clone(), circuit, meant }.at(name.span)
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
