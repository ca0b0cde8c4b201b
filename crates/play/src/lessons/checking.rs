//! The checks of steps: `keeps a=1 q=0`, `robots <= 5`, `tests pass`, and so on.

use super::piece::Piece;
use super::wording::{BAD_NUMBER, INCOMPLETE, Mistaken, NO_VALUE, PORT_TWICE, TOO_MUCH, UNKNOWN_GATE, UNKNOWN_WORD};
use crate::message::{CALLS, LessonCheck, LessonComparison, LessonCount, PortValues};
use nbc_base::model::Function;

pub(super) const CHECKS: [&str; 17] = [
    "shows",
    "hides",
    "keeps",
    "has-shown",
    "designs",
    "robots",
    "cycles",
    "niches",
    "threads",
    "without",
    "circuit",
    "tests",
    "claims",
    "program",
    "outputs",
    "evolving",
    "niche",
];

const OPERATORS: [&str; 15] =
    ["not", "and", "or", "xor", "nand", "nor", "xnor", "if", "match", "table", "+", "-", "*", "==", CALLS];

/// Adds the ports that the check names to `ports`.
pub(super) fn check<'a>(text: Piece<'a>, ports: &mut Vec<Piece<'a>>) -> Result<LessonCheck, Mistaken> {
    let words = text.words();
    let Some((&first, rest)) = words.split_first() else {
        return Err(INCOMPLETE.at(text));
    };
    let after = Piece { text: &text.text[first.at + first.text.len() - text.at..], at: first.at + first.text.len() };
    match first.text {
        "shows" => Ok(LessonCheck::Shows { values: values(first, rest, ports)? }),
        "keeps" => Ok(LessonCheck::Keeps { values: values(first, rest, ports)? }),
        "hides" => Ok(LessonCheck::Hides { patterns: patterns(first, after, ports)? }),
        "has-shown" => Ok(LessonCheck::HasShown { patterns: patterns(first, after, ports)? }),
        "designs" => designs(first, rest),
        "robots" if rest.first().is_some_and(|word| word.text == "only") => {
            let gates = some(first, &rest[1..])?.iter().map(|&word| gate(word)).collect::<Result<_, _>>()?;
            Ok(LessonCheck::RobotsOnly { gates })
        }
        "robots" => counts(LessonCount::Robots, first, rest),
        "cycles" => counts(LessonCount::Cycles, first, rest),
        "niches" => counts(LessonCount::Niches, first, rest),
        "threads" => counts(LessonCount::Threads, first, rest),
        "without" => {
            let words = some(first, rest)?.iter().map(|&word| one_of(word, &OPERATORS)).collect::<Result<_, _>>()?;
            Ok(LessonCheck::Without { words })
        }
        "circuit" => Ok(LessonCheck::Circuit { name: single(first, rest)?.text.to_owned() }),
        "tests" => match one_of(single(first, rest)?, &["pass", "fail", "kept"])?.as_str() {
            "pass" => Ok(LessonCheck::TestsPass),
            "fail" => Ok(LessonCheck::TestsFail),
            _ => Ok(LessonCheck::TestsKept),
        },
        "claims" => match one_of(single(first, rest)?, &["proved", "refuted"])?.as_str() {
            "proved" => Ok(LessonCheck::ClaimsProved),
            _ => Ok(LessonCheck::ClaimsRefuted),
        },
        "program" => one_of(single(first, rest)?, &["changed"]).map(|_| LessonCheck::ProgramChanged),
        "outputs" => one_of(single(first, rest)?, &["lit"]).map(|_| LessonCheck::OutputsLit),
        "niche" => one_of(single(first, rest)?, &["chosen"]).map(|_| LessonCheck::NicheChosen),
        "evolving" => match rest.first() {
            None => Ok(LessonCheck::Evolving),
            Some(&more) => Err(TOO_MUCH.at(more)),
        },
        _ => Err(UNKNOWN_WORD.at(first).known(CHECKS)),
    }
}

fn some<'a, 'b>(first: Piece<'_>, rest: &'b [Piece<'a>]) -> Result<&'b [Piece<'a>], Mistaken> {
    if rest.is_empty() { Err(INCOMPLETE.at(first)) } else { Ok(rest) }
}

fn single<'a>(first: Piece<'_>, rest: &[Piece<'a>]) -> Result<Piece<'a>, Mistaken> {
    match some(first, rest)? {
        [word] => Ok(*word),
        more => Err(TOO_MUCH.at(more[1])),
    }
}

pub(super) fn one_of(word: Piece<'_>, known: &[&'static str]) -> Result<String, Mistaken> {
    if known.contains(&word.text) {
        return Ok(word.text.to_owned());
    }
    Err(UNKNOWN_WORD.at(word).known(known))
}

fn patterns<'a>(first: Piece<'_>, after: Piece<'a>, ports: &mut Vec<Piece<'a>>) -> Result<Vec<PortValues>, Mistaken> {
    let patterns = after.split(|letter| letter == ',');
    patterns.into_iter().map(|pattern| values(first, &pattern.words(), ports)).collect()
}

pub(super) fn values<'a>(
    first: Piece<'_>,
    words: &[Piece<'a>],
    ports: &mut Vec<Piece<'a>>,
) -> Result<PortValues, Mistaken> {
    let mut values = PortValues::new();
    for &word in some(first, words)? {
        let (port, value) = word.split_once('=').ok_or(NO_VALUE.at(word))?;
        let number = number(value.text).ok_or(BAD_NUMBER.at(value))?;
        if !is_name(port.text) {
            return Err(NO_VALUE.at(word));
        }
        if values.insert(port.text.to_owned(), number).is_some() {
            return Err(PORT_TWICE.at(port));
        }
        ports.push(port);
    }
    Ok(values)
}

fn is_name(text: &str) -> bool {
    text.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == '_')
        && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}

/// A number: decimal, or binary or hexadecimal after `0b` or `0x`.
fn number(text: &str) -> Option<u32> {
    let digits = |digits: &str, base| {
        let are = digits.bytes().all(|byte| byte.is_ascii_alphanumeric());
        if are { u32::from_str_radix(digits, base).ok() } else { None }
    };
    match text.get(..2) {
        Some("0b") => digits(&text[2..], 2),
        Some("0x") => digits(&text[2..], 16),
        _ => digits(text, 10),
    }
}

fn designs(first: Piece<'_>, rest: &[Piece<'_>]) -> Result<LessonCheck, Mistaken> {
    let except = rest.first().is_some_and(|word| word.text == "except");
    let gate = gate(single(first, &rest[usize::from(except)..])?)?;
    Ok(LessonCheck::Designs { gate, except })
}

fn gate(word: Piece<'_>) -> Result<String, Mistaken> {
    match Function::parse(word.text) {
        Some(function) => Ok(function.name().to_owned()),
        None => Err(UNKNOWN_GATE.at(word).known(Function::named().map(Function::name))),
    }
}

fn counts(what: LessonCount, first: Piece<'_>, rest: &[Piece<'_>]) -> Result<LessonCheck, Mistaken> {
    let [sign, amount] = match some(first, rest)? {
        [sign, amount] => [*sign, *amount],
        [_] => return Err(INCOMPLETE.at(first)),
        more => return Err(TOO_MUCH.at(more[2])),
    };
    let than = match one_of(sign, &["<=", ">=", "="])?.as_str() {
        "<=" => LessonComparison::AtMost,
        ">=" => LessonComparison::AtLeast,
        _ => LessonComparison::Equal,
    };
    let number = number(amount.text).ok_or(BAD_NUMBER.at(amount))?;
    Ok(LessonCheck::Counts { what, than, number })
}
