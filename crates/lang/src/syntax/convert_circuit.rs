//! Pest's pairs to the tree: parameters, ports, statements and sizes of circuits.

use pest::iterators::Pair;

use crate::syntax::arena::Arena;
use crate::syntax::convert::{Converter, parts};
use crate::syntax::convert_expression::choice_of;
use crate::syntax::grammar::Rule;
use crate::syntax::lexer::is_word;
use crate::syntax::tree::{
    Argument, Grouping, Index, IndexKind, ParameterSyntax, Port, SizeSyntaxId, SizeSyntaxKind, StatementKind,
    StatementSyntax, TargetSyntax,
};
use crate::syntax::wording;
use nbc_base::model::{Relation, SizeOperator};
use nbc_base::source::Span;

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
        let mut ports: Vec<Port> = Vec::new();
        for part in parts(pair) {
            match part.as_rule() {
                Rule::absent => {
                    let size = self.size(parts(part).next().expect("a size"), arena);
                    ports.last_mut().expect("a port before its value").absent = Some(size);
                }
                Rule::contents => {
                    let name = self.name(&parts(part).next().expect("a name"));
                    ports.last_mut().expect("a net before its contents").contents = Some(name);
                }
                _ => ports.push(self.port(part, arena)),
            }
        }
        ports
    }

    pub(crate) fn outputs(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<Port> {
        match parts(pair.clone()).next().filter(|first| first.as_rule() == Rule::slip_outputs) {
            Some(bare) => {
                let span = self.span(&bare);
                self.errors.push(wording::bare_outputs(self.text(span), span));
                self.ports(bare, arena)
            }
            None => self.ports(pair, arena),
        }
    }

    fn port(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Port {
        let mut parts = parts(pair).peekable();
        while let Some(kind) = parts.next_if(|part| part.as_rule() == Rule::slip_kind) {
            let next = self.span(parts.peek().expect("a name after the kind"));
            let span = self.span(&kind);
            let before = Span { end: next.start, ..span };
            self.errors.push(wording::kind_of_port(kind.as_str(), before, span));
        }
        let range = parts.next_if(|part| part.as_rule() == Rule::slip_range);
        let name = self.name(&parts.next().expect("a name"));
        if let Some(range) = range {
            let (span, (width, text)) = (self.span(&range), self.width_of_range(range, arena));
            let at = Span { end: span.start + 1, ..span };
            self.errors.push(wording::width_before_name(&name.text, &text, span.to(name.span), at));
            return Port::new(name, Some(width));
        }
        let kind = |part: &Pair<Rule>| part.as_rule() == Rule::kind;
        let mut sizes = Vec::new();
        while let Some(size) = parts.next_if(|part| !kind(part)) {
            sizes.push(match size.as_rule() {
                Rule::slip_range => {
                    let (span, (width, text)) = (self.span(&size), self.width_of_range(size, arena));
                    self.errors.push(wording::range_of_port(&name.text, &text, span));
                    width
                }
                _ => self.size(size, arena),
            });
        }
        let members = parts.next().map(|kind| self.name(&crate::syntax::convert::parts(kind).next().expect("a name")));
        let width = sizes.pop();
        Port { words: sizes.pop(), members, ..Port::new(name, width) }
    }

    fn width_of_range(&mut self, range: Pair<Rule>, arena: &mut Arena) -> (SizeSyntaxId, String) {
        let span = self.span(&range);
        let mut ends = parts(range).map(|end| (end.as_str().trim().to_owned(), end));
        let (high_text, high) = ends.next().expect("a width");
        let Some((low_text, low)) = ends.next() else { return (self.size(high, arena), high_text) };
        let [high_bit, low_bit] = [&high_text, &low_text].map(|end| end.parse::<u32>().ok());
        if let (Some(high), Some(low)) = (high_bit, low_bit) {
            let bits = (u64::from(high.abs_diff(low)) + 1).to_string();
            return (arena.size(SizeSyntaxKind::Literal(bits.clone()), span), bits);
        }
        let text = match high_text.strip_suffix('1').and_then(|sum| sum.trim_end().strip_suffix('-')) {
            Some(width) if low_bit == Some(0) => width.trim_end().to_owned(),
            _ => format!("{high_text} - ({low_text}) + 1"),
        };
        let (high, low) = (self.size(high, arena), self.size(low, arena));
        let bits = arena.size(SizeSyntaxKind::Binary(SizeOperator::Subtract, high, low), span);
        let one = arena.size(SizeSyntaxKind::Literal("1".to_owned()), span);
        (arena.size(SizeSyntaxKind::Binary(SizeOperator::Add, bits, one), span), text)
    }

    pub(crate) fn statements(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<StatementSyntax> {
        parts(pair).flat_map(|statement| self.statement(statement, arena)).collect()
    }

    fn statement(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<StatementSyntax> {
        let span = self.span(&pair);
        let kind = match pair.as_rule() {
            Rule::drive => self.drive(pair, arena),
            Rule::nets => StatementKind::Nets(self.ports(pair, arena)),
            Rule::slip_nets => self.slip_nets(pair, arena),
            Rule::loop_ => self.for_loop(pair, arena),
            Rule::integer => {
                let mut parts = parts(pair);
                let name = self.name(&parts.next().expect("a name"));
                StatementKind::Let { name, value: self.size(parts.next().expect("an integer"), arena) }
            }
            Rule::conditional => self.conditional(pair, arena),
            Rule::slip_if => return self.if_block(pair, arena),
            Rule::slip_end => {
                self.errors.push(wording::statement_end(pair.as_str(), span));
                return Vec::new();
            }
            _ => {
                let word = parts(pair.clone()).next().expect("a word").as_str();
                let end = pair.as_span().end();
                let blank = self.source[end..].len() - self.source[end..].trim_start().len();
                let whole = Span { end: (self.offset + end + blank) as u32, ..span };
                let span = Span { end: span.start + word.len() as u32, ..span };
                self.errors.push(wording::statement_keyword(word, whole, span));
                return Vec::new();
            }
        };
        vec![StatementSyntax { kind, span }]
    }

    fn slip_nets(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> StatementKind {
        let span = self.span(&pair);
        let mut parts = parts(pair).peekable();
        let word = parts.next().expect("a keyword");
        let range = parts.next_if(|part| part.as_rule() == Rule::slip_range);
        let range = range.map(|range| self.width_of_range(range, arena));
        let mut texts = Vec::new();
        let mut nets = Vec::new();
        for port in parts {
            let text = self.text(self.span(&port)).to_owned();
            let mut port = self.port(port, arena);
            match (&range, port.width) {
                (Some((width, bits)), None) => {
                    port.width = Some(*width);
                    texts.push(format!("{}[{bits}]", port.name.text));
                }
                _ => texts.push(text),
            }
            nets.push(port);
        }
        self.errors.push(wording::net_keyword(word.as_str(), &texts.join(", "), span, self.span(&word)));
        StatementKind::Nets(nets)
    }

    fn for_loop(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> StatementKind {
        let mut parts = parts(pair).peekable();
        let variable = self.name(&parts.next().expect("a variable"));
        let from = self.size(parts.next().expect("a start"), arena);
        if let Some(colon) = parts.next_if(|part| part.as_rule() == Rule::slip_colon) {
            self.errors.push(wording::colon_in_loop(self.span(&colon)));
        }
        let to = self.size(parts.next().expect("an end"), arena);
        StatementKind::For { variable, from, to, statements: self.statements(parts.next().expect("a body"), arena) }
    }

    fn conditional(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> StatementKind {
        let mut branches = parts(pair).filter(|part| part.as_rule() != Rule::else_word);
        let mut compared = parts(branches.next().expect("a condition"));
        let left = self.size(compared.next().expect("an integer"), arena);
        let sign = compared.next().expect("a comparison");
        let comparison = Relation::parse(sign.as_str()).expect("the grammar knows the comparisons");
        let right = self.size(compared.next().expect("an integer"), arena);
        let body = branches.next().expect("a body");
        let first = self.span(&body);
        let then = self.statements(body, arena);
        let (otherwise, second) = match branches.next() {
            None => (Vec::new(), Span { start: first.end, ..first }),
            Some(branch) => {
                let span = self.span(&branch);
                match branch.as_rule() {
                    Rule::body => (self.statements(branch, arena), span),
                    _ => (vec![StatementSyntax { kind: self.conditional(branch, arena), span }], span),
                }
            }
        };
        StatementKind::If { left, comparison, right, then, otherwise, blocks: [first, second] }
    }

    /// `if` with statements in braces. If all branches drive the same nets, it is a choice for each net.
    fn if_block(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<StatementSyntax> {
        let span = self.span(&pair);
        let is_word = |part: &Pair<Rule>| part.as_rule() == Rule::else_word;
        let (bodies, conditions): (Vec<_>, Vec<_>) =
            parts(pair).filter(|part| !is_word(part)).partition(|part| part.as_rule() == Rule::body);
        let drives: Option<Vec<Vec<_>>> = bodies.into_iter().map(|body| self.drives_of(body)).collect();
        let drives = drives.filter(|drives| {
            let nets = |drives: &[(Pair<Rule>, Pair<Rule>)]| {
                drives.iter().map(|(target, _)| target.as_str().trim().to_owned()).collect::<Vec<_>>()
            };
            drives.len() == conditions.len() + 1 && drives.iter().all(|branch| nets(branch) == nets(&drives[0]))
        });
        let if_span = Span { end: span.start + 2, ..span };
        let Some(drives) = drives else {
            self.errors.push(wording::if_block(&[], span, if_span));
            self.lost.push(span);
            return Vec::new();
        };
        let (mut statements, mut choices) = (Vec::new(), Vec::new());
        for (at, (target, _)) in drives[0].iter().enumerate() {
            let target_text = self.text(self.span(target)).to_owned();
            let mut text = format!("{target_text} =");
            let mut values = Vec::new();
            for (condition, branch) in conditions.iter().zip(&drives) {
                let [condition_text, then] = [condition, &branch[at].1].map(|part| self.text(self.span(part)));
                text += &format!(" if {condition_text} then {then} else");
                values.push(self.expression(condition.clone(), arena));
                values.push(self.expression(branch[at].1.clone(), arena));
            }
            let last = drives.last().expect("a branch")[at].1.clone();
            text += &format!(" {}", self.text(self.span(&last)));
            values.push(self.expression(last, arena));
            let kind = choice_of(values, arena);
            let value = arena.expression(kind, span);
            choices.push(text);
            let targets = vec![self.target(target.clone(), arena)];
            statements.push(StatementSyntax {
                kind: StatementKind::Drive { targets, grouping: Grouping::Single, value },
                span,
            });
        }
        self.errors.push(wording::if_block(&choices, span, if_span));
        statements
    }

    fn drives_of<'p>(&self, body: Pair<'p, Rule>) -> Option<Vec<(Pair<'p, Rule>, Pair<'p, Rule>)>> {
        let drive = |statement: Pair<'p, Rule>| {
            let is_drive = statement.as_rule() == Rule::drive;
            let mut parts = parts(statement);
            let target = parts.next().filter(|target| is_drive && target.as_rule() == Rule::target)?;
            Some((target, parts.next().filter(|value| value.as_rule() == Rule::expression)?))
        };
        parts(body).map(drive).collect()
    }

    fn drive(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> StatementKind {
        let mut parts = parts(pair).peekable();
        let left = parts.next().expect("a target");
        let grouping = match left.as_rule() {
            Rule::targets => Grouping::Outputs,
            Rule::joined => Grouping::Joined,
            _ => Grouping::Single,
        };
        let targets = match left.as_rule() {
            Rule::targets | Rule::joined => {
                crate::syntax::convert::parts(left).map(|target| self.target(target, arena)).collect()
            }
            _ => vec![self.target(left, arena)],
        };
        if let Some(slip) = parts.next_if(|part| part.as_rule() == Rule::slip_arrow) {
            self.errors.push(wording::drive_sign(slip.as_str(), self.span(&slip)));
        }
        StatementKind::Drive { targets, grouping, value: self.expression(parts.next().expect("a value"), arena) }
    }

    fn target(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> TargetSyntax {
        let span = self.span(&pair);
        let mut parts = parts(pair).peekable();
        let name = self.name(&parts.next().expect("a name"));
        let mut index = || parts.next_if(|part| part.as_rule() == Rule::index);
        let (first, second) = (index(), index());
        let [index, second] = [first, second].map(|index| index.map(|index| self.index(index, arena)));
        TargetSyntax { name, index, second, start: parts.next().map(|size| self.size(size, arena)), span }
    }

    pub(crate) fn index(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Index {
        let span = self.span(&pair);
        let mut parts = parts(pair).peekable();
        let high = parts.next().expect("a bit");
        if high.as_rule() == Rule::expression {
            return Index { kind: IndexKind::Value(self.expression(high, arena)), span };
        }
        let Some(colon) = parts.next_if(|part| part.as_rule() == Rule::slip_colon) else {
            let high = self.size(high, arena);
            let kind = match parts.next() {
                Some(low) => IndexKind::Slice(high, self.size(low, arena)),
                None => IndexKind::One(high),
            };
            return Index { kind, span };
        };
        // In other languages the first bit may be the lowest.
        let low = parts.next().expect("the other end");
        let bit = |end: &Pair<Rule>| end.as_str().trim().parse::<u32>().ok();
        let is_ascending = bit(&high).zip(bit(&low)).is_some_and(|(high, low)| high < low);
        let (high, low) = if is_ascending { (low, high) } else { (high, low) };
        let net = self.source[..span.start as usize - self.offset].rsplit(|c| !is_word(c)).next().unwrap_or_default();
        let slice = format!("[{}..{}]", high.as_str().trim(), low.as_str().trim());
        self.errors.push(wording::colon_in_slice(net, &slice, span, self.span(&colon)));
        let high = self.size(high, arena);
        Index { kind: IndexKind::Slice(high, self.size(low, arena)), span }
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

    /// `**` binds tighter than `*`, `/` and `%`, and these tighter than `+` and `-`; from left to right.
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
