//! Pest's pairs to the tree: parameters, ports, statements and sizes of circuits.

use pest::iterators::Pair;

use crate::model::SizeOperator;
use crate::syntax::arena::Arena;
use crate::syntax::convert::{Converter, parts};
use crate::syntax::grammar::Rule;
use crate::syntax::tree::{
    Argument, Index, ParameterSyntax, Port, SizeSyntaxId, SizeSyntaxKind, StatementKind, StatementSyntax, TargetSyntax,
};
use crate::syntax::wording::Slip;

impl Converter<'_> {
    pub(crate) fn parameters(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<ParameterSyntax> {
        parts(pair)
            .map(|parameter| {
                let mut parts = parts(parameter);
                let name = self.name(&parts.next().expect("a name"));
                ParameterSyntax { name, default: parts.next().map(|size| self.size(size, arena)) }
            })
            .collect()
    }

    pub(crate) fn ports(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<Port> {
        parts(pair).map(|port| self.port(port, arena)).collect()
    }

    fn port(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Port {
        let mut parts = parts(pair);
        let name = self.name(&parts.next().expect("a name"));
        Port { name, width: parts.next().map(|size| self.size(size, arena)) }
    }

    pub(crate) fn statements(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<StatementSyntax> {
        parts(pair).filter_map(|statement| self.statement(statement, arena)).collect()
    }

    fn statement(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Option<StatementSyntax> {
        let span = self.span(&pair);
        let kind = match pair.as_rule() {
            Rule::drive => self.drive(pair, arena),
            Rule::nets => StatementKind::Nets(self.ports(pair, arena)),
            Rule::loop_ => self.for_loop(pair, arena),
            Rule::slip_end => {
                self.slip(Slip::StatementEnd { sign: pair.as_str().to_owned() }, span);
                return None;
            }
            _ => {
                self.slip(Slip::StatementKeyword { word: pair.as_str().to_owned() }, span);
                return None;
            }
        };
        Some(StatementSyntax { kind, span })
    }

    fn for_loop(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> StatementKind {
        let mut parts = parts(pair);
        let variable = self.name(&parts.next().expect("a variable"));
        let from = self.size(parts.next().expect("a start"), arena);
        let to = self.size(parts.next().expect("an end"), arena);
        StatementKind::For { variable, from, to, statements: self.statements(parts.next().expect("a body"), arena) }
    }

    fn drive(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> StatementKind {
        let mut parts = parts(pair).peekable();
        let left = parts.next().expect("a target");
        let grouped = left.as_rule() == Rule::targets;
        let targets = match left.as_rule() {
            Rule::targets => crate::syntax::convert::parts(left).map(|target| self.target(target, arena)).collect(),
            _ => vec![self.target(left, arena)],
        };
        if let Some(slip) = parts.next_if(|part| part.as_rule() == Rule::slip_arrow) {
            self.slip(Slip::DriveSign { sign: slip.as_str().to_owned() }, self.span(&slip));
        }
        StatementKind::Drive { targets, grouped, value: self.expression(parts.next().expect("a value"), arena) }
    }

    fn target(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> TargetSyntax {
        let span = self.span(&pair);
        let mut parts = parts(pair).peekable();
        let name = self.name(&parts.next().expect("a name"));
        let index = parts.next_if(|part| part.as_rule() == Rule::index).map(|index| self.index(index, arena));
        TargetSyntax { name, index, start: parts.next().map(|size| self.size(size, arena)), span }
    }

    pub(crate) fn index(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Index {
        let span = self.span(&pair);
        let mut parts = parts(pair);
        let high = self.size(parts.next().expect("a bit"), arena);
        Index { high, low: parts.next().map(|size| self.size(size, arena)), span }
    }

    pub(crate) fn arguments(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<Argument> {
        parts(pair)
            .map(|argument| {
                let span = self.span(&argument);
                let mut parts = parts(argument).peekable();
                let name = parts.next_if(|part| part.as_rule() == Rule::name).map(|name| self.name(&name));
                Argument { name, value: self.size(parts.next().expect("a value"), arena), span }
            })
            .collect()
    }

    /// An integer expression: `**` binds tighter than `*`, `/` and `%`, and these tighter than `+` and `-`; from left
    /// to right.
    pub(crate) fn size(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> SizeSyntaxId {
        let (mut values, mut operators) = (Vec::new(), Vec::<SizeOperator>::new());
        for part in parts(pair) {
            if part.as_rule() == Rule::size_infix {
                let operator = SizeOperator::parse(part.as_str()).expect("the grammar knows the operators");
                while operators.last().is_some_and(|top| top.precedence() >= operator.precedence()) {
                    reduce(&mut values, &mut operators, arena);
                }
                operators.push(operator);
            } else {
                values.push(self.size_operand(part, arena));
            }
        }
        while !operators.is_empty() {
            reduce(&mut values, &mut operators, arena);
        }
        values.pop().expect("an operand")
    }

    pub(crate) fn size_operand(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> SizeSyntaxId {
        let span = self.span(&pair);
        let kind = match pair.as_rule() {
            Rule::digits => SizeSyntaxKind::Literal(pair.as_str().to_owned()),
            Rule::name => SizeSyntaxKind::Name(pair.as_str().to_owned()),
            Rule::log2 => SizeSyntaxKind::Log2(self.size(parts(pair).next().expect("an operand"), arena)),
            _ => SizeSyntaxKind::Group(self.size(parts(pair).next().expect("an operand"), arena)),
        };
        arena.size(kind, span)
    }
}

fn reduce(values: &mut Vec<SizeSyntaxId>, operators: &mut Vec<SizeOperator>, arena: &mut Arena) {
    let right = values.pop().expect("a right operand");
    let left = values.pop().expect("a left operand");
    let operator = operators.pop().expect("an operator");
    let span = arena.sizes[left.0 as usize].span.to(arena.sizes[right.0 as usize].span);
    values.push(arena.size(SizeSyntaxKind::Binary(operator, left, right), span));
}
