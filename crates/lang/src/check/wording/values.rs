//! Fields of records and their values.

use std::fmt;

use crate::check::applies::Fact;
use nbc_base::diag::{Code, Diagnostic, Fix, Suggestion, suggest};
use nbc_base::source::Span;

/// What a record declares; a record inside another has no name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Record {
    pub(crate) kind: &'static str,
    pub(crate) name: Option<String>,
}

impl fmt::Display for Record {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.name {
            Some(name) => write!(f, "the {} `{name}`", self.kind),
            None => write!(f, "a {}", self.kind),
        }
    }
}

/// A record with the wrong fields.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FieldError {
    /// A required field that is missing.
    Missing { record: Record, field: &'static str, example: &'static str },
    /// A field that this kind of record does not have.
    Unknown { record: Record, field: String, known: Vec<&'static str>, meant: Suggestion },
    /// A field that nothing uses, because it needs one of these facts.
    NoEffect { record: Record, field: String, with: &'static [Fact] },
}

impl FieldError {
    /// The error at the record's name, or at the field's.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Missing { record, field, example } => {
                let label = format!("expected a field `{field}`");
                Diagnostic::new(Code::MissingField, format!("{record} has no `{field}`"), span, label)
                    .with_help(format!("add `{example}`"))
            }
            Self::Unknown { record, field, known, meant } => {
                let message = format!("{record} has no field `{field}`");
                let error = Diagnostic::new(Code::UnknownField, message, span, "unknown field");
                match meant {
                    Suggestion::Near(_) => error.with_suggestion(span, &meant),
                    _ => error.with_help(format!("its fields are {}", suggest::alternatives(&known, "and"))),
                }
            }
            Self::NoEffect { record, field, with } => {
                let fact = |(field, word): &Fact| match *word {
                    "" => (*field).to_owned(),
                    word => format!("{field}: {word}"),
                };
                let facts: Vec<String> = with.iter().map(fact).collect();
                let facts = suggest::alternatives(&facts, "or");
                let message = format!("`{field}` has no effect in {record}");
                let write = if with.iter().all(|(_, word)| word.is_empty()) { "add" } else { "write" };
                Diagnostic::new(Code::NoEffect, message, span, format!("used only with {facts}"))
                    .with_help(format!("remove it, or {write} {facts}"))
            }
        }
    }
}

/// The valid values of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Expected {
    /// A name of that kind.
    Name(&'static str),
    /// One of these words.
    OneOf(Vec<&'static str>),
    /// The origin of a library's robots.
    Origin,
    /// A function or a behavior.
    Behavior,
    Robot,
    /// An axis of an archive.
    Axis,
    /// The elites that a niche keeps.
    Niche,
    /// The hold of rows.
    Hold,
    /// A width and a height.
    Box,
    /// A lower and an upper end.
    Range,
    /// A time, as in this example.
    Time(&'static str),
    /// A number with any unit.
    Quantity,
    /// A number without a unit.
    Number,
    /// A number without a unit, or in percent.
    Ratio,
    /// A number in percent.
    Percent,
    /// The weight of a mutation.
    Weight,
    /// The weights of mutations.
    Weights,
    /// The largest changes of worlds.
    Changes,
    /// The ground of a world.
    Ground,
    /// A file.
    Path,
    /// What images are.
    Label,
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Name(kind) => return write!(f, "the name of a {kind}"),
            Self::OneOf(words) => return f.write_str(&suggest::alternatives(words, "or")),
            Self::Time(example) => return write!(f, "a time such as `{example}`"),
            Self::Origin => "`shipped`, `three`, the name of an evolution or a folder in quotes",
            Self::Robot => "the name of a robot",
            Self::Behavior => "a function such as `nand`, or a behavior such as `RRRL`",
            Self::Axis => "`voxels in 4 bins`, `active in 4 bins`, `sensory in 4 bins` or `behavior`",
            Self::Niche => "`dominance` or `pareto(8)`",
            Self::Hold => "`auto` or a time such as `12 cycles`",
            Self::Box => "a box in voxels such as `5 x 5`",
            Self::Range => "a range such as `0.6..1.6`",
            Self::Quantity => "a number with its unit",
            Self::Number => "a number",
            Self::Ratio => "a number such as `0.9` or `90%`",
            Self::Percent => "a number in percent such as `93%`",
            Self::Weight => "a weight",
            Self::Changes => "changes such as `{ friction: 10%, gravity: 5% }`",
            Self::Ground => "heights such as `[0, 1, 2]`, or a file in quotes",
            Self::Path => "a file in quotes such as `\"digits.csv\"`",
            Self::Label => "a label such as `0` or `zero`",
            Self::Weights => "weights such as `{ add_node: 1, change_weight: 2 }`",
        })
    }
}

/// The valid numbers; `unit` is what they count, or empty.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Bounds {
    /// Any whole number.
    Whole { unit: &'static str },
    /// A whole number of at least `least`.
    From { least: u32, unit: &'static str },
    /// A whole number from `least` to `most`.
    Between { least: u32, most: u32, unit: &'static str },
    /// A whole number of at most `most`.
    Seed { most: u64 },
    /// A real number from `least` to `most`.
    Real { least: f64, most: f64 },
    /// A smaller number.
    Smaller,
}

impl fmt::Display for Bounds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let after = |unit: &str| if unit.is_empty() { String::new() } else { format!(" {unit}") };
        match self {
            Self::Whole { unit: "" } => f.write_str("a whole number"),
            Self::Whole { unit } => write!(f, "a whole number of {unit}"),
            Self::From { least, unit } => write!(f, "{least} or more{}", after(unit)),
            Self::Between { least, most, unit } => write!(f, "{least} to {most}{}", after(unit)),
            Self::Seed { most } => write!(f, "a whole number from 0 to {most}"),
            Self::Real { least, most } => write!(f, "{least} to {most}"),
            Self::Smaller => f.write_str("a smaller number"),
        }
    }
}

/// A value that is invalid in its field.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ValueError {
    /// A value of another kind.
    WrongKind { expected: Expected },
    /// A word that is not one of the choices.
    UnknownChoice { found: String, expected: Expected, meant: Suggestion },
    /// A list without entries.
    EmptyList { field: &'static str },
    /// A list with more entries than there may be.
    LongList { field: &'static str, entries: usize, most: usize },
    /// A number that needs a unit.
    MissingUnit { number: String, wanted: Vec<&'static str> },
    /// A number with a unit of something else.
    WrongUnit { number: String, unit: String, wanted: Vec<&'static str>, meant: Suggestion },
    /// A unit of a number that has none.
    UnexpectedUnit { number: String, unit: String },
    /// A number out of range.
    OutOfRange { found: String, expected: Bounds },
    /// A width of a voxel out of range.
    WidthOutOfRange { found: f64, least: f64, most: f64 },
    /// A range whose lower end comes last.
    Descending { high: f64, low: f64 },
    /// An integer of more than 32 bits.
    TooLarge { bits: u32 },
    /// A member of an enumeration whose value is too wide for an integer.
    WideMember { member: String },
    /// A parameter that is not written in digits.
    NotANumber,
}

impl ValueError {
    /// The error at the value, or at its unit.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::WrongKind { expected } => {
                Diagnostic::new(Code::Value, "wrong kind of value", span, format!("expected {expected}"))
            }
            Self::UnknownChoice { found, expected, meant } => {
                Diagnostic::new(Code::Value, format!("invalid value `{found}`"), span, format!("expected {expected}"))
                    .with_suggestion(span, &meant)
            }
            Self::EmptyList { field } => {
                let message = format!("`{field}` is an empty list");
                Diagnostic::new(Code::OutOfRange, message, span, "expected at least one entry")
            }
            Self::LongList { field, entries, most } => {
                let message = format!("`{field}` is a list of {entries} entries");
                Diagnostic::new(Code::OutOfRange, message, span, format!("expected {most} at most"))
            }
            Self::MissingUnit { number, wanted } => {
                let after = Span { start: span.end, ..span };
                let error = Diagnostic::new(Code::Unit, format!("`{number}` has no unit"), span, units(&wanted));
                with_unit(error, &number, &wanted, Fix::insert(after, format!(" {}", wanted[0])))
            }
            Self::WrongUnit { number, unit, wanted, meant } => {
                let error = Diagnostic::new(Code::Unit, format!("wrong unit `{unit}`"), span, units(&wanted));
                match meant {
                    Suggestion::Near(_) => error.with_suggestion(span, &meant),
                    _ => with_unit(error, &number, &wanted, Fix::replace(span, wanted[0])),
                }
            }
            Self::UnexpectedUnit { number, unit } => {
                let message = format!("unexpected unit `{unit}`");
                let error = Diagnostic::new(Code::Unit, message, span, "expected a number without a unit");
                // It is not known what the share of another number means here.
                if unit == "%" {
                    return error;
                }
                error.with_help(format!("write `{number}`")).with_fix(Fix::remove(span, "the unit"))
            }
            Self::OutOfRange { found, expected } => out_of_range(&found, &expected, span),
            Self::WidthOutOfRange { found, least, most } => {
                out_of_range(&found.to_string(), &Bounds::Real { least, most }, span)
                    .with_help("actuation is given as a share of the width at rest")
            }
            Self::Descending { high, low } => {
                let (message, range) = ("the range is in descending order", format!("{low}..{high}"));
                Diagnostic::new(Code::OutOfRange, message, span, "expected the lower end first")
                    .with_help(format!("write `{range}`"))
                    .with_fix(Fix::replace(span, range))
            }
            Self::TooLarge { bits } => {
                Diagnostic::new(Code::OutOfRange, "number is too large", span, format!("expected at most {bits} bits"))
            }
            Self::WideMember { member } => {
                let message = format!("the value of `{member}` is too large for a number");
                Diagnostic::new(Code::OutOfRange, message, span, "expected at most 127 bits")
            }
            Self::NotANumber => Diagnostic::new(Code::Value, "parameter is not a number", span, "expected a number"),
        }
    }
}

fn units(wanted: &[&str]) -> String {
    format!("expected {}", suggest::alternatives(wanted, "or"))
}

/// The fix is certain only if there is a single possible unit.
fn with_unit(error: Diagnostic, number: &str, wanted: &[&str], fix: Fix) -> Diagnostic {
    error.with_help(format!("write `{number} {}`", wanted[0])).with_fix((wanted.len() == 1).then_some(fix))
}

fn out_of_range(found: &str, expected: &Bounds, span: Span) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, format!("`{found}` is out of range"), span, format!("expected {expected}"))
}
