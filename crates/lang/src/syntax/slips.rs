//! Common mistakes and habits from other languages, recognized by the text around the place where a declaration
//! violates the grammar.

use pest::error::{Error, ErrorVariant};

use crate::syntax::grammar::Rule;
use crate::syntax::lexer::{is_word, open_brackets};
use crate::syntax::part::{PartKind, PartPlace};
use crate::syntax::wording;
use nbc_base::diag::{Diagnostic, suggest};
use nbc_base::source::{FileId, Span};

pub(crate) const RESERVED: [&str; 16] = [
    "and", "else", "for", "if", "in", "init", "log2", "nand", "net", "nor", "not", "or", "table", "then", "xnor", "xor",
];

const BETWEEN: [&str; 8] = ["and", "else", "nand", "nor", "or", "then", "xnor", "xor"];

pub(crate) struct SlipPlace<'a> {
    file: FileId,
    kind: PartKind,
    text: &'a str,
    offset: usize,
    /// Of the part.
    start: usize,
    end: usize,
    /// Of the parse error.
    at: usize,
    found: &'a str,
    wanted: &'a [Rule],
    /// Brackets of the part that are open there, as offsets.
    open: Vec<usize>,
}

/// The first that recognizes the place decides.
const LOOKS: [fn(&SlipPlace<'_>) -> Option<Diagnostic>; 13] = [
    letters,
    unclosed_quote,
    single_quote,
    start_of_net,
    reserved_word,
    sign,
    width_of_constant,
    nets_in_braces,
    space_before_operands,
    misspelled_operator,
    missing_operator,
    space_in_pattern,
    missing_comma,
];

pub(crate) fn look(part: &PartPlace<'_>, at: usize, found: &str, error: &Error<Rule>) -> Option<Diagnostic> {
    let ErrorVariant::ParsingError { positives: wanted, .. } = &error.variant else { return None };
    let &PartPlace { file, kind, source: text, offset, start, end } = part;
    let open = open_brackets(&text[start..at]).into_iter().map(|open| start + open).collect();
    let place = SlipPlace { file, kind, text, offset, start, end, at, found, wanted, open };
    LOOKS.iter().find_map(|look| look(&place))
}

fn last_word(text: &str) -> (&str, &str) {
    text.split_at(text.trim_end_matches(is_word).len())
}

fn brief(text: &str) -> &str {
    let text = text.trim();
    if text.is_empty() || text.len() > 40 || text.contains(['\n', '\r']) { "…" } else { text }
}

impl<'a> SlipPlace<'a> {
    fn before(&self) -> &'a str {
        &self.text[self.start..self.at]
    }

    fn after(&self) -> &'a str {
        &self.text[self.at..self.end]
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.file, self.offset + start, self.offset + end)
    }

    fn here(&self) -> Span {
        self.span(self.at, self.at + self.found.len())
    }

    fn wants(&self, rules: &[Rule]) -> bool {
        self.wanted.iter().any(|rule| rules.contains(rule))
    }

    fn inside(&self) -> Option<(usize, u8)> {
        self.open.last().map(|&at| (at, self.text.as_bytes()[at]))
    }

    fn in_ports(&self) -> bool {
        self.text[self.start..].starts_with("circuit")
            && self.open.first().is_some_and(|&at| self.text.as_bytes()[at] == b'(')
    }

    fn in_body(&self) -> bool {
        matches!(self.kind, PartKind::Statement | PartKind::TableRow | PartKind::Property)
    }

    fn word_before(&self) -> Option<(&'a str, usize, &'a str)> {
        let (rest, word) = last_word(self.before().trim_end());
        let line = rest.rsplit(['\n', '\r']).next().unwrap_or_default();
        (!word.is_empty()).then(|| (word, self.start + rest.len(), line.trim_end()))
    }
}

fn ends_operand(text: &str) -> bool {
    let word = last_word(text).1;
    let ends = text.ends_with(|c: char| is_word(c) || matches!(c, ')' | ']' | '}'));
    ends && !RESERVED.contains(&word)
}

fn letters(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let foreign = |word: &str| !word.is_ascii();
    let (rest, head) = last_word(place.before());
    let tail = place.after().find(|c| !is_word(c)).unwrap_or(place.after().len());
    let word = &place.text[place.start + rest.len()..place.at + tail];
    (foreign(word) && foreign(place.found) && word.chars().all(is_word))
        .then(|| wording::foreign_letters(word, place.span(place.at - head.len(), place.at + tail)))
}

fn unclosed_quote(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let line = place.after().lines().next().unwrap_or_default();
    (place.found == "\"" && !line[1..].contains('"')).then(|| wording::unclosed_quote(place.here()))
}

fn single_quote(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    (place.found == "'" && place.wants(&[Rule::text])).then(|| {
        let line = place.after().lines().next().unwrap_or_default();
        let close = line[1..].find('\'').map(|end| place.span(place.at + end + 1, place.at + end + 2));
        wording::single_quote(close, place.here())
    })
}

fn start_of_net(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let (word, at, line) = place.word_before().filter(|(word, ..)| *word == "init")?;
    let name = line.trim_start().strip_prefix("net ")?.rsplit(',').next()?.trim();
    let net = name.split(|c: char| !is_word(c)).next()?;
    Some(wording::start_of_net(net, place.span(at, at + word.len())))
}

fn reserved_word(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let assigned = |rest: &str| rest.trim_start().starts_with('=') && !rest.trim_start().starts_with("==");
    let (word, start) = if RESERVED.contains(&place.found) {
        let name = place.wants(&[Rule::name, Rule::port, Rule::target, Rule::parameter]);
        let named = name || assigned(&place.after()[place.found.len()..]) || place.in_ports();
        named.then_some((place.found, place.at))?
    } else {
        let (word, start, line) = place.word_before()?;
        (assigned(place.after()) && RESERVED.contains(&word) && !line.ends_with(is_word)).then_some((word, start))?
    };
    Some(wording::reserved_word(word, place.span(start, start + word.len())))
}

fn sign(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let before = place.before().trim_end();
    if place.found != "-" || !place.in_body() || ends_operand(before) {
        return None;
    }
    let operand = place.after()[1..].trim_start();
    let operand = &operand[..operand.find(|c| !is_word(c)).unwrap_or(operand.len())];
    let operator = before.chars().next_back().filter(|last| matches!(last, '+' | '-'));
    let end = place.at + place.after().find(operand)? + operand.len();
    let start = if operator.is_some() { place.start + before.len() - 1 } else { place.at };
    let text = match (operator, operand.parse::<u128>()) {
        (Some('+'), _) => format!("- {operand}"),
        (Some(_), _) => format!("+ {operand}"),
        (None, Ok(0)) => "0".to_owned(),
        (None, Ok(number)) => format!("not {}", number - 1),
        (None, Err(_)) => format!("0 - {operand}"),
    };
    let follows_sign = before.ends_with(['*', '<', '>', '&', '|', '^']) || operand.is_empty();
    let instead = (!follows_sign).then(|| (place.span(start, end), text));
    Some(wording::sign(instead, place.here()))
}

fn width_of_constant(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let before = place.before();
    let open = before.strip_suffix(')').and_then(|inside| inside.rfind('(')).filter(|_| place.found == "'")?;
    let sum = brief(&before[open + 1..before.len() - 1]);
    let constant = &place.after()[1..];
    let constant = &constant[..constant.find(|c| !is_word(c)).unwrap_or(constant.len())];
    let digits = constant.trim_start_matches(['b', 'd', 'h']);
    let is_zero = sum != "…" && !digits.is_empty() && digits.bytes().all(|digit| digit == b'0');
    let zero = is_zero.then(|| place.span(place.start + open, place.at + 1 + constant.len()));
    Some(wording::width_of_constant(sum, brief(digits), zero, place.here()))
}

fn nets_in_braces(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let close = place.after().find('}')?;
    let assigned = place.after()[close + 1..].trim_start();
    if place.found != "{" || !place.in_body() || !assigned.starts_with('=') || assigned.starts_with("==") {
        return None;
    }
    let names: Vec<&str> = place.after()[1..close].split(',').map(str::trim).collect();
    let bits = names.iter().rev().enumerate().map(|(bit, name)| format!("{name} = t[{bit}]"));
    let bits: Vec<String> = bits.collect::<Vec<_>>().into_iter().rev().take(4).collect();
    Some(wording::nets_in_braces(brief(&names.join(", ")), &bits, place.here()))
}

fn space_before_operands(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let before = place.before().trim_end();
    let open = if place.found == "(" { place.at } else { place.start + opening(before.strip_suffix(')')?)? };
    let head = &place.text[place.start..open];
    let callee = head.trim_end_matches([' ', '\t']);
    let name = last_word(callee).1;
    if name.is_empty() || callee.len() == head.len() || RESERVED.contains(&name) || !place.in_body() {
        return None;
    }
    let close = place.text[open..place.end].find(')').map_or(place.end, |close| open + close + 1);
    let span = place.span(place.start + callee.len(), open);
    Some(wording::space_before_operands(name, brief(&place.text[open..close]), span))
}

fn opening(inside: &str) -> Option<usize> {
    let mut depth = 0;
    inside.bytes().enumerate().rev().find_map(|(at, byte)| {
        match byte {
            b')' => depth += 1,
            b'(' if depth == 0 => return Some(at),
            b'(' => depth -= 1,
            _ => {}
        }
        None
    })
}

fn misspelled_operator(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let operator = |word| suggest::nearest(word, BETWEEN);
    let (word, start, near) = match place.word_before() {
        Some((word, start, line)) if ends_operand(line) && operator(word).is_some() => (word, start, operator(word)?),
        _ if place.wants(&[Rule::operator]) && ends_operand(place.before().trim_end()) => {
            (place.found, place.at, operator(place.found)?)
        }
        _ => return None,
    };
    if !place.in_body() || RESERVED.contains(&word) {
        return None;
    }
    Some(wording::misspelled_operator(word, near, place.span(start, start + word.len())))
}

fn missing_operator(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let (word, start, line) = place.word_before()?;
    let drives = place.wants(&[Rule::index, Rule::slip_arrow]) && place.in_body();
    (drives && ends_operand(line) && line.contains('=') && !RESERVED.contains(&word))
        .then(|| wording::missing_operator(word, place.span(start, start + word.len())))
}

fn space_in_pattern(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let is_pattern = |word: &str| !word.is_empty() && word.bytes().all(|byte| matches!(byte, b'0' | b'1' | b'-'));
    let in_table = place.kind == PartKind::TableRow;
    let rest = place.after();
    let pattern = &rest[..rest.find([':', ',', '}', '\n']).unwrap_or(rest.len())];
    let words: Vec<&str> = pattern.split_whitespace().collect();
    let before = place.before().trim_end();
    let first = before.rsplit(|c: char| !matches!(c, '0' | '1' | '-')).next().unwrap_or_default();
    (in_table && is_pattern(first) && !words.is_empty() && words.iter().all(|word| is_pattern(word))).then(|| {
        let start = place.start + before.len() - first.len();
        let whole = place.span(start, place.at + pattern.trim_end().len());
        wording::space_in_pattern(place.found, &format!("{first}{}", words.concat()), whole, place.here())
    })
}

fn missing_comma(place: &SlipPlace<'_>) -> Option<Diagnostic> {
    let (_, bracket) = place.inside()?;
    let follows = ends_operand(place.before().trim_end()) && place.found.starts_with(is_word);
    let close = match bracket {
        b'(' => ')',
        b'[' => ']',
        _ => return None,
    };
    (follows && !place.wants(&[Rule::operator, Rule::size_infix])).then(|| {
        let before = place.word_before().map(|(word, at, _)| (word, place.span(at, at + word.len())));
        wording::missing_comma(before, place.found, close, place.here())
    })
}
