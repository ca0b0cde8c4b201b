//! The circuit that is being called at a place, and the operand that is being written.

use std::ops::Range;

use gen_lsp_types::{MarkupContent, MarkupKind, ParameterInformation, SignatureHelp, SignatureInformation};

use crate::interface::Interface;
use crate::spot::Spot;
use crate::tokens::tokens;
use nbc_lang::syntax::{Token, TokenKind};

struct Call<'t> {
    circuit: &'t str,
    /// In brackets are parameters, else operands.
    in_brackets: bool,
    at: usize,
}

pub(super) fn help(spot: &Spot<'_>) -> Option<SignatureHelp> {
    let text = spot.text();
    let tokens = tokens(text);
    let call = call(text, &tokens, spot.offset)?;
    let circuit = spot.files.checked.program.circuit(call.circuit)?;
    let interface = Interface::of(&spot.files, circuit);
    let places = if call.in_brackets { interface.parameter_places() } else { interface.input_places() };
    // Names are of one byte each character, so that bytes are code units of either encoding.
    let parameter = |place: &Range<usize>| ParameterInformation {
        label: (place.start as u32, place.end as u32).into(),
        documentation: None,
    };
    let active = (call.at < places.len()).then_some(call.at as u32);
    let documentation = MarkupContent { kind: MarkupKind::Markdown, value: interface.comment.clone() };
    let signature = SignatureInformation {
        label: interface.label(),
        documentation: (!interface.comment.is_empty()).then(|| documentation.into()),
        parameters: Some(places.iter().map(parameter).collect()),
        active_parameter: active.map(Into::into),
    };
    Some(SignatureHelp {
        signatures: vec![signature],
        active_signature: Some(0),
        active_parameter: active.map(Into::into),
    })
}

fn call<'t>(text: &'t str, tokens: &[Token], offset: usize) -> Option<Call<'t>> {
    let word = |token: &Token| &text[token.range.clone()];
    let before = tokens.partition_point(|token| token.range.end <= offset);
    let (mut depth, mut at, mut is_named) = (0, 0, false);
    for open in (0..before).rev() {
        match word(&tokens[open]) {
            ")" | "]" | "}" => depth += 1,
            "(" | "[" if depth == 0 => {
                let in_brackets = word(&tokens[open]) == "[";
                // Parameters have names, operands do not: there a statement has begun.
                if is_named && !in_brackets {
                    return None;
                }
                return callee(text, &tokens[..open]).map(|circuit| Call { circuit, in_brackets, at });
            }
            // A brace outside all calls: the value is not an operand.
            "{" if depth == 0 => at = 0,
            "(" | "[" | "{" => depth -= 1,
            "," if depth == 0 => at += 1,
            "=" if depth == 0 => is_named = true,
            _ => {}
        }
    }
    None
}

fn callee<'t>(text: &'t str, before: &[Token]) -> Option<&'t str> {
    let last = before.last()?;
    let name = match &text[last.range.clone()] {
        "]" => {
            let open = before.iter().rposition(|token| &text[token.range.clone()] == "[")?;
            before[..open].last()?
        }
        _ => last,
    };
    (name.kind == TokenKind::Word).then(|| &text[name.range.clone()])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Option<(String, bool, usize)> {
        let offset = text.find('$').unwrap();
        let text = text.replace('$', "");
        let call = call(&text, &tokens(&text), offset)?;
        Some((call.circuit.to_owned(), call.in_brackets, call.at))
    }

    #[test]
    fn the_call_around_a_place_is_found() {
        let expected = |name: &str, in_brackets, at| Some((name.to_owned(), in_brackets, at));
        assert_eq!(found("q = f($"), expected("f", false, 0));
        assert_eq!(found("q = f(g(a, b), {a, b}, $)"), expected("f", false, 2));
        assert_eq!(found("q = f(a, g($"), expected("g", false, 0));
        assert_eq!(found("q = f[8](a, $"), expected("f", false, 1));
        assert_eq!(found("q = f[8, $"), expected("f", true, 1));
        assert_eq!(found("q = f[start = $"), expected("f", true, 0));
        assert_eq!(found("t = f(a\nq = $"), None);
        assert_eq!(found("q = f(a, {b, $"), expected("f", false, 1));
        assert_eq!([found("q = a$"), found("q = (a, $"), found("f(a)\nq = $")], [None, None, None]);
    }
}
