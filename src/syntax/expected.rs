//! Describes a parse error of pest in the words of the language: what was found and what was expected.

use pest::error::{Error, ErrorVariant, InputLocation};

use crate::diag::{Diagnostic, Suggestion, suggest};
use crate::source::{FileId, Span};
use crate::syntax::grammar::Rule;
use crate::syntax::slips;
use crate::syntax::split::{KEYWORDS, SourcePiece};
use crate::syntax::wording::SyntaxError;

/// The diagnostic for a declaration that does not follow the grammar.
pub(crate) fn diagnostic(text: &str, file: FileId, piece: &SourcePiece, error: &Error<Rule>) -> Diagnostic {
    let at = piece.range.start
        + match error.location {
            InputLocation::Pos(at) => at,
            InputLocation::Span((at, _)) => at,
        };
    let found = found(&text[at..piece.range.end]);
    let span = Span::new(file, at, at + found.len());
    if found.is_empty() {
        return unexpected_end(file, piece, error);
    }
    if let Some(slip) = slips::look(text, file, &piece.range, at, found, error) {
        return slip;
    }
    let found = found.to_owned();
    let error = if at == piece.range.start {
        let meant = Suggestion::near(&found, KEYWORDS);
        SyntaxError::UnexpectedDeclaration { found, meant }
    } else if let ErrorVariant::CustomError { .. } = error.variant {
        SyntaxError::TooDeepHere
    } else if found.starts_with(['\n', '\r']) {
        SyntaxError::EndOfLine { expected: expected(error) }
    } else {
        SyntaxError::Unexpected { found, expected: expected(error) }
    };
    error.at(span)
}

fn unexpected_end(file: FileId, piece: &SourcePiece, error: &Error<Rule>) -> Diagnostic {
    match piece.unclosed.last() {
        Some(&open) => SyntaxError::UnclosedBracket.at(Span::new(file, open, open + 1)),
        None => {
            let end = Span::new(file, piece.range.end, piece.range.end);
            SyntaxError::EndOfDeclaration { expected: expected(error) }.at(end)
        }
    }
}

/// The word or sign that a text begins with; a long one is cut.
fn found(rest: &str) -> &str {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let first = rest.chars().next();
    let end = match first {
        Some(c) if is_word(c) => {
            rest.char_indices().take(40).find(|(_, c)| !is_word(*c)).map_or(rest.len(), |(at, _)| at)
        }
        Some(c) => c.len_utf8(),
        None => 0,
    };
    &rest[..rest.floor_char_boundary(end.min(40))]
}

fn expected(error: &Error<Rule>) -> String {
    let ErrorVariant::ParsingError { positives, .. } = &error.variant else { return "here".to_owned() };
    let mut words: Vec<&str> = positives.iter().filter_map(|rule| word(*rule)).collect();
    words.sort_unstable();
    words.dedup();
    match words[..] {
        [] => "not expected here".to_owned(),
        _ => format!("expected {}", suggest::join(&words, "or")),
    }
}

/// The name of a rule in messages; `None` if the message should not suggest it.
fn word(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::EOI => "the end of the declaration",
        Rule::name => "a name",
        Rule::text => "a string in quotes",
        Rule::number | Rule::digits => "a number",
        Rule::unit => "a unit",
        Rule::quantity => "a number with its unit",
        Rule::record => "`{`",
        Rule::field => "a field",
        Rule::list | Rule::product | Rule::range | Rule::bins | Rule::applied | Rule::function | Rule::instance => {
            "a value"
        }
        Rule::columns | Rule::inputs | Rule::outputs | Rule::operands => "`(`",
        Rule::spells | Rule::body | Rule::test_table => "`{`",
        Rule::spell | Rule::row | Rule::cell => "a row",
        Rule::header => "column names",
        Rule::bar => "`|`",
        Rule::parameters | Rule::arguments | Rule::index => "`[`",
        Rule::parameter | Rule::argument => "a parameter",
        Rule::port => "a port",
        Rule::loop_ | Rule::nets | Rule::drive => "a statement",
        Rule::targets | Rule::target => "a net",
        Rule::expression | Rule::choice | Rule::operation | Rule::constant | Rule::reference | Rule::group => {
            "an expression"
        }
        Rule::table | Rule::repetition | Rule::concatenation | Rule::prefix => "an expression",
        Rule::operator | Rule::sum | Rule::comparison => "an operator",
        Rule::base => "`b`, `d` or `h`",
        Rule::pattern | Rule::table_row | Rule::pattern_digits => "a pattern of `0`, `1` and `-`",
        Rule::size | Rule::size_group | Rule::log2 => "a number",
        Rule::size_infix => "an operator",
        Rule::with_word => "`with`",
        Rule::times_word => "`x`",
        Rule::in_word | Rule::in_world => "`in`",
        Rule::bins_word => "`bins`",
        Rule::for_word | Rule::for_all => "`for`",
        Rule::all_word => "`all`",
        Rule::inputs_word => "`inputs`",
        Rule::against_word => "`against`",
        Rule::then_word => "`then`",
        Rule::else_word => "`else`",
        Rule::schedule_word => "`schedule`",
        _ => return None,
    })
}
