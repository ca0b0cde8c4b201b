//! What can be wrong with widths, bits and drivers, as data, and how it is worded.

mod tables;

pub use tables::TableError;

use std::fmt;

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Fix, Label, Suggestion, counted, suggest};
use nbc_base::source::Span;

/// "1 bit", "8 bits".
fn bits(width: impl Into<u64>) -> String {
    counted(width.into() as usize, "bit")
}

/// A value in advice, with its name if it is a net.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct OperandText {
    pub(super) width: u32,
    pub(super) span: Span,
    pub(super) net: Option<String>,
    /// The value of a constant.
    pub(super) constant: Option<u128>,
}

impl OperandText {
    /// The constant with `to` bits, if it is one that fits.
    fn resized(&self, to: u32) -> Option<String> {
        let value = self.constant.filter(|value| to >= u128::BITS || value >> to == 0)?;
        Some(if to == 1 { value.to_string() } else { format!("{to}'d{value}") })
    }

    /// How to widen it to `to` bits.
    fn widened(&self, to: u32) -> String {
        let net = self.net.as_deref().unwrap_or("…");
        let zeros = format!("`{{{}'d0, {net}}}`", to - self.width);
        match self.width {
            1 => format!("repeat the bit with `{{{to}{{{net}}}}}`, or prepend zeros with {zeros}"),
            _ => format!("prepend zeros with {zeros}"),
        }
    }

    /// How to narrow it to `to` bits.
    fn narrowed(&self, to: u32) -> String {
        let bits = if to == 1 { "0".to_owned() } else { format!("{}..0", to.saturating_sub(1)) };
        match &self.net {
            Some(net) => format!("select some of its bits with `{net}[{bits}]`"),
            None => format!("name the value, `t = …`, and select some of its bits with `t[{bits}]`"),
        }
    }
}

/// A value that can have a wrong width.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Wide {
    /// The value that drives a net at this place.
    Value { net: String, target: Span },
    /// The condition of a choice.
    Condition,
    /// An operand of a circuit, by the name of its port.
    Operand { port: String, circuit: String },
    /// The value whose parts drive the nets at this place.
    Parts { targets: Span },
    /// The value that selects one of the words or bits of a net.
    Index { net: String, words: u32 },
}

impl fmt::Display for Wide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value { net, .. } => write!(f, "the value of `{net}`"),
            Self::Condition => f.write_str("the condition"),
            Self::Operand { port, circuit } => write!(f, "the operand `{port}` of `{circuit}`"),
            Self::Parts { .. } => f.write_str("the value whose parts are named"),
            Self::Index { net, words } => write!(f, "the value that selects one of {words} of `{net}`"),
        }
    }
}

/// Values of a wrong width, with their own places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum WidthError {
    /// A value of another width than expected.
    Wrong { what: Wide, expected: u32, found: OperandText },
    /// Operands of an operator.
    Operands { operator: &'static str, first: OperandText, second: OperandText },
    /// The two values of a choice.
    Branches { first: OperandText, second: OperandText },
    /// Two outputs of a table.
    Outputs { first: OperandText, second: OperandText },
}

impl From<WidthError> for Diagnostic {
    fn from(error: WidthError) -> Self {
        match error {
            WidthError::Wrong { what, expected, found } => wrong(&what, expected, &found),
            WidthError::Operands { operator, first, second } => {
                unequal(&format!("the operands of `{operator}`"), &first, &second)
            }
            WidthError::Branches { first, second } => unequal("the branches", &first, &second),
            WidthError::Outputs { first, second } => unequal("the outputs of the table", &first, &second),
        }
    }
}

fn wrong(what: &Wide, expected: u32, found: &OperandText) -> Diagnostic {
    let message = format!("{what} is {} wide, expected {}", bits(found.width), bits(expected));
    let resized = found.resized(expected).filter(|_| *what != Wide::Condition);
    let help = match (what, found.net.as_deref().unwrap_or("…"), found.width) {
        (Wide::Condition, net, width) => {
            format!("test all bits, any bit or a value: `all({net})`, `any({net})`, `{net} == {width}'d3`")
        }
        (_, _, width) if width > expected => found.narrowed(expected),
        _ => found.widened(expected),
    };
    let error = Diagnostic::new(Code::Width, message, found.span, bits(found.width));
    let error = with_resized(error, found, resized).unwrap_or_else(|error| error.with_help(help));
    match what {
        Wide::Value { target, .. } | Wide::Parts { targets: target } => error.with_label(*target, bits(expected)),
        _ => error,
    }
}

fn unequal(what: &str, first: &OperandText, second: &OperandText) -> Diagnostic {
    let message = format!("{what} are {} and {} wide", bits(first.width), bits(second.width));
    let (narrow, wide) = if first.width < second.width { (first, second) } else { (second, first) };
    let help = match narrow.width {
        1 => narrow.widened(wide.width),
        _ => format!(
            "for the narrow one, {}; for the wide one, {}",
            narrow.widened(wide.width),
            wide.narrowed(narrow.width)
        ),
    };
    let error = Diagnostic::new(Code::Width, message, second.span, bits(second.width))
        .with_label(first.span, bits(first.width));
    let resized = [(second, first), (first, second)].map(|(constant, other)| (constant, constant.resized(other.width)));
    match resized.into_iter().find(|(_, resized)| resized.is_some()) {
        Some((constant, resized)) => {
            with_resized(error, constant, resized).unwrap_or_else(|error| error.with_help(help))
        }
        None => error.with_help(help),
    }
}

/// The error with the constant of the width that is needed; without one, the error as it was.
fn with_resized(error: Diagnostic, operand: &OperandText, resized: Option<String>) -> Result<Diagnostic, Diagnostic> {
    match resized {
        Some(text) => Ok(error.with_help(format!("write `{text}`")).with_fix(Fix::replace(operand.span, text))),
        None => Err(error),
    }
}

/// A circuit that cannot be built as it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum ElaborateError {
    /// A pattern of a table that is not as wide as the table's inputs.
    PatternWidth { found: usize, expected: usize },
    /// A net of unknown width.
    UnknownWidth { net: String },
    /// A number without a width, where nothing else tells it.
    NumberWithoutWidth { value: u128 },
    /// A parameter of unknown value.
    UnknownParameter { circuit: String, parameter: String },
    /// A second driver; `first` is the first one's place, if it is another.
    DrivenAgain { net: String, first: Option<Span> },
    /// Bits without a driver.
    Undriven { bits: String },
    /// A loop of names without a gate.
    DrivenByItself { net: String },
    /// A net with another start value than the memory that drives it.
    OtherStart { net: String },
    /// A feedback loop without a start value.
    NoStart { nets: Vec<String> },
    /// A value up to `most` that selects one of `count` bits, or words.
    IndexOutside { net: String, count: u32, most: u64, is_word: bool },
    /// Circuits that are nested too deeply.
    TooDeep { most: u64 },
    /// A circuit that would have too much of something when it is flattened.
    TooLarge { circuit: String, count: u64, limit: Limit },
    /// A `for` that makes too many statements and turns.
    TooManyTurns { statements: u64, most: u64 },
}

impl ElaborateError {
    /// The error at its place.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::UnknownWidth { net } => {
                let message = format!("the width of `{net}` is unknown");
                Diagnostic::new(Code::UnknownWidth, message, span, "this net")
                    .with_help(format!("declare it: `net {net}` for one bit, `net {net}[8]` for eight"))
            }
            Self::NumberWithoutWidth { value } => {
                let constant = format!("{}'d{value}", (u128::BITS - value.leading_zeros()).max(1));
                let message = format!("the width of `{value}` is unknown");
                Diagnostic::new(Code::UnknownWidth, message, span, "nothing beside it has a width")
                    .with_help(format!("write it with its width: `{constant}`"))
                    .with_fix(Fix::replace(span, constant))
            }
            Self::UnknownParameter { circuit, parameter } => {
                let message = format!("the parameter `{parameter}` of `{circuit}` is unknown");
                Diagnostic::new(Code::UnknownWidth, message, span, "used here")
                    .with_help(format!("give its value: `{circuit}[{parameter} = 8]`"))
            }
            Self::PatternWidth { found, expected } => {
                let label = format!("expected {}, found {}", bits(expected as u64), bits(found as u64));
                Diagnostic::new(Code::RowWidth, "the pattern is not as wide as the table's inputs", span, label)
            }
            Self::DrivenAgain { net, first } => {
                let message = format!("`{net}` is driven more than once");
                let error = Diagnostic::new(Code::MultipleDrivers, message, span, "driven again here")
                    .with_help("a net has one driver; choose between values with `if c then a else b`");
                first.into_iter().fold(error, |error, first| error.with_label(first, "driven here"))
            }
            Self::Undriven { bits } => {
                Diagnostic::new(Code::Undriven, format!("nothing drives `{bits}`"), span, "declared here")
                    .with_help(format!("drive it: `{bits} = …`"))
            }
            Self::DrivenByItself { net } => {
                Diagnostic::new(Code::Undriven, format!("`{net}` is driven only by itself"), span, "declared here")
                    .with_help("a loop needs a gate")
            }
            Self::OtherStart { net } => {
                let message = format!("`{net}` cannot have this start value");
                Diagnostic::new(Code::StartValue, message, span, "the memory that drives it starts with another value")
                    .with_help(
                        "remove the `init`, or let the circuit with the memory take its start value as a parameter",
                    )
            }
            Self::NoStart { nets } => {
                let message = format!("the loop through {} has no start value", suggest::alternatives(&nets, "and"));
                Diagnostic::new(Code::LoopWithoutStart, message, span, "this net feeds back on itself")
                    .with_help(format!("give one of its nets a start value: `{} init 0 = …`", nets[0]))
            }
            Self::IndexOutside { net, count, most, is_word } => {
                let part = if is_word { "word" } else { "bit" };
                let message = format!("this value can select a {part} that `{net}` does not have");
                let label = format!("it can be {most}, but the last {part} is {}", count - 1);
                let help = match is_word {
                    true => format!("declare {} words: outside, words are 0, and nothing is written", most + 1),
                    false => format!(
                        "if 0 is meant for the others, say so: select from `{{{}'d0, {net}}}`",
                        most + 1 - u64::from(count)
                    ),
                };
                Diagnostic::new(Code::IndexOutside, message, span, label).with_help(help)
            }
            Self::TooDeep { most } => {
                let message = format!("circuits are nested more than {most} levels deep");
                Diagnostic::new(Code::Nesting, message, span, "the limit is reached here")
            }
            Self::TooLarge { circuit, count, limit } => {
                let message = format!("`{circuit}` needs {count} {}", limit.things());
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {}", limit.most()))
            }
            Self::TooManyTurns { statements, most } => {
                let message = format!("the loop makes {statements} statements and turns");
                Diagnostic::new(Code::TooLarge, message, span, format!("expected at most {most}"))
            }
        }
    }
}

/// A number that is too small or too large.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RangeError {
    /// A number that is too large, or divided by zero.
    Overflow,
    /// A width of a net that is below 1 or above the limit.
    NetWidth { width: i128, most: u64 },
    /// A slice that begins with its lowest bit; `is_literal` where both ends are written as digits.
    AscendingSlice { net: String, ends: [i128; 2], is_literal: bool },
    /// A loop that would have to count down; `is_literal` where both ends are written as digits.
    DescendingLoop { ends: [i128; 2], is_literal: bool },
    /// A bit that the net does not have.
    NoSuchBit { net: String, bit: i128, width: u32 },
    /// A word that the array does not have.
    NoSuchWord { net: String, word: i128, words: u32 },
    /// A start value that does not fit into its net.
    StartValue { value: i128, width: u32 },
    /// A computed constant below zero.
    NegativeConstant { value: i128 },
    /// A constant that does not fit into its width.
    ConstantWidth { value: u128, width: u32 },
    /// A value repeated a negative number of times, or to more bits than a net has.
    Repetitions { times: i128, most: u64 },
}

impl RangeError {
    /// The error at its place.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        let outside = |message: String, label: String| Diagnostic::new(Code::OutOfRange, message, span, label);
        match self {
            Self::Overflow => {
                outside("number cannot be computed".to_owned(), "too large, or a division by zero".to_owned())
            }
            Self::NetWidth { width, most } => {
                outside(format!("a width of {width} bits is out of range"), format!("expected 1 to {most}"))
            }
            Self::AscendingSlice { net, ends: [first, last], is_literal } => {
                let message = format!("the slice `{first}..{last}` is in ascending order");
                outside(message, "expected the highest bit first".to_owned())
                    .with_help(format!("write `{net}[{last}..{first}]`"))
                    .with_fix(is_literal.then(|| Fix::replace(span, format!("{last}..{first}"))))
            }
            Self::DescendingLoop { ends: [first, last], is_literal } => {
                let message = format!("the loop from {first} to {last} makes no turn");
                outside(message, "expected the lower end first".to_owned())
                    .with_help(format!("a loop counts up, and leaves out its end: `{last}..{first}`"))
                    .with_fix(is_literal.then(|| Fix::replace(span, format!("{last}..{first}"))))
            }
            Self::NoSuchBit { net, bit, width } => {
                let help = match width {
                    1 => format!("it has a single bit, `{net}`"),
                    _ => format!("its bits are 0 to {}", width - 1),
                };
                outside(format!("`{net}` has no bit {bit}"), format!("`{net}` is {} wide", bits(width))).with_help(help)
            }
            Self::NoSuchWord { net, word, words } => outside(
                format!("`{net}` has no word {word}"),
                format!("`{net}` has {}", counted(words as usize, "word")),
            )
            .with_help(format!("its words are 0 to {}", words - 1)),
            Self::StartValue { value, width } => {
                let label = match width {
                    0..63 => format!("expected 0 to {}", (1i64 << width) - 1),
                    _ => "expected 0 or more".to_owned(),
                };
                outside(format!("the start value {value} does not fit into {}", bits(width)), label)
            }
            Self::NegativeConstant { value } => {
                outside(format!("the constant {value} is negative"), "expected 0 or more".to_owned())
            }
            Self::ConstantWidth { value, width } => {
                let (message, needed) = (
                    format!("the constant {value} does not fit into {}", bits(width)),
                    u128::BITS - value.leading_zeros(),
                );
                outside(message, format!("expected at most {}", (1u128 << width) - 1))
                    .with_help(format!("it needs {}: `{needed}'d{value}`", bits(needed)))
            }
            Self::Repetitions { times, most } => {
                let label = format!("expected 0 or more, and at most {} in all", bits(most));
                outside(format!("a value cannot be repeated {times} times"), label)
            }
        }
    }
}

/// An unknown circuit that is named outside of the program.
pub(super) fn unknown_circuit(name: &str, meant: &Suggestion) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, format!("no circuit is called `{name}`")).with_suggestion(None, meant)
}

/// Shows an error at the place where its circuit is used; its place inside that circuit becomes a remark.
pub(super) fn shown_at(error: &mut Diagnostic, place: Span) {
    let inside = std::mem::replace(&mut error.labels, vec![Label { span: place, text: "used here".to_owned() }]);
    error.related.splice(0..0, inside);
    // The edits would change the file of that circuit, which the user may not own.
    error.fix = None;
}
