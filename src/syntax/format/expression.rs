//! Expressions and sizes as pieces of text.

use crate::syntax::format::layout::Piece;
use crate::syntax::tree::{
    Argument, Body, ExpressionId, ExpressionKind, Index, Infix, Size, SizeId, SizeKind, TableRow,
};

/// The pieces of an expression.
pub(super) fn expression(body: &Body, id: ExpressionId) -> Vec<Piece> {
    let mut pieces = Vec::new();
    push(body, id, &mut pieces);
    pieces
}

fn text(pieces: &mut Vec<Piece>, text: impl Into<String>) {
    let text = text.into();
    match pieces.last_mut() {
        Some(Piece::Text(last)) => last.push_str(&text),
        _ => pieces.push(Piece::Text(text)),
    }
}

/// The recursion is no deeper than the nesting of the text's brackets.
fn push(body: &Body, id: ExpressionId, pieces: &mut Vec<Piece>) {
    match &body.expressions[id.0 as usize].kind {
        ExpressionKind::Digits(digits) => text(pieces, digits.clone()),
        ExpressionKind::Constant { width, base, digits } => {
            text(pieces, format!("{}'{base}{digits}", size(&body.sizes, *width)));
        }
        ExpressionKind::Computed { width, value } => {
            text(pieces, format!("{}'d({})", size(&body.sizes, *width), size(&body.sizes, *value)));
        }
        ExpressionKind::Net { name, index: bits } => {
            text(pieces, format!("{}{}", name.text, index(&body.sizes, bits.as_ref())));
        }
        ExpressionKind::Call { name, arguments: given, operands } => {
            text(pieces, format!("{}{}", name.text, arguments(&body.sizes, given)));
            list(body, "(", operands, ")", pieces);
        }
        ExpressionKind::Group(inner) => list(body, "(", &[*inner], ")", pieces),
        ExpressionKind::Concatenation(parts) => list(body, "{", parts, "}", pieces),
        ExpressionKind::Repetition { count, values } => {
            text(pieces, format!("{{{}", size(&body.sizes, *count)));
            list(body, "{", values, "}", pieces);
            text(pieces, "}");
        }
        ExpressionKind::Not(_) => negation(body, id, pieces),
        ExpressionKind::Infix { operator, .. } => chain(body, id, *operator, pieces),
        ExpressionKind::Operation { operator, operands } => {
            text(pieces, operator.word());
            list(body, "(", operands, ")", pieces);
        }
        ExpressionKind::Choice { .. } => choice(body, id, pieces),
        ExpressionKind::Table { inputs, rows } => table(body, inputs, rows, pieces),
    }
}

fn list(body: &Body, open: &str, values: &[ExpressionId], close: &str, pieces: &mut Vec<Piece>) {
    text(pieces, open);
    pieces.push(Piece::Open);
    for (at, &value) in values.iter().enumerate() {
        pieces.push(Piece::Break(if at == 0 { "" } else { ", " }));
        push(body, value, pieces);
    }
    pieces.push(Piece::EndBreak(""));
    pieces.push(Piece::Close);
    text(pieces, close);
}

fn negation(body: &Body, id: ExpressionId, pieces: &mut Vec<Piece>) {
    let mut at = id;
    while let ExpressionKind::Not(inner) = body.expressions[at.0 as usize].kind {
        text(pieces, "not ");
        at = inner;
    }
    push(body, at, pieces);
}

/// A chain of operators with the same precedence is one group.
fn chain(body: &Body, id: ExpressionId, operator: Infix, pieces: &mut Vec<Piece>) {
    let mut links = Vec::new();
    let mut at = id;
    while let ExpressionKind::Infix { operator: here, left, right, .. } = body.expressions[at.0 as usize].kind
        && here.precedence() == operator.precedence()
    {
        links.push((here, right));
        at = left;
    }
    pieces.push(Piece::Open);
    push(body, at, pieces);
    for (operator, right) in links.into_iter().rev() {
        pieces.push(Piece::Break(" "));
        text(pieces, format!("{} ", operator.word()));
        push(body, right, pieces);
    }
    pieces.push(Piece::Close);
}

/// An `if` expression; those after its `else` are at the same level.
fn choice(body: &Body, id: ExpressionId, pieces: &mut Vec<Piece>) {
    pieces.push(Piece::Open);
    let mut at = id;
    while let ExpressionKind::Choice { condition, then, otherwise } = body.expressions[at.0 as usize].kind {
        text(pieces, "if ");
        push(body, condition, pieces);
        pieces.push(Piece::Break(" "));
        text(pieces, "then ");
        push(body, then, pieces);
        pieces.push(Piece::Break(" "));
        text(pieces, "else ");
        at = otherwise;
    }
    push(body, at, pieces);
    pieces.push(Piece::Close);
}

fn table(body: &Body, inputs: &[ExpressionId], rows: &[TableRow], pieces: &mut Vec<Piece>) {
    text(pieces, "table");
    list(body, "(", inputs, ")", pieces);
    text(pieces, " {");
    pieces.push(Piece::Open);
    let pattern = |row: &TableRow| row.pattern.as_ref().map_or("else", |pattern| &pattern.text).to_owned();
    let width = rows.iter().map(|row| pattern(row).len()).max().unwrap_or(0);
    for (at, row) in rows.iter().enumerate() {
        let pattern = pattern(row);
        let pad = width - pattern.len();
        pieces.push(Piece::Break(if at == 0 { " " } else { ", " }));
        pieces.push(Piece::Text(format!("{pattern}:")));
        pieces.push(Piece::Pad(pad));
        pieces.push(Piece::Text(format!(" {}", row.output.text)));
    }
    pieces.push(Piece::EndBreak(" "));
    pieces.push(Piece::Close);
    text(pieces, "}");
}

/// A size as text; always on one line.
pub(super) fn size(sizes: &[Size], id: SizeId) -> String {
    match &sizes[id.0 as usize].kind {
        SizeKind::Literal(word) | SizeKind::Name(word) => word.clone(),
        SizeKind::Log2(inner) => format!("log2({})", size(sizes, *inner)),
        SizeKind::Group(inner) => format!("({})", size(sizes, *inner)),
        SizeKind::Binary(..) => size_chain(sizes, id),
    }
}

/// A chain of operators, without recursion into the left side, which may be long.
fn size_chain(sizes: &[Size], id: SizeId) -> String {
    let mut links = Vec::new();
    let mut at = id;
    while let SizeKind::Binary(operator, left, right) = sizes[at.0 as usize].kind {
        links.push(format!(" {} {}", operator.sign(), size(sizes, right)));
        at = left;
    }
    let mut text = size(sizes, at);
    text.extend(links.into_iter().rev());
    text
}

/// `[3]`, `[3..0]` or nothing.
pub(super) fn index(sizes: &[Size], index: Option<&Index>) -> String {
    match index {
        None => String::new(),
        Some(Index { high, low: None, .. }) => format!("[{}]", size(sizes, *high)),
        Some(Index { high, low: Some(low), .. }) => format!("[{}..{}]", size(sizes, *high), size(sizes, *low)),
    }
}

/// `[8, start = 1]` or nothing.
pub(super) fn arguments(sizes: &[Size], arguments: &[Argument]) -> String {
    let one = |argument: &Argument| {
        let value = size(sizes, argument.value);
        argument.name.as_ref().map_or_else(|| value.clone(), |name| format!("{} = {value}", name.text))
    };
    match arguments {
        [] => String::new(),
        _ => format!("[{}]", arguments.iter().map(one).collect::<Vec<_>>().join(", ")),
    }
}
