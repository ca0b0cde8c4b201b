//! Expressions and sizes as pieces of text.

use crate::syntax::format::layout::{LayoutPiece, layout};
use crate::syntax::tree::{
    Argument, BodySyntax, ExpressionSyntax, ExpressionSyntaxId, ExpressionSyntaxKind, Index, IndexKind, Infix,
    SizeSyntax, SizeSyntaxId, SizeSyntaxKind, TableOutputSyntax, TableRowSyntax,
};
use nbc_base::source::Span;

#[derive(Clone, Copy)]
pub(super) struct Written<'a> {
    pub(super) body: &'a BodySyntax,
    pub(super) source: &'a str,
    pub(super) comments: &'a [Span],
}

pub(super) fn expression(written: Written, id: ExpressionSyntaxId) -> Vec<LayoutPiece> {
    let mut pieces = Vec::new();
    push(written, id, &mut pieces);
    pieces
}

fn text(pieces: &mut Vec<LayoutPiece>, text: impl Into<String>) {
    let text = text.into();
    match pieces.last_mut() {
        Some(LayoutPiece::Text(last)) => last.push_str(&text),
        _ => pieces.push(LayoutPiece::Text(text)),
    }
}

/// The recursion is no deeper than the nesting of the text's brackets.
fn push(written: Written, id: ExpressionSyntaxId, pieces: &mut Vec<LayoutPiece>) {
    match &written.body.expressions[id.0 as usize].kind {
        ExpressionSyntaxKind::Digits(digits) => text(pieces, digits.clone()),
        ExpressionSyntaxKind::Constant { width, base, digits } => {
            text(pieces, format!("{}'{base}{digits}", size(&written.body.sizes, *width)));
        }
        ExpressionSyntaxKind::Computed { width, value } => {
            text(pieces, format!("{}'d({})", size(&written.body.sizes, *width), size(&written.body.sizes, *value)));
        }
        ExpressionSyntaxKind::Net { name, index: first, second } => {
            text(pieces, &*name.text);
            pieces_of_index(written, first.as_ref(), pieces);
            pieces_of_index(written, second.as_ref(), pieces);
        }
        ExpressionSyntaxKind::Call { name, arguments: given, operands } => {
            text(pieces, format!("{}{}", name.text, arguments(&written.body.sizes, given)));
            let names = operands.iter().map(|operand| operand.name.as_ref().map(|name| name.text.as_str()));
            let values: Vec<_> = operands.iter().map(|operand| operand.value).collect();
            named_list(written, "(", names, &values, ")", pieces);
        }
        ExpressionSyntaxKind::Group(inner) => list(written, "(", &[*inner], ")", pieces),
        ExpressionSyntaxKind::Concatenation(parts) => list(written, "{", parts, "}", pieces),
        ExpressionSyntaxKind::Repetition { count, values } => {
            text(pieces, format!("{{{}", size(&written.body.sizes, *count)));
            list(written, "{", values, "}", pieces);
            text(pieces, "}");
        }
        ExpressionSyntaxKind::Not(_) => negation(written, id, pieces),
        ExpressionSyntaxKind::Infix { operator, .. } => chain(written, id, *operator, pieces),
        ExpressionSyntaxKind::Operation { operator, operands } => {
            text(pieces, operator.word());
            list(written, "(", operands, ")", pieces);
        }
        ExpressionSyntaxKind::Choice { .. } => choice(written, id, pieces),
        ExpressionSyntaxKind::Table { .. } => table(written, id, pieces),
    }
}

fn pieces_of_index(written: Written, bits: Option<&Index>, pieces: &mut Vec<LayoutPiece>) {
    match bits {
        Some(Index { kind: IndexKind::Value(value), .. }) => list(written, "[", &[*value], "]", pieces),
        Some(bits) => text(pieces, index(written.body, bits)),
        None => {}
    }
}

fn list(written: Written, open: &str, values: &[ExpressionSyntaxId], close: &str, pieces: &mut Vec<LayoutPiece>) {
    named_list(written, open, values.iter().map(|_| None), values, close, pieces);
}

fn named_list<'n>(
    written: Written,
    open: &str,
    names: impl Iterator<Item = Option<&'n str>>,
    values: &[ExpressionSyntaxId],
    close: &str,
    pieces: &mut Vec<LayoutPiece>,
) {
    text(pieces, open);
    pieces.push(LayoutPiece::Open);
    for (at, (&value, name)) in values.iter().zip(names).enumerate() {
        pieces.push(LayoutPiece::Break(if at == 0 { "" } else { ", " }));
        if let Some(name) = name {
            text(pieces, format!("{name}: "));
        }
        push(written, value, pieces);
    }
    pieces.push(LayoutPiece::EndBreak(""));
    pieces.push(LayoutPiece::Close);
    text(pieces, close);
}

fn negation(written: Written, id: ExpressionSyntaxId, pieces: &mut Vec<LayoutPiece>) {
    let mut at = id;
    while let ExpressionSyntaxKind::Not(inner) = written.body.expressions[at.0 as usize].kind {
        text(pieces, "not ");
        at = inner;
    }
    push(written, at, pieces);
}

/// Operators of one precedence are one group.
fn chain(written: Written, id: ExpressionSyntaxId, operator: Infix, pieces: &mut Vec<LayoutPiece>) {
    let mut links = Vec::new();
    let mut at = id;
    while let ExpressionSyntaxKind::Infix { operator: here, left, right, .. } =
        written.body.expressions[at.0 as usize].kind
        && here.precedence() == operator.precedence()
    {
        links.push((here, right));
        at = left;
    }
    pieces.push(LayoutPiece::Open);
    push(written, at, pieces);
    for (operator, right) in links.into_iter().rev() {
        pieces.push(LayoutPiece::Break(" "));
        text(pieces, format!("{} ", operator.word()));
        push(written, right, pieces);
    }
    pieces.push(LayoutPiece::Close);
}

/// Choices after an `else` are at the same level.
fn choice(written: Written, id: ExpressionSyntaxId, pieces: &mut Vec<LayoutPiece>) {
    pieces.push(LayoutPiece::Open);
    let mut at = id;
    while let ExpressionSyntaxKind::Choice { condition, then, otherwise } = written.body.expressions[at.0 as usize].kind
    {
        text(pieces, "if ");
        push(written, condition, pieces);
        pieces.push(LayoutPiece::Break(" "));
        text(pieces, "then ");
        push(written, then, pieces);
        pieces.push(LayoutPiece::Break(" "));
        text(pieces, "else ");
        at = otherwise;
    }
    push(written, at, pieces);
    pieces.push(LayoutPiece::Close);
}

fn table(written: Written, id: ExpressionSyntaxId, pieces: &mut Vec<LayoutPiece>) {
    let ExpressionSyntax { kind: ExpressionSyntaxKind::Table { is_match, inputs, rows }, span } =
        &written.body.expressions[id.0 as usize]
    else {
        return;
    };
    match (is_match, &inputs[..]) {
        (true, [input]) => {
            text(pieces, "match ");
            push(written, *input, pieces);
        }
        _ => {
            text(pieces, "table");
            list(written, "(", inputs, ")", pieces);
        }
    }
    text(pieces, " {");
    pieces.push(LayoutPiece::Open);
    let pattern = |row: &TableRowSyntax| match &row.patterns[..] {
        [] => "else".to_owned(),
        patterns => patterns.iter().map(|pattern| pattern.text.as_str()).collect::<Vec<_>>().join(" or "),
    };
    let width = rows.iter().map(|row| pattern(row).len()).max().unwrap_or(0);
    let inputs_end = inputs.last().map_or(span.start, |last| written.body.expressions[last.0 as usize].span.end);
    let mut lines = RowLines { written, at: inputs_end, count: 0 };
    let head_end = rows.first().map_or(inputs_end, |row| row.span.start);
    // There is no source of an index, which has one line.
    let head = written.source.get(inputs_end as usize..head_end as usize).unwrap_or_default();
    // A table whose first row has a line of its own stays as its author laid it out.
    if head.find('{').is_some_and(|brace| head[brace..].contains('\n')) {
        pieces.push(LayoutPiece::Force);
    }
    for row in rows {
        lines.comments(row.span.start, pieces);
        lines.at = row.span.end;
        let pattern = pattern(row);
        let pad = width - pattern.len();
        lines.begin(pieces);
        pieces.push(LayoutPiece::Text(format!("{pattern}:")));
        pieces.push(LayoutPiece::Pad(pad));
        text(pieces, " ");
        match &row.output {
            TableOutputSyntax::Bits(bits) => text(pieces, &*bits.text),
            TableOutputSyntax::Value(value) => push(written, *value, pieces),
        }
    }
    lines.comments(span.end, pieces);
    pieces.push(LayoutPiece::EndBreak(" "));
    pieces.push(LayoutPiece::Close);
    text(pieces, "}");
}

struct RowLines<'a> {
    written: Written<'a>,
    at: u32,
    count: usize,
}

impl RowLines<'_> {
    fn begin(&mut self, pieces: &mut Vec<LayoutPiece>) {
        pieces.push(LayoutPiece::RowBreak(if self.count == 0 { " " } else { ", " }));
        self.count += 1;
    }

    /// A comment behind a row stays there; others have lines of their own.
    fn comments(&mut self, end: u32, pieces: &mut Vec<LayoutPiece>) {
        let Written { source, comments, .. } = self.written;
        let first = comments.partition_point(|comment| comment.start < self.at);
        for comment in comments[first..].iter().take_while(|comment| comment.start < end) {
            let is_behind = self.count > 0 && !source[self.at as usize..comment.start as usize].contains('\n');
            if !is_behind {
                self.begin(pieces);
            }
            let text = source[comment.range()].trim_end();
            let text = if is_behind { format!("  {text}") } else { text.to_owned() };
            pieces.push(LayoutPiece::Comment { start: comment.start, text });
            self.at = comment.end;
        }
    }
}

pub(super) fn size(sizes: &[SizeSyntax], id: SizeSyntaxId) -> String {
    match &sizes[id.0 as usize].kind {
        SizeSyntaxKind::Literal(word) | SizeSyntaxKind::Name(word) => word.clone(),
        SizeSyntaxKind::Log2(inner) => format!("log2({})", size(sizes, *inner)),
        SizeSyntaxKind::Group(inner) => format!("({})", size(sizes, *inner)),
        SizeSyntaxKind::Binary(..) => size_chain(sizes, id),
    }
}

/// It does not recurse into the left side, which may be long.
fn size_chain(sizes: &[SizeSyntax], id: SizeSyntaxId) -> String {
    let mut links = Vec::new();
    let mut at = id;
    while let SizeSyntaxKind::Binary(operator, left, right) = sizes[at.0 as usize].kind {
        links.push(format!(" {} {}", operator.sign(), size(sizes, right)));
        at = left;
    }
    let mut text = size(sizes, at);
    text.extend(links.into_iter().rev());
    text
}

pub(super) fn index(body: &BodySyntax, index: &Index) -> String {
    let sizes = &body.sizes;
    match index.kind {
        IndexKind::One(bit) => format!("[{}]", size(sizes, bit)),
        IndexKind::Slice(high, low) => format!("[{}..{}]", size(sizes, high), size(sizes, low)),
        IndexKind::Value(value) => {
            let pieces = expression(Written { body, source: "", comments: &[] }, value);
            format!("[{}]", layout(&pieces, 0, 0))
        }
    }
}

pub(super) fn arguments(sizes: &[SizeSyntax], arguments: &[Argument]) -> String {
    let one = |argument: &Argument| {
        let value = size(sizes, argument.value);
        argument.name.as_ref().map_or_else(|| value.clone(), |name| format!("{} = {value}", name.text))
    };
    match arguments {
        [] => String::new(),
        _ => format!("[{}]", arguments.iter().map(one).collect::<Vec<_>>().join(", ")),
    }
}
