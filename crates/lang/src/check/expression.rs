//! Expressions of circuits: resolves nets and circuits, counts operands, and replaces operators by circuits of the
//! prelude.

use std::num::IntErrorKind;

use crate::check::circuit::{CircuitChecker, Header};
use crate::check::constant;
use crate::check::names::Home;
use crate::check::number::NumberPlace;
use crate::check::wording::{CircuitError, NameError, OperandError};
use crate::syntax::tree::{self, Infix};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{CircuitId, ExpressionId, ExpressionKind, Operator, SizeId};
use nbc_base::source::Span;

/// The operators that can be written as calls.
const OPERATORS: [&str; 7] = ["and", "or", "xor", "nand", "nor", "xnor", "not"];

/// The prelude's circuit for an operator.
fn circuit_of(infix: Infix) -> &'static str {
    match infix {
        Infix::Add => "add",
        Infix::Subtract => "subtract",
        Infix::Equal => "equal",
        Infix::NotEqual => "not_equal",
        Infix::Less => "less",
        Infix::Greater => "greater",
        Infix::AtMost => "at_most",
        Infix::AtLeast => "at_least",
        Infix::Bitwise(operator) => operator.word(),
    }
}

impl<'a> CircuitChecker<'a> {
    /// Resolves an expression from its leaves to its root without recursion. The root has a value for each target.
    pub(crate) fn expression(
        &mut self,
        root: tree::ExpressionSyntaxId,
        targets: &[tree::TargetSyntax],
    ) -> ExpressionId {
        let body = self.body;
        let mut done: Vec<ExpressionId> = Vec::new();
        for at in first_leaf(&body.expressions, root) as usize..=root.0 as usize {
            let expression = &body.expressions[at];
            let outputs = if at == root.0 as usize { targets.len() } else { 1 };
            if let tree::ExpressionSyntaxKind::Group(_) = expression.kind {
                continue;
            }
            let kind = match &expression.kind {
                tree::ExpressionSyntaxKind::Digits(digits) => self.digits(digits, NumberPlace { at, root, targets }),
                _ => self.kind(expression, outputs, &mut done),
            };
            let id = self.push(kind, expression.span);
            done.push(id);
        }
        done.pop().expect("an expression has a value")
    }

    /// Several targets need a call of a circuit with the same number of outputs. The circuit may be unknown.
    pub(crate) fn value_count(
        &self,
        root: tree::ExpressionSyntaxId,
        id: ExpressionId,
        targets: &[tree::TargetSyntax],
        span: Span,
    ) -> Option<Diagnostic> {
        let is_call = matches!(self.circuit.expressions[id.0 as usize].kind, ExpressionKind::Call { .. })
            || matches!(self.body.expressions[root.0 as usize].kind, tree::ExpressionSyntaxKind::Call { .. });
        if targets.len() == 1 || is_call {
            return None;
        }
        let nets = targets.iter().map(|target| target.name.text.clone()).collect();
        Some(OperandError::OneValue { nets }.at(span))
    }

    fn kind(
        &mut self,
        expression: &'a tree::ExpressionSyntax,
        outputs: usize,
        done: &mut Vec<ExpressionId>,
    ) -> ExpressionKind {
        let span = expression.span;
        match &expression.kind {
            tree::ExpressionSyntaxKind::Constant { width, base, digits } => self.constant(*width, *base, digits, span),
            tree::ExpressionSyntaxKind::Computed { width, value } => {
                ExpressionKind::Computed { width: self.size(*width), value: self.size(*value) }
            }
            tree::ExpressionSyntaxKind::Net { name, index } => self.reference(name, index.as_ref()),
            tree::ExpressionSyntaxKind::Group(_) | tree::ExpressionSyntaxKind::Digits(_) => {
                unreachable!("groups are passed over, and numbers without a width are read before")
            }
            tree::ExpressionSyntaxKind::Concatenation(parts) => ExpressionKind::Concatenation(take(done, parts.len())),
            tree::ExpressionSyntaxKind::Repetition { count, values } => {
                self.repetition(*count, take(done, values.len()), span)
            }
            tree::ExpressionSyntaxKind::Not(_) => operation(Operator::Not, take(done, 1)),
            tree::ExpressionSyntaxKind::Infix { operator, place, .. } => self.infix(*operator, *place, take(done, 2)),
            tree::ExpressionSyntaxKind::Operation { operator, operands } => {
                let operands = take(done, operands.len());
                self.operand_count(*operator, operands.len(), span);
                operation(*operator, operands)
            }
            tree::ExpressionSyntaxKind::Choice { .. } => {
                let [condition, then, otherwise] = take(done, 3)[..] else { unreachable!("three were taken") };
                ExpressionKind::Choice { condition, then, otherwise }
            }
            tree::ExpressionSyntaxKind::Call { name, arguments, operands } => {
                let operands = take(done, operands.len());
                self.call(name, arguments, operands, outputs, span)
            }
            tree::ExpressionSyntaxKind::Table { inputs, rows } => {
                let outputs = take(done, table_values(rows).count());
                let inputs = take(done, inputs.len());
                let table = self.table(rows, &outputs, span);
                self.circuit.tables.push(table);
                ExpressionKind::Table { inputs, outputs, table: self.circuit.tables.len() - 1 }
            }
        }
    }

    fn constant(&mut self, width: tree::SizeSyntaxId, base: char, digits: &str, span: Span) -> ExpressionKind {
        let width = self.size(width);
        let radix = constant::radix(base).expect("the grammar lets the three bases through only");
        let value = constant::value(digits, radix).unwrap_or_else(|error| {
            let error = match error {
                IntErrorKind::PosOverflow => CircuitError::ConstantTooLarge,
                _ => CircuitError::WrongDigits { digits: digits.to_owned(), radix },
            };
            self.diagnostics.push(error.at(span));
            0
        });
        ExpressionKind::Number { width, value }
    }

    fn reference(&mut self, name: &tree::NameSyntax, index: Option<&tree::Index>) -> ExpressionKind {
        let bits = index.map(|index| self.index(index));
        match (self.net(name), bits) {
            (None, _) => ExpressionKind::Bits(vec![false]),
            (Some(net), None) => ExpressionKind::Net(net),
            (Some(net), Some((high, low))) => ExpressionKind::Slice { net, high, low },
        }
    }

    fn repetition(&mut self, count: tree::SizeSyntaxId, values: Vec<ExpressionId>, span: Span) -> ExpressionKind {
        let count = self.size(count);
        let value = match values[..] {
            [value] => value,
            _ => self.push(ExpressionKind::Concatenation(values), span),
        };
        ExpressionKind::Repetition { count, value }
    }

    fn infix(&mut self, infix: Infix, place: Span, operands: Vec<ExpressionId>) -> ExpressionKind {
        if let Infix::Bitwise(operator) = infix {
            return operation(operator, operands);
        }
        let name = circuit_of(infix);
        let circuit = self.names.find(name, Home::Prelude).expect("the prelude declares the operators");
        let circuit = CircuitId(circuit as u32);
        self.calls.push((circuit, place));
        let arguments = vec![None; self.headers.circuits[circuit.0 as usize].parameters.len()];
        ExpressionKind::Call { circuit, arguments, operands }
    }

    fn operand_count(&mut self, operator: Operator, count: usize, span: Span) {
        let (expected, fits) = match operator {
            Operator::Not => ("one operand", count == 1),
            Operator::Xnor => ("two operands", count == 2),
            _ => ("two operands or more", count >= 2),
        };
        if !fits {
            let error = match operator {
                Operator::Xnor if count > 2 => OperandError::WideXnor { found: count },
                _ => OperandError::OperatorOperands { operator: operator.word(), found: count, expected },
            };
            self.diagnostics.push(error.at(span));
        }
    }

    fn call(
        &mut self,
        name: &tree::NameSyntax,
        arguments: &[tree::Argument],
        operands: Vec<ExpressionId>,
        outputs: usize,
        span: Span,
    ) -> ExpressionKind {
        let circuit = match self.names.resolve_beside(name, self.home, &OPERATORS) {
            Ok(circuit) => circuit,
            Err(fault) => {
                self.diagnostics.push(match Operator::parse(&name.text.to_lowercase()) {
                    Some(_) => NameError::Operator { name: name.text.clone() }.at(name.span),
                    None => fault,
                });
                return ExpressionKind::Bits(vec![false]);
            }
        };
        let headers = self.headers;
        let header = &headers.circuits[circuit];
        self.calls.push((CircuitId(circuit as u32), name.span));
        self.call_counts(name, header, [operands.len(), outputs], span);
        self.uses.extend(arguments.iter().filter_map(|argument| header.parameter(argument.name.as_ref()?)));
        let arguments = self.arguments(name, &header.parameters, arguments);
        ExpressionKind::Call { circuit: CircuitId(circuit as u32), arguments, operands }
    }

    /// Counts the operands and outputs of a call.
    fn call_counts(&mut self, name: &tree::NameSyntax, header: &Header, [operands, outputs]: [usize; 2], span: Span) {
        let (circuit, signature) = (name.text.clone(), header.signature());
        let error = if operands != header.inputs.len() {
            OperandError::CallOperands { circuit, expected: header.inputs.len(), found: operands, signature }
        } else if outputs != header.outputs.len() {
            OperandError::CallOutputs { circuit, expected: header.outputs.len(), found: outputs, signature }
        } else {
            return;
        };
        self.diagnostics.push(error.at(span));
    }

    /// Parameters given by position or by name, in the order of the circuit's parameters.
    fn arguments(
        &mut self,
        name: &tree::NameSyntax,
        parameters: &[String],
        given: &[tree::Argument],
    ) -> Vec<Option<SizeId>> {
        let mut values = vec![None; parameters.len()];
        for (place, argument) in given.iter().enumerate() {
            let value = self.size(argument.value);
            match parameter_place(name, parameters, place, argument) {
                Ok(place) => values[place] = Some(value),
                Err(fault) => self.diagnostics.push(fault),
            }
        }
        values
    }
}

/// The parameter of an argument.
pub(crate) fn parameter_place(
    circuit: &tree::NameSyntax,
    parameters: &[String],
    place: usize,
    argument: &tree::Argument,
) -> Result<usize, Diagnostic> {
    match &argument.name {
        Some(name) => parameters.iter().position(|known| *known == name.text).ok_or_else(|| {
            let meant = Suggestion::of(&name.text, parameters.iter().map(String::as_str));
            let (circuit, parameter) = (circuit.text.clone(), name.text.clone());
            NameError::UnknownParameter { circuit, name: parameter, meant }.at(name.span)
        }),
        None if place < parameters.len() => Ok(place),
        None => {
            let (circuit, parameters) = (circuit.text.clone(), parameters.len());
            Err(OperandError::TooManyParameters { circuit, parameters }.at(argument.span))
        }
    }
}

fn operation(operator: Operator, operands: Vec<ExpressionId>) -> ExpressionKind {
    ExpressionKind::Operation { operator, operands }
}

fn take(done: &mut Vec<ExpressionId>, count: usize) -> Vec<ExpressionId> {
    done.split_off(done.len() - count)
}

/// The outputs of a table that are expressions.
fn table_values(rows: &[tree::TableRowSyntax]) -> impl Iterator<Item = tree::ExpressionSyntaxId> {
    rows.iter().filter_map(|row| match row.output {
        tree::TableOutputSyntax::Value(value) => Some(value),
        tree::TableOutputSyntax::Bits(_) => None,
    })
}

/// The first expression of the contiguous range that ends with `root`.
fn first_leaf(expressions: &[tree::ExpressionSyntax], root: tree::ExpressionSyntaxId) -> u32 {
    let mut at = root;
    loop {
        use tree::ExpressionSyntaxKind as Kind;
        let first = match &expressions[at.0 as usize].kind {
            Kind::Digits(_) | Kind::Constant { .. } | Kind::Computed { .. } | Kind::Net { .. } => None,
            Kind::Group(inner) | Kind::Not(inner) => Some(*inner),
            Kind::Infix { left, .. } => Some(*left),
            Kind::Choice { condition, .. } => Some(*condition),
            Kind::Concatenation(values)
            | Kind::Repetition { values, .. }
            | Kind::Operation { operands: values, .. }
            | Kind::Call { operands: values, .. } => values.first().copied(),
            Kind::Table { inputs, rows } => inputs.first().copied().or(table_values(rows).next()),
        };
        match first {
            Some(first) => at = first,
            None => return at.0,
        }
    }
}
