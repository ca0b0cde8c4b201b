//! Expressions of circuits: resolves nets and circuits, counts operands, and replaces operators by circuits of the
//! prelude.

use std::num::IntErrorKind;

use crate::check::circuit::{CircuitChecker, Header};
use crate::check::constant;
use crate::check::names::Home;
use crate::check::wording;
use crate::syntax::tree::{self, Infix};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{
    CircuitId, ExpressionId, ExpressionKind, FreeNumber, NetSlot, Operator, Relation, SizeId, SizeKind, SizeOperator,
};
use nbc_base::source::Span;

pub(crate) const BEFORE: &str = "before";

const OPERATORS: [&str; 7] = ["and", "or", "xor", "nand", "nor", "xnor", "not"];

fn circuit_of(infix: Infix) -> &'static str {
    match infix {
        Infix::Add => "add",
        Infix::Subtract => "subtract",
        Infix::Multiply => "multiply",
        Infix::ShiftLeft => "shift_left",
        Infix::ShiftRight => "shift_right",
        Infix::Compare(Relation::Equal) => "equal",
        Infix::Compare(Relation::NotEqual) => "not_equal",
        Infix::Compare(Relation::Less) => "less",
        Infix::Compare(Relation::Greater) => "greater",
        Infix::Compare(Relation::AtMost) => "at_most",
        Infix::Compare(Relation::AtLeast) => "at_least",
        Infix::Bitwise(operator) => operator.word(),
    }
}

impl<'a> CircuitChecker<'a> {
    /// Resolves an expression from its leaves to its root without recursion. The root has `values` values.
    pub(crate) fn expression(&mut self, root: tree::ExpressionSyntaxId, values: usize) -> ExpressionId {
        let body = self.body;
        let mut done: Vec<ExpressionId> = Vec::new();
        for at in first_leaf(&body.expressions, root) as usize..=root.0 as usize {
            let expression = &body.expressions[at];
            let outputs = if at == root.0 as usize { values } else { 1 };
            if let tree::ExpressionSyntaxKind::Group(_) = expression.kind {
                continue;
            }
            let kind = self.kind(expression, outputs, &mut done);
            let id = self.push(kind, expression.span);
            done.push(id);
        }
        done.pop().expect("an expression has a value")
    }

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
        let nets: Vec<&str> = targets.iter().map(|target| target.name.text.as_str()).collect();
        Some(wording::one_value(&nets, span))
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
            tree::ExpressionSyntaxKind::Net { name, index, second } => {
                self.reference(name, [index.as_ref(), second.as_ref()], done)
            }
            tree::ExpressionSyntaxKind::Digits(digits) => self.digits(digits, span),
            tree::ExpressionSyntaxKind::Group(_) => unreachable!("groups are passed over"),
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
                let values = take(done, operands.len());
                self.call(name, arguments, operands, &values, outputs, span)
            }
            tree::ExpressionSyntaxKind::Table { inputs, rows, .. } => {
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
            self.diagnostics.push(match error {
                IntErrorKind::PosOverflow => wording::large_constant(span),
                _ => wording::wrong_digits(digits, radix, span),
            });
            0
        });
        ExpressionKind::Number { width, value }
    }

    fn digits(&mut self, digits: &str, span: Span) -> ExpressionKind {
        match constant::unsized_number(digits) {
            Some(value) => ExpressionKind::Unsized(FreeNumber::Literal(value)),
            None => {
                self.diagnostics.push(wording::large_constant(span));
                ExpressionKind::Bits(vec![false])
            }
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

    pub(crate) fn infix(&mut self, infix: Infix, place: Span, operands: Vec<ExpressionId>) -> ExpressionKind {
        if let Infix::Bitwise(operator) = infix {
            return operation(operator, operands);
        }
        if let Some(folded) = self.folded(infix, &operands) {
            return folded;
        }
        if let (Infix::ShiftLeft | Infix::ShiftRight, [value, by]) = (infix, &operands[..])
            && let ExpressionKind::Unsized(number) = self.circuit.expressions[by.0 as usize].kind
        {
            self.forget(*by);
            return self.shift_by(infix, place, *value, number);
        }
        let name = circuit_of(infix);
        let circuit =
            self.declared.names.circuits.find(name, Home::Prelude).expect("the prelude declares the operators");
        let circuit = CircuitId(circuit as u32);
        self.calls.push((circuit, place));
        let arguments = vec![None; self.headers.circuits[circuit.0 as usize].parameters.len()];
        ExpressionKind::Call { circuit, arguments, operands: operands.into_iter().map(Some).collect() }
    }

    fn folded(&mut self, infix: Infix, operands: &[ExpressionId]) -> Option<ExpressionKind> {
        let operator = match infix {
            Infix::Add => SizeOperator::Add,
            Infix::Subtract => SizeOperator::Subtract,
            Infix::Multiply => SizeOperator::Multiply,
            _ => return None,
        };
        let number = |id: ExpressionId| match self.circuit.expressions[id.0 as usize].kind {
            ExpressionKind::Unsized(number) => Some((number, self.circuit.expressions[id.0 as usize].span)),
            _ => None,
        };
        let (left, right) = (number(operands[0])?, number(operands[1])?);
        // The parts of an integer stand before it.
        let span = left.1.to(right.1);
        let [left, right] = [left, right].map(|number| self.size_of_number(number));
        let size = self.push_size(SizeKind::Binary(operator, left?, right?), span);
        operands.iter().for_each(|&operand| self.forget(operand));
        Some(ExpressionKind::Unsized(FreeNumber::Size(size)))
    }

    fn forget(&mut self, number: ExpressionId) {
        self.circuit.expressions[number.0 as usize].kind = ExpressionKind::Bits(vec![false]);
    }

    fn size_of_number(&mut self, (number, span): (FreeNumber, Span)) -> Option<SizeId> {
        match number {
            FreeNumber::Literal(value) => Some(self.push_size(SizeKind::Literal(i128::try_from(value).ok()?), span)),
            FreeNumber::Size(size) => Some(self.copy_of_size(size)),
        }
    }

    fn shift_by(&mut self, infix: Infix, place: Span, value: ExpressionId, number: FreeNumber) -> ExpressionKind {
        let name = if infix == Infix::ShiftLeft { "shift_left_by" } else { "shift_right_by" };
        let circuit = self.declared.names.circuits.find(name, Home::Prelude).expect("the prelude declares the shifts");
        let circuit = CircuitId(circuit as u32);
        self.calls.push((circuit, place));
        let by = self.size_of_number((number, place)).unwrap_or_else(|| self.one(place));
        ExpressionKind::Call { circuit, arguments: vec![None, Some(by)], operands: vec![Some(value)] }
    }

    fn operand_count(&mut self, operator: Operator, count: usize, span: Span) {
        let (expected, fits) = match operator {
            Operator::Not => ("one operand", count == 1),
            Operator::Xnor => ("two operands", count == 2),
            _ => ("two operands or more", count >= 2),
        };
        if !fits {
            self.diagnostics.push(match operator {
                Operator::Xnor if count > 2 => wording::wide_xnor(count, span),
                _ => wording::operator_operands(operator.word(), count, expected, span),
            });
        }
    }

    fn call(
        &mut self,
        name: &tree::NameSyntax,
        arguments: &[tree::Argument],
        operands: &[tree::OperandSyntax],
        values: &[ExpressionId],
        outputs: usize,
        span: Span,
    ) -> ExpressionKind {
        if let Some(clock) = self.steps.filter(|_| name.text == BEFORE) {
            return self.before(name, operands, values, clock);
        }
        let circuit = match self.declared.names.circuits.resolve_beside(name, self.home, &OPERATORS) {
            Ok(circuit) => circuit,
            Err(fault) => {
                self.diagnostics.push(match Operator::parse(&name.text.to_lowercase()) {
                    Some(_) => wording::upper_case_operator(name),
                    None => fault,
                });
                return ExpressionKind::Bits(vec![false]);
            }
        };
        let headers = self.headers;
        let header = &headers.circuits[circuit];
        self.calls.push((CircuitId(circuit as u32), name.span));
        let before = self.diagnostics.len();
        let operands = self.operands(name, header, operands, values);
        if self.diagnostics.len() == before {
            self.call_counts(name, header, &operands, [values.len(), outputs], span);
        }
        self.uses.extend(arguments.iter().filter_map(|argument| header.parameter(argument.name.as_ref()?)));
        let arguments = self.arguments(name, &header.parameters, arguments);
        ExpressionKind::Call { circuit: CircuitId(circuit as u32), arguments, operands }
    }

    fn before(
        &mut self,
        name: &tree::NameSyntax,
        operands: &[tree::OperandSyntax],
        values: &[ExpressionId],
        clock: NetSlot,
    ) -> ExpressionKind {
        let &[value] = values else {
            self.diagnostics.push(wording::operands_of_before(Some(values.len()), name.span));
            return ExpressionKind::Bits(vec![false]);
        };
        if let Some(port) = operands.iter().find_map(|operand| operand.name.as_ref()) {
            self.diagnostics.push(wording::operands_of_before(None, port.span));
        }
        let register =
            self.declared.names.circuits.find("register", Home::Prelude).expect("the prelude declares registers");
        self.calls.push((CircuitId(register as u32), name.span));
        let header = &self.headers.circuits[register];
        let arguments = vec![None; header.parameters.len()];
        let mut given = vec![None; header.inputs.len()];
        let clock = self.push(ExpressionKind::Net(clock), name.span);
        (given[0], given[1]) = (Some(value), Some(clock));
        ExpressionKind::Call { circuit: CircuitId(register as u32), arguments, operands: given }
    }

    /// In the order of the ports. An operand without a name is for the port at its own place.
    fn operands(
        &mut self,
        name: &tree::NameSyntax,
        header: &Header,
        written: &[tree::OperandSyntax],
        values: &[ExpressionId],
    ) -> Vec<Option<ExpressionId>> {
        let mut operands = vec![None; header.inputs.len().max(values.len())];
        for (at, (operand, &value)) in written.iter().zip(values).enumerate() {
            let place = match &operand.name {
                None => at,
                Some(port) => {
                    self.uses.extend(header.port(port));
                    match header.inputs.iter().position(|input| *input == port.text) {
                        Some(place) => place,
                        None => {
                            let meant = Suggestion::of(&port.text, header.inputs.iter().map(String::as_str));
                            self.diagnostics.push(wording::unknown_port(&name.text, "input", port, &meant));
                            continue;
                        }
                    }
                }
            };
            if operands[place].replace(value).is_some() {
                let span = self.circuit.expressions[value.0 as usize].span;
                let port = header.inputs.get(place).map_or("", String::as_str);
                self.diagnostics.push(wording::two_operands(&name.text, port, span));
            }
        }
        operands
    }

    fn call_counts(
        &mut self,
        name: &tree::NameSyntax,
        header: &Header,
        given: &[Option<ExpressionId>],
        [operands, outputs]: [usize; 2],
        span: Span,
    ) {
        let (circuit, signature) = (&name.text, || header.signature());
        let missing = given.iter().zip(&header.optional).any(|(given, optional)| given.is_none() && !optional);
        if missing || given.len() != header.inputs.len() {
            self.diagnostics.push(wording::call_operands(circuit, header.inputs.len(), operands, &signature(), span));
        } else if outputs != header.outputs.len() {
            self.diagnostics.push(wording::call_outputs(circuit, header.outputs.len(), outputs, &signature(), span));
        }
    }

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

pub(crate) fn parameter_place(
    circuit: &tree::NameSyntax,
    parameters: &[String],
    place: usize,
    argument: &tree::Argument,
) -> Result<usize, Diagnostic> {
    match &argument.name {
        Some(name) => parameters.iter().position(|known| *known == name.text).ok_or_else(|| {
            let meant = Suggestion::of(&name.text, parameters.iter().map(String::as_str));
            wording::unknown_parameter(&circuit.text, name, &meant)
        }),
        None if place < parameters.len() => Ok(place),
        None => Err(wording::many_parameters(&circuit.text, parameters.len(), argument.span)),
    }
}

fn operation(operator: Operator, operands: Vec<ExpressionId>) -> ExpressionKind {
    ExpressionKind::Operation { operator, operands }
}

fn take(done: &mut Vec<ExpressionId>, count: usize) -> Vec<ExpressionId> {
    done.split_off(done.len() - count)
}

fn table_values(rows: &[tree::TableRowSyntax]) -> impl Iterator<Item = tree::ExpressionSyntaxId> {
    rows.iter().filter_map(|row| match row.output {
        tree::TableOutputSyntax::Value(value) => Some(value),
        tree::TableOutputSyntax::Bits(_) => None,
    })
}

/// The first expression of the contiguous range that ends with `root`.
pub(crate) fn first_leaf(expressions: &[tree::ExpressionSyntax], root: tree::ExpressionSyntaxId) -> u32 {
    let mut at = root;
    loop {
        use tree::ExpressionSyntaxKind as Kind;
        let first = match &expressions[at.0 as usize].kind {
            Kind::Net { index, second, .. } => {
                [index, second].into_iter().flatten().find_map(|index| match index.kind {
                    tree::IndexKind::Value(value) => Some(value),
                    _ => None,
                })
            }
            Kind::Digits(_) | Kind::Constant { .. } | Kind::Computed { .. } => None,
            Kind::Group(inner) | Kind::Not(inner) => Some(*inner),
            Kind::Infix { left, .. } => Some(*left),
            Kind::Choice { condition, .. } => Some(*condition),
            Kind::Concatenation(values)
            | Kind::Repetition { values, .. }
            | Kind::Operation { operands: values, .. } => values.first().copied(),
            Kind::Call { operands, .. } => operands.first().map(|operand| operand.value),
            Kind::Table { inputs, rows, .. } => inputs.first().copied().or(table_values(rows).next()),
        };
        match first {
            Some(first) => at = first,
            None => return at.0,
        }
    }
}
