//! Fields of records and their values.

use crate::check::record_fields::Fact;
use nbc_base::diag::{Code, Diagnostic, Fix, Suggestion, suggest};
use nbc_base::source::Span;

pub(crate) const AXIS: &str = "`voxels in 4 bins`, `active in 4 bins`, `sensory in 4 bins` or `behavior`";
pub(crate) const BEHAVIOR: &str = "a function such as `nand`, or a behavior such as `RRRL`";
pub(crate) const BOX: &str = "a box in voxels such as `5 x 5`";
pub(crate) const CHANGES: &str = "changes such as `{ friction: 10%, gravity: 5% }`";
pub(crate) const GROUND: &str = "heights such as `[0, 1, 2]`, or a file in quotes";
pub(crate) const HOLD: &str = "`auto` or a time such as `12 cycles`";
pub(crate) const LABEL: &str = "a label such as `0` or `zero`";
pub(crate) const NICHE: &str = "`dominance` or `pareto(8)`";
pub(crate) const NUMBER: &str = "a number";
pub(crate) const ORIGIN: &str = "`shipped`, `three`, the name of an evolution or a folder in quotes";
pub(crate) const PATH: &str = "a file in quotes such as `\"digits.csv\"`";
pub(crate) const PERCENT: &str = "a number in percent such as `93%`";
pub(crate) const QUANTITY: &str = "a number with its unit";
pub(crate) const RANGE: &str = "a range such as `0.6..1.6`";
pub(crate) const RATIO: &str = "a number such as `0.9` or `90%`";
pub(crate) const WEIGHT: &str = "a weight";
pub(crate) const WEIGHTS: &str = "weights such as `{ add_node: 1, change_weight: 2 }`";

pub(crate) fn name_of(kind: &str) -> String {
    format!("the name of a {kind}")
}

pub(crate) fn one_of(words: &[&str]) -> String {
    suggest::alternatives(words, "or")
}

pub(crate) fn time_such_as(example: &str) -> String {
    format!("a time such as `{example}`")
}

/// How messages call a record; one inside another has no name.
pub(crate) fn record(kind: &str, name: Option<&str>) -> String {
    name.map_or_else(|| format!("a {kind}"), |name| format!("the {kind} `{name}`"))
}

pub(crate) fn missing_field(record: &str, field: &str, example: &str, at: Span) -> Diagnostic {
    let label = format!("expected a field `{field}`");
    Diagnostic::new(Code::MissingField, format!("{record} has no `{field}`"), at, label)
        .with_help(format!("add `{example}`"))
}

pub(crate) fn unknown_field(record: &str, field: &str, known: &[&str], meant: &Suggestion, at: Span) -> Diagnostic {
    let message = format!("{record} has no field `{field}`");
    let error = Diagnostic::new(Code::UnknownField, message, at, "unknown field");
    match meant {
        Suggestion::Near(_) => error.with_suggestion(at, meant),
        _ => error.with_help(format!("its fields are {}", suggest::alternatives(known, "and"))),
    }
}

pub(crate) fn idle_field(record: &str, field: &str, needs: &[Fact], at: Span) -> Diagnostic {
    let fact = |(field, word): &Fact| if word.is_empty() { (*field).to_owned() } else { format!("{field}: {word}") };
    let facts = suggest::alternatives(&needs.iter().map(fact).collect::<Vec<_>>(), "or");
    let message = format!("`{field}` has no effect in {record}");
    let write = if needs.iter().all(|(_, word)| word.is_empty()) { "add" } else { "write" };
    Diagnostic::new(Code::NoEffect, message, at, format!("used only with {facts}"))
        .with_help(format!("remove it, or {write} {facts}"))
}

pub(crate) fn wrong_kind(expected: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Value, "wrong kind of value", at, format!("expected {expected}"))
}

pub(crate) fn unknown_choice(found: &str, expected: &str, meant: &Suggestion, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Value, format!("invalid value `{found}`"), at, format!("expected {expected}"))
        .with_suggestion(at, meant)
}

pub(crate) fn empty_list(field: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, format!("`{field}` is an empty list"), at, "expected at least one entry")
}

pub(crate) fn long_list(field: &str, entries: usize, most: usize, at: Span) -> Diagnostic {
    let message = format!("`{field}` is a list of {entries} entries");
    Diagnostic::new(Code::OutOfRange, message, at, format!("expected {most} at most"))
}

pub(crate) fn missing_unit(number: &str, wanted: &[&str], at: Span) -> Diagnostic {
    let after = Span { start: at.end, ..at };
    let error = Diagnostic::new(Code::Unit, format!("`{number}` has no unit"), at, units(wanted));
    with_unit(error, number, wanted, Fix::insert(after, format!(" {}", wanted[0])))
}

pub(crate) fn wrong_unit(number: &str, unit: &str, wanted: &[&str], meant: &Suggestion, at: Span) -> Diagnostic {
    let error = Diagnostic::new(Code::Unit, format!("wrong unit `{unit}`"), at, units(wanted));
    match meant {
        Suggestion::Near(_) => error.with_suggestion(at, meant),
        _ => with_unit(error, number, wanted, Fix::replace(at, wanted[0])),
    }
}

fn units(wanted: &[&str]) -> String {
    format!("expected {}", suggest::alternatives(wanted, "or"))
}

/// The fix is certain only if there is a single possible unit.
fn with_unit(error: Diagnostic, number: &str, wanted: &[&str], fix: Fix) -> Diagnostic {
    error.with_help(format!("write `{number} {}`", wanted[0])).with_fix((wanted.len() == 1).then_some(fix))
}

pub(crate) fn unexpected_unit(number: &str, unit: &str, at: Span) -> Diagnostic {
    let message = format!("unexpected unit `{unit}`");
    let error = Diagnostic::new(Code::Unit, message, at, "expected a number without a unit");
    // It is not known what the share of another number means here.
    if unit == "%" {
        return error;
    }
    error.with_help(format!("write `{number}`")).with_fix(Fix::remove(at, "the unit"))
}

fn out_of_range(found: &str, expected: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, format!("`{found}` is out of range"), at, format!("expected {expected}"))
}

/// `unit` is what the number counts, or empty.
pub(crate) fn not_whole(found: &str, unit: &str, at: Span) -> Diagnostic {
    let of = if unit.is_empty() { String::new() } else { format!(" of {unit}") };
    out_of_range(found, &format!("a whole number{of}"), at)
}

pub(crate) fn below(found: &str, least: u32, unit: &str, at: Span) -> Diagnostic {
    out_of_range(found, format!("{least} or more {unit}").trim_end(), at)
}

pub(crate) fn outside(found: &str, least: u32, most: u32, unit: &str, at: Span) -> Diagnostic {
    out_of_range(found, format!("{least} to {most} {unit}").trim_end(), at)
}

pub(crate) fn real_outside(found: f64, least: f64, most: f64, at: Span) -> Diagnostic {
    out_of_range(&found.to_string(), &format!("{least} to {most}"), at)
}

pub(crate) fn seed_outside(found: &str, at: Span) -> Diagnostic {
    out_of_range(found, &format!("a whole number from 0 to {}", u64::MAX), at)
}

pub(crate) fn infinite(found: &str, at: Span) -> Diagnostic {
    out_of_range(found, "a smaller number", at)
}

pub(crate) fn width_outside(found: f64, least: f64, most: f64, at: Span) -> Diagnostic {
    real_outside(found, least, most, at).with_help("actuation is given as a share of the width at rest")
}

pub(crate) fn descending(high: f64, low: f64, at: Span) -> Diagnostic {
    let range = format!("{low}..{high}");
    Diagnostic::new(Code::OutOfRange, "the range is in descending order", at, "expected the lower end first")
        .with_help(format!("write `{range}`"))
        .with_fix(Fix::replace(at, range))
}

pub(crate) fn large_number(bits: u32, at: Span) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, "number is too large", at, format!("expected at most {bits} bits"))
}

pub(crate) fn wide_member(member: &str, at: Span) -> Diagnostic {
    let message = format!("the value of `{member}` is too large for a number");
    Diagnostic::new(Code::OutOfRange, message, at, "expected at most 127 bits")
}

pub(crate) fn not_a_number(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Value, "parameter is not a number", at, "expected a number")
}
