//! Pest's pairs to the tree: expressions, arranged by precedence with a stack of operators.

use pest::iterators::Pair;

use crate::syntax::arena::Arena;
use crate::syntax::convert::{Converter, parts};
use crate::syntax::grammar::Rule;
use crate::syntax::tree::{
    ExpressionSyntaxId, ExpressionSyntaxKind, Index, IndexKind, Infix, OperandSyntax, SizeSyntaxId, SizeSyntaxKind,
    TableOutputSyntax, TableRowSyntax,
};
use crate::syntax::wording;
use nbc_base::model::Operator;
use nbc_base::source::Span;

#[derive(Default)]
struct Stacks {
    values: Vec<ExpressionSyntaxId>,
    waiting: Vec<Waiting>,
}

#[derive(Clone, Copy)]
enum Waiting {
    Not(Span),
    Infix(Infix, Span),
}

impl Waiting {
    fn precedence(self) -> u8 {
        match self {
            Self::Not(_) => u8::MAX,
            Self::Infix(infix, _) => infix.precedence(),
        }
    }
}

impl Converter<'_> {
    pub(crate) fn expression(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxId {
        let mut stacks = Stacks::default();
        let mut parts = parts(pair).peekable();
        let mut choice = None;
        while let Some(part) = parts.next() {
            let span = self.span(&part);
            match part.as_rule() {
                Rule::slip_choice => choice = Some(part),
                Rule::prefix => {
                    self.slip_prefix(&part, span, &stacks);
                    stacks.waiting.push(Waiting::Not(span));
                }
                Rule::operator | Rule::sum | Rule::product_sign | Rule::shift | Rule::comparison | Rule::slip_infix => {
                    let infix = self.infix(&part);
                    let next = parts.peek().map_or("…", |next| next.as_str());
                    self.push_infix((infix, span), next, &mut stacks, arena);
                }
                _ => {
                    let value = self.operand(part, arena);
                    stacks.values.push(value);
                }
            }
        }
        while !stacks.waiting.is_empty() {
            stacks.reduce(arena);
        }
        let value = stacks.values.pop().expect("an expression has an operand");
        choice.map_or(value, |choice| self.question_mark(value, choice, arena))
    }

    fn question_mark(
        &mut self,
        condition: ExpressionSyntaxId,
        pair: Pair<Rule>,
        arena: &mut Arena,
    ) -> ExpressionSyntaxId {
        let (sign, first) = (self.span(&pair), arena.span(condition));
        let values: Vec<_> = parts(pair).collect();
        let whole = first.to(sign);
        let mut texts = values.iter().map(|value| self.text(self.span(value)));
        let texts = [self.text(first), texts.next().unwrap_or_default(), texts.next().unwrap_or_default()];
        let error = wording::question_mark(texts, whole, Span { end: sign.start + 1, ..sign });
        self.errors.push(error);
        let values: Vec<_> = values.into_iter().map(|value| self.expression(value, arena)).collect();
        let [then, otherwise] = values[..] else { unreachable!("a choice has two values") };
        arena.expression(ExpressionSyntaxKind::Choice { condition, then, otherwise }, whole)
    }

    /// Each run of `~` and `!` is reported once.
    fn slip_prefix(&mut self, prefix: &Pair<Rule>, span: Span, stacks: &Stacks) {
        let sign = prefix.as_str();
        let follows = matches!(stacks.waiting.last(), Some(Waiting::Not(before)) if before.end - before.start == 1);
        if sign != "not" && !follows {
            self.errors.push(wording::not_sign(sign, span));
        }
    }

    fn apart(&self, sign: Span, word: &str) -> String {
        let space = |character: Option<char>| if character.is_some_and(char::is_whitespace) { "" } else { " " };
        let (before, after) =
            (&self.source[..sign.start as usize - self.offset], &self.source[sign.end as usize - self.offset..]);
        format!("{}{word}{}", space(before.chars().next_back()), space(after.chars().next()))
    }

    /// `next` is the text after the operator.
    fn push_infix(&mut self, (infix, place): (Infix, Span), next: &str, stacks: &mut Stacks, arena: &mut Arena) {
        while let Some(&top) = stacks.waiting.last().filter(|top| top.precedence() >= infix.precedence()) {
            if let Waiting::Infix(before, before_place) = top
                && before.precedence() == infix.precedence()
                && !infix.chains_after(before)
            {
                let [.., left, middle] = stacks.values[..] else { unreachable!("an operator has two operands") };
                let [left, middle] = [left, middle].map(|value| brief(self.text(arena.span(value))));
                let readings = [
                    format!("({left} {} {middle}) {} {}", before.word(), infix.word(), brief(next)),
                    format!("{left} {} ({middle} {} {})", before.word(), infix.word(), brief(next)),
                ];
                let operators = [before.word(), infix.word()];
                self.errors.push(wording::ambiguous(operators, readings, before_place, place));
            }
            stacks.reduce(arena);
        }
        stacks.waiting.push(Waiting::Infix(infix, place));
    }

    fn infix(&mut self, pair: &Pair<Rule>) -> Infix {
        let word = pair.as_str();
        if pair.as_rule() == Rule::slip_infix {
            let operator = if word.starts_with('&') {
                Operator::And
            } else if word.starts_with('|') {
                Operator::Or
            } else {
                Operator::Xor
            };
            let span = self.span(pair);
            let text = self.apart(span, operator.word());
            self.errors.push(wording::operator_sign(word, operator.word(), text, span));
            return Infix::Bitwise(operator);
        }
        Infix::of_sign(word)
            .unwrap_or_else(|| Infix::Bitwise(Operator::parse(word).expect("the grammar knows the operators")))
    }

    fn operand(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxId {
        let span = self.span(&pair);
        let kind = match pair.as_rule() {
            Rule::choice => self.choice(pair, arena),
            Rule::table | Rule::match_ => self.table(pair, arena),
            Rule::operation => self.operation(pair, arena),
            Rule::constant => self.constant(pair, arena),
            Rule::reference => self.reference(pair, arena),
            Rule::group => {
                ExpressionSyntaxKind::Group(self.expression(parts(pair).next().expect("an expression"), arena))
            }
            Rule::concatenation => ExpressionSyntaxKind::Concatenation(self.expressions(pair, arena)),
            Rule::repetition => self.repetition(pair, arena),
            rule => unreachable!("an operand is not {rule:?}"),
        };
        arena.expression(kind, span)
    }

    fn expressions(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> Vec<ExpressionSyntaxId> {
        parts(pair).map(|expression| self.expression(expression, arena)).collect()
    }

    /// The expressions after `else` are siblings in the grammar and nested in the tree.
    fn choice(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxKind {
        let mut values = Vec::new();
        for part in parts(pair) {
            match part.as_rule() {
                Rule::slip_then => {
                    let start = self.span(&part).start;
                    self.errors.push(wording::missing_then(Span { file: self.file, start, end: start + 1 }));
                }
                Rule::expression => values.push(self.expression(part, arena)),
                _ => {}
            }
        }
        choice_of(values, arena)
    }

    fn operation(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxKind {
        let mut parts = parts(pair);
        let operator =
            Operator::parse(parts.next().expect("an operator").as_str()).expect("the grammar knows the operators");
        ExpressionSyntaxKind::Operation { operator, operands: self.expressions(parts.next().expect("operands"), arena) }
    }

    fn repetition(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxKind {
        let mut parts = parts(pair);
        let count = self.size_operand(parts.next().expect("a count"), arena);
        ExpressionSyntaxKind::Repetition { count, values: parts.map(|value| self.expression(value, arena)).collect() }
    }

    fn constant(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxKind {
        let mut parts = parts(pair);
        let first = parts.next().expect("digits");
        let Some(base) = parts.next() else { return ExpressionSyntaxKind::Digits(first.as_str().to_owned()) };
        let width = match first.as_rule() {
            Rule::digits => SizeSyntaxKind::Literal(first.as_str().to_owned()),
            _ => SizeSyntaxKind::Name(first.as_str().to_owned()),
        };
        let width = arena.size(width, self.span(&first));
        let base = base.as_str().chars().next().expect("a base");
        let value = parts.next().expect("a value");
        if value.as_rule() == Rule::computed {
            return self.computed(width, base, value, arena);
        }
        let digits = value.as_str().to_owned();
        ExpressionSyntaxKind::Constant { width, base, digits }
    }

    fn computed(
        &mut self,
        width: SizeSyntaxId,
        base: char,
        pair: Pair<Rule>,
        arena: &mut Arena,
    ) -> ExpressionSyntaxKind {
        let span = self.span(&pair);
        if base != 'd' {
            self.errors.push(wording::base_of_computed(base, span));
        }
        ExpressionSyntaxKind::Computed { width, value: self.size(parts(pair).next().expect("a size"), arena) }
    }

    fn reference(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxKind {
        let mut parts = parts(pair).peekable();
        let name = self.name(&parts.next().expect("a name"));
        let mut brackets = || parts.next_if(|part| matches!(part.as_rule(), Rule::index | Rule::arguments));
        let (first, second) = (brackets(), brackets());
        let Some(operands) = parts.next() else {
            let [index, second] =
                [first, second].map(|index| index.and_then(|brackets| self.index_of_net(brackets, arena)));
            return ExpressionSyntaxKind::Net { name, index, second };
        };
        if let Some(second) = second {
            self.errors.push(wording::slice_of_circuit(self.span(&second)));
        }
        let arguments = first.map_or(Vec::new(), |brackets| self.arguments_of_call(brackets, arena));
        let operands = crate::syntax::convert::parts(operands).map(|operand| self.call_operand(operand, arena));
        ExpressionSyntaxKind::Call { name, arguments, operands: operands.collect() }
    }

    fn call_operand(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> OperandSyntax {
        let mut parts = parts(pair).peekable();
        let name = parts.next_if(|part| part.as_rule() == Rule::name).map(|name| self.name(&name));
        OperandSyntax { name, value: self.expression(parts.next().expect("an expression"), arena) }
    }

    fn index_of_net(&mut self, brackets: Pair<Rule>, arena: &mut Arena) -> Option<Index> {
        if brackets.as_rule() == Rule::index {
            return Some(self.index(brackets, arena));
        }
        self.errors.push(wording::parameters_of_net(self.span(&brackets)));
        None
    }

    fn arguments_of_call(&mut self, brackets: Pair<Rule>, arena: &mut Arena) -> Vec<crate::syntax::tree::Argument> {
        if brackets.as_rule() == Rule::arguments {
            return self.arguments(brackets, arena);
        }
        let index = self.index(brackets, arena);
        let value = match index.kind {
            IndexKind::One(value) => value,
            IndexKind::Slice(value, _) => {
                self.errors.push(wording::slice_of_circuit(index.span));
                value
            }
            IndexKind::Value(_) => {
                self.errors.push(wording::value_for_parameter(index.span));
                return Vec::new();
            }
        };
        let span = arena.sizes[value.0 as usize].span;
        vec![crate::syntax::tree::Argument { name: None, value, span }]
    }

    fn table(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> ExpressionSyntaxKind {
        let is_match = pair.as_rule() == Rule::match_;
        let mut parts = parts(pair);
        let first = parts.next().expect("an expression or operands");
        let inputs = if is_match { vec![self.expression(first, arena)] } else { self.expressions(first, arena) };
        let rows = parts.map(|row| self.table_row(row, arena)).collect();
        ExpressionSyntaxKind::Table { is_match, inputs, rows }
    }

    pub(crate) fn table_row(&mut self, pair: Pair<Rule>, arena: &mut Arena) -> TableRowSyntax {
        let span = self.span(&pair);
        let (patterns, mut rest): (Vec<_>, Vec<_>) = parts(pair).partition(|part| part.as_rule() == Rule::pattern);
        let patterns = patterns.iter().map(|pattern| self.name(pattern)).collect();
        let output = rest.pop().expect("an output");
        let output = match output.as_rule() {
            Rule::output_bits => TableOutputSyntax::Bits(self.name(&output)),
            _ => TableOutputSyntax::Value(self.expression(output, arena)),
        };
        TableRowSyntax { patterns, output, span }
    }
}

/// The choice of conditions and values in order of text; the last value has no condition.
pub(crate) fn choice_of(mut values: Vec<ExpressionSyntaxId>, arena: &mut Arena) -> ExpressionSyntaxKind {
    let mut otherwise = values.pop().expect("a choice has its last branch");
    loop {
        let then = values.pop().expect("a choice has a value");
        let condition = values.pop().expect("a choice has a condition");
        if values.is_empty() {
            return ExpressionSyntaxKind::Choice { condition, then, otherwise };
        }
        let span = arena.span(condition).to(arena.span(otherwise));
        otherwise = arena.expression(ExpressionSyntaxKind::Choice { condition, then, otherwise }, span);
    }
}

impl Stacks {
    fn reduce(&mut self, arena: &mut Arena) {
        let right = self.values.pop().expect("an operand");
        let value = match self.waiting.pop().expect("an operator") {
            Waiting::Not(place) => arena.expression(ExpressionSyntaxKind::Not(right), place.to(arena.span(right))),
            Waiting::Infix(operator, place) => {
                let left = self.values.pop().expect("a left operand");
                let span = arena.span(left).to(arena.span(right));
                arena.expression(ExpressionSyntaxKind::Infix { operator, place, left, right }, span)
            }
        };
        self.values.push(value);
    }
}

fn brief(operand: &str) -> &str {
    if operand.len() > 24 || operand.contains('\n') { "…" } else { operand.trim_end() }
}
