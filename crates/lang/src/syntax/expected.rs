//! Describes a parse error of pest in the words of the language: what was found and what was expected.

use pest::error::{Error, ErrorVariant, InputLocation};

use crate::syntax::grammar::Rule;
use crate::syntax::lexer::{is_word, open_brackets};
use crate::syntax::part::{PartKind, PartPlace};
use crate::syntax::slips;
use crate::syntax::wording;
use nbc_base::diag::{Diagnostic, suggest};
use nbc_base::source::Span;

pub(crate) fn place(error: &Error<Rule>) -> usize {
    match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    }
}

pub(crate) fn diagnostic(part: &PartPlace<'_>, at: usize, error: &Error<Rule>) -> Diagnostic {
    let found = found(&part.source[at..part.end]);
    let span = Span::new(part.file, part.offset + at, part.offset + at + found.len());
    if found.is_empty()
        && let Some(open) = open_brackets(&part.source[part.start..part.end]).last()
    {
        let open = part.offset + part.start + open;
        let span = Span::new(part.file, open, open + 1);
        return wording::unclosed_bracket(part.kind == PartKind::Declaration, span);
    }
    if let Some(slip) = slips::look(part, at, found, error) {
        slip
    } else if found.is_empty() && part.kind == PartKind::Declaration {
        wording::end_of_declaration(expected(error), span)
    } else if found.is_empty() {
        wording::end_of_line(expected(error), span)
    } else if part.kind == PartKind::Declaration && at == 0 {
        wording::unexpected_declaration(found, span)
    } else if let ErrorVariant::CustomError { .. } = error.variant {
        wording::deep_text(span)
    } else if found.starts_with(['\n', '\r']) {
        wording::end_of_line(expected(error), span)
    } else {
        wording::unexpected(found, expected(error), span)
    }
}

fn found(rest: &str) -> &str {
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

/// `None` if messages should not suggest the rule.
fn word(rule: Rule) -> Option<&'static str> {
    Some(match rule {
        Rule::name | Rule::sensed => "a name",
        Rule::text => "a string in quotes",
        Rule::number | Rule::digits => "a number",
        Rule::unit => "a unit",
        Rule::quantity => "a number with its unit",
        Rule::record => "`{`",
        Rule::field => "a field",
        Rule::list | Rule::product | Rule::range | Rule::bins | Rule::applied | Rule::function | Rule::instance => {
            "a value"
        }
        Rule::columns | Rule::inputs | Rule::outputs | Rule::operands | Rule::named_operands => "`(`",
        Rule::spells | Rule::body | Rule::test_table => "`{`",
        Rule::property | Rule::quantifier => "a property",
        Rule::implies => "`=>`",
        Rule::within | Rule::within_word => "`within`",
        Rule::steps_word => "`steps`",
        Rule::spell | Rule::row | Rule::cell | Rule::repeated => "a row",
        Rule::until => "`until`",
        Rule::at_word | Rule::at_least => "`at`",
        Rule::from_word | Rule::from_file => "`from`",
        Rule::least_word => "`least`",
        Rule::most_word => "`most`",
        Rule::rows_word => "`rows`",
        Rule::member => "a member",
        Rule::encoding | Rule::kind => "`:`",
        Rule::beside => "`with`",
        Rule::header => "column names",
        Rule::bar => "`|`",
        Rule::slip_arrow => "`=`",
        Rule::parameters | Rule::arguments | Rule::index => "`[`",
        Rule::parameter | Rule::argument => "a parameter",
        Rule::port => "a port",
        Rule::loop_ | Rule::nets | Rule::drive | Rule::integer | Rule::conditional => "a statement",
        Rule::targets | Rule::joined | Rule::target => "a net",
        Rule::expression | Rule::choice | Rule::operation | Rule::constant | Rule::reference | Rule::group => {
            "an expression"
        }
        Rule::table | Rule::match_ | Rule::named_operand | Rule::repetition | Rule::concatenation | Rule::prefix => {
            "an expression"
        }
        Rule::operator | Rule::sum | Rule::product_sign | Rule::shift | Rule::comparison => "an operator",
        Rule::base => "`b`, `d` or `h`",
        Rule::pattern | Rule::table_row | Rule::pattern_digits => "a pattern of `0`, `1` and `-`",
        Rule::size | Rule::size_group | Rule::log2 => "a number",
        Rule::size_infix => "an operator",
        Rule::with_word => "`with`",
        Rule::times_word => "`x`",
        Rule::in_word | Rule::in_world | Rule::in_worlds => "`in`",
        Rule::bins_word => "`bins`",
        Rule::for_word | Rule::for_all => "`for`",
        Rule::all_word => "`all`",
        Rule::inputs_word => "`inputs`",
        Rule::against_word | Rule::for_ever => "`against`",
        Rule::ever_word => "`ever`",
        Rule::then_word => "`then`",
        Rule::else_word => "`else`",
        Rule::schedule_word => "`schedule`",
        _ => return None,
    })
}
