//! Expressions and sizes as pieces of text.

use crate::syntax::format::layout::LayoutPiece;
use crate::syntax::tree::{
    Argument, BodySyntax, ExpressionSyntaxId, ExpressionSyntaxKind, Index, Infix, SizeSyntax, SizeSyntaxId,
    SizeSyntaxKind, TableOutputSyntax, TableRowSyntax,
};

/// The pieces of an expression.
pub(super) fn expression(body: &BodySyntax, id: ExpressionSyntaxId) -> Vec<LayoutPiece> {
    let mut pieces = Vec::new();
    push(body, id, &mut pieces);
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
fn push(body: &BodySyntax, id: ExpressionSyntaxId, pieces: &mut Vec<LayoutPiece>) {
    match &body.expressions[id.0 as usize].kind {
        ExpressionSyntaxKind::Digits(digits) => text(pieces, digits.clone()),
        ExpressionSyntaxKind::Constant { width, base, digits } => {
            text(pieces, format!("{}'{base}{digits}", size(&body.sizes, *width)));
        }
        ExpressionSyntaxKind::Computed { width, value } => {
            text(pieces, format!("{}'d({})", size(&body.sizes, *width), size(&body.sizes, *value)));
        }
        ExpressionSyntaxKind::Net { name, index: bits } => {
            text(pieces, format!("{}{}", name.text, index(&body.sizes, bits.as_ref())));
        }
        ExpressionSyntaxKind::Call { name, arguments: given, operands } => {
            text(pieces, format!("{}{}", name.text, arguments(&body.sizes, given)));
            list(body, "(", operands, ")", pieces);
        }
        ExpressionSyntaxKind::Group(inner) => list(body, "(", &[*inner], ")", pieces),
        ExpressionSyntaxKind::Concatenation(parts) => list(body, "{", parts, "}", pieces),
        ExpressionSyntaxKind::Repetition { count, values } => {
            text(pieces, format!("{{{}", size(&body.sizes, *count)));
            list(body, "{", values, "}", pieces);
            text(pieces, "}");
        }
        ExpressionSyntaxKind::Not(_) => negation(body, id, pieces),
        ExpressionSyntaxKind::Infix { operator, .. } => chain(body, id, *operator, pieces),
        ExpressionSyntaxKind::Operation { operator, operands } => {
            text(pieces, operator.word());
            list(body, "(", operands, ")", pieces);
        }
        ExpressionSyntaxKind::Choice { .. } => choice(body, id, pieces),
        ExpressionSyntaxKind::Table { inputs, rows } => table(body, inputs, rows, pieces),
    }
}

fn list(body: &BodySyntax, open: &str, values: &[ExpressionSyntaxId], close: &str, pieces: &mut Vec<LayoutPiece>) {
    text(pieces, open);
    pieces.push(LayoutPiece::Open);
    for (at, &value) in values.iter().enumerate() {
        pieces.push(LayoutPiece::Break(if at == 0 { "" } else { ", " }));
        push(body, value, pieces);
    }
    pieces.push(LayoutPiece::EndBreak(""));
    pieces.push(LayoutPiece::Close);
    text(pieces, close);
}

fn negation(body: &BodySyntax, id: ExpressionSyntaxId, pieces: &mut Vec<LayoutPiece>) {
    let mut at = id;
    while let ExpressionSyntaxKind::Not(inner) = body.expressions[at.0 as usize].kind {
        text(pieces, "not ");
        at = inner;
    }
    push(body, at, pieces);
}

/// A chain of operators with the same precedence is one group.
fn chain(body: &BodySyntax, id: ExpressionSyntaxId, operator: Infix, pieces: &mut Vec<LayoutPiece>) {
    let mut links = Vec::new();
    let mut at = id;
    while let ExpressionSyntaxKind::Infix { operator: here, left, right, .. } = body.expressions[at.0 as usize].kind
        && here.precedence() == operator.precedence()
    {
        links.push((here, right));
        at = left;
    }
    pieces.push(LayoutPiece::Open);
    push(body, at, pieces);
    for (operator, right) in links.into_iter().rev() {
        pieces.push(LayoutPiece::Break(" "));
        text(pieces, format!("{} ", operator.word()));
        push(body, right, pieces);
    }
    pieces.push(LayoutPiece::Close);
}

/// An `if` expression; those after its `else` are at the same level.
fn choice(body: &BodySyntax, id: ExpressionSyntaxId, pieces: &mut Vec<LayoutPiece>) {
    pieces.push(LayoutPiece::Open);
    let mut at = id;
    while let ExpressionSyntaxKind::Choice { condition, then, otherwise } = body.expressions[at.0 as usize].kind {
        text(pieces, "if ");
        push(body, condition, pieces);
        pieces.push(LayoutPiece::Break(" "));
        text(pieces, "then ");
        push(body, then, pieces);
        pieces.push(LayoutPiece::Break(" "));
        text(pieces, "else ");
        at = otherwise;
    }
    push(body, at, pieces);
    pieces.push(LayoutPiece::Close);
}

fn table(body: &BodySyntax, inputs: &[ExpressionSyntaxId], rows: &[TableRowSyntax], pieces: &mut Vec<LayoutPiece>) {
    text(pieces, "table");
    list(body, "(", inputs, ")", pieces);
    text(pieces, " {");
    pieces.push(LayoutPiece::Open);
    let pattern = |row: &TableRowSyntax| row.pattern.as_ref().map_or("else", |pattern| &pattern.text).to_owned();
    let width = rows.iter().map(|row| pattern(row).len()).max().unwrap_or(0);
    for (at, row) in rows.iter().enumerate() {
        let pattern = pattern(row);
        let pad = width - pattern.len();
        pieces.push(LayoutPiece::Break(if at == 0 { " " } else { ", " }));
        pieces.push(LayoutPiece::Text(format!("{pattern}:")));
        pieces.push(LayoutPiece::Pad(pad));
        text(pieces, " ");
        match &row.output {
            TableOutputSyntax::Bits(bits) => text(pieces, &*bits.text),
            TableOutputSyntax::Value(value) => push(body, *value, pieces),
        }
    }
    pieces.push(LayoutPiece::EndBreak(" "));
    pieces.push(LayoutPiece::Close);
    text(pieces, "}");
}

/// A size as text; always on one line.
pub(super) fn size(sizes: &[SizeSyntax], id: SizeSyntaxId) -> String {
    match &sizes[id.0 as usize].kind {
        SizeSyntaxKind::Literal(word) | SizeSyntaxKind::Name(word) => word.clone(),
        SizeSyntaxKind::Log2(inner) => format!("log2({})", size(sizes, *inner)),
        SizeSyntaxKind::Group(inner) => format!("({})", size(sizes, *inner)),
        SizeSyntaxKind::Binary(..) => size_chain(sizes, id),
    }
}

/// A chain of operators, without recursion into the left side, which may be long.
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

/// `[3]`, `[3..0]` or nothing.
pub(super) fn index(sizes: &[SizeSyntax], index: Option<&Index>) -> String {
    match index {
        None => String::new(),
        Some(Index { high, low: None, .. }) => format!("[{}]", size(sizes, *high)),
        Some(Index { high, low: Some(low), .. }) => format!("[{}..{}]", size(sizes, *high), size(sizes, *low)),
    }
}

/// `[8, start = 1]` or nothing.
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
