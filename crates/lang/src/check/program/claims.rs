//! The claims of a program: properties of all steps of a circuit, as a circuit that watches its ports.

use crate::check::against::{self, PortLists};
use crate::check::circuit::monitor;
use crate::check::constant;
use crate::check::expression::{BEFORE, first_leaf};
use crate::check::program::Assembly;
use crate::check::uses::{NameKind, NameUse};
use crate::check::vocabulary::Vocabulary;
use crate::check::wording;
use crate::syntax::tree::{self, ExpressionSyntaxId, ExpressionSyntaxKind, NameSyntax, PropertySyntax};
use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic};
use nbc_base::model::{Claim, Column, InnerNet, Instance, Program, Property, PropertyKind};
use nbc_base::source::Span;
use nbc_circuit::Inspector;

/// No source can use this name.
const CLOCK: &str = "the clock of the steps";

impl<'a> Assembly<'a> {
    pub(super) fn claim(
        &mut self,
        span: Span,
        source: &'a tree::Prove,
        program: &Program,
        inspector: &mut Inspector<'_>,
    ) -> Option<Claim> {
        let circuit = self.instance(&source.circuit, program)?;
        let (inputs, outputs) = self.ports(&circuit, source.circuit.name.span, inspector)?;
        let (before, first_use) = (self.faults.len(), self.inner.len());
        let environment = match &source.environment {
            Some(name) => Some(self.environment(name, &circuit, (&inputs, &outputs), program, inspector)?.0),
            None => None,
        };
        let is_broken = self.declarations.is_broken(source.circuit.name.span);
        if !is_broken && source.properties.iter().all(|property| property.kind == PropertyKind::Assume) {
            self.faults.push(wording::nothing_to_prove(&circuit.circuit, source.circuit.name.span));
        }
        let properties = source.properties.iter().map(|property| self.property(property, source)).collect();
        let inner = self.inner_nets(source, &circuit, (&inputs, &outputs), inspector);
        let monitor = self.monitor(source, (&inputs, &outputs), &inner, program)?;
        if self.faults[before..].iter().any(Diagnostic::is_error) || is_broken {
            return None;
        }
        let read = &self.inner[first_use..];
        self.faults
            .retain(|fault| fault.code != Code::Unused || !read.iter().any(|net| fault.labels[0].span == net.declared));
        let title = source.title.as_ref().map_or(String::new(), |title| title.text.clone());
        let (file, line) = self.declarations.line(span);
        let monitor = Box::new(monitor);
        Some(Claim { circuit, title, span, file, line, inputs, outputs, inner, environment, properties, monitor })
    }

    fn property(&mut self, source: &PropertySyntax, claim: &tree::Prove) -> Property {
        let text = |span: Span| self.declarations.sources.text(span).split_whitespace().collect::<Vec<_>>().join(" ");
        let span = |id: ExpressionSyntaxId| claim.body.expressions[id.0 as usize].span;
        let mut faults = Vec::new();
        if let (PropertyKind::Never, Some(condition)) = (source.kind, source.condition) {
            let (condition, value) = (text(span(condition)), text(span(source.value)));
            faults.push(wording::never_implies(&condition, &value, source.span, source.word));
        }
        let within = source.within.as_ref().map(|number| {
            if source.kind != PropertyKind::Always {
                faults.push(wording::unexpected_within(source.kind, number.span));
            }
            let steps = constant::integer::<u64>(&number.text);
            let steps = steps.filter(|&steps| steps > 0 && Limit::PropertySteps.permit(steps).is_ok());
            steps.unwrap_or_else(|| {
                faults.push(wording::steps_within(&number.text, Limit::PropertySteps.most(), number.span));
                1
            }) as usize
        });
        let depth = |id| depth(&claim.body.expressions, id);
        let property = Property {
            kind: source.kind,
            text: text(source.span),
            span: source.span,
            line: self.declarations.line(source.span).1,
            has_condition: source.condition.is_some(),
            within,
            before: source.condition.map_or(0, depth).max(depth(source.value)),
        };
        self.faults.extend(faults);
        property
    }

    fn inner_nets(
        &mut self,
        source: &tree::Prove,
        circuit: &Instance,
        (inputs, outputs): PortLists<'_>,
        inspector: &mut Inspector<'_>,
    ) -> Vec<InnerNet> {
        let mut found: Vec<InnerNet> = Vec::new();
        let Some(place) = self.circuits.place(&circuit.circuit) else { return found };
        for expression in &source.body.expressions {
            let ExpressionSyntaxKind::Net { name, .. } = &expression.kind else { continue };
            if inputs.iter().chain(outputs).any(|port| port.name == name.text) {
                continue;
            }
            let known = found.iter().find(|net| net.column.name == name.text).map(|net| net.declared);
            let declared = known.or_else(|| {
                let net = inspector.net(place, &circuit.arguments, source.circuit.name.span, &name.text);
                let (column, declared) = net?;
                found.push(InnerNet { column, declared });
                Some(declared)
            });
            let kind = NameKind::Net;
            self.inner.extend(declared.map(|declared| NameUse { place: name.span, declared, kind }));
        }
        found
    }

    /// Each expression of the properties drives an output of its own.
    fn monitor(
        &mut self,
        source: &'a tree::Prove,
        (inputs, outputs): PortLists<'_>,
        inner: &[InnerNet],
        program: &Program,
    ) -> Option<nbc_base::model::Circuit> {
        let mut body = source.body.clone();
        let place = source.circuit.name.span;
        let name = |text: String, span: Span| NameSyntax { text, span };
        let port = |column: &Column, body: &mut tree::BodySyntax| against::port(column, place, body);
        let seen = inputs.iter().chain(outputs).chain(inner.iter().map(|net| &net.column));
        let seen = seen.chain([&Column::new(CLOCK, 1)]).map(|column| port(column, &mut body)).collect();
        let mut said = Vec::new();
        for (at, property) in source.properties.iter().enumerate() {
            let condition = property.condition.map(|value| (format!("condition {}", at + 1), value));
            let value = (format!("property {}", at + 1), property.value);
            for (text, value) in condition.into_iter().chain([value]) {
                said.push(port(&Column::new(text.as_str(), 1), &mut body));
                let span = source.body.expressions[value.0 as usize].span;
                let target =
                    tree::TargetSyntax { name: name(text, span), index: None, second: None, start: None, span };
                let kind =
                    tree::StatementKind::Drive { targets: vec![target], grouping: tree::Grouping::Single, value };
                body.statements.push(tree::StatementSyntax { kind, span });
            }
        }
        let name = name(format!("{} as claimed", source.circuit.name.text), place);
        let parameters = Vec::new();
        let circuit =
            tree::CircuitSyntax { is_environment: false, name, parameters, inputs: seen, outputs: said, body };
        let checked = monitor(&circuit, Vocabulary::of(&self.names, program), &self.circuits.headers);
        self.beside_ports(checked, &source.circuit.name, &source.circuit.name.text)
    }
}

fn depth(expressions: &[tree::ExpressionSyntax], root: ExpressionSyntaxId) -> usize {
    let first = first_leaf(expressions, root) as usize;
    let is_before =
        |kind: &ExpressionSyntaxKind| matches!(kind, ExpressionSyntaxKind::Call { name, .. } if name.text == BEFORE);
    let calls = (first..=root.0 as usize).filter(|&at| is_before(&expressions[at].kind));
    let ranges: Vec<_> = calls.map(|at| first_leaf(expressions, ExpressionSyntaxId(at as u32)) as usize..=at).collect();
    ranges.iter().map(|inner| ranges.iter().filter(|outer| outer.contains(inner.end())).count()).max().unwrap_or(0)
}
