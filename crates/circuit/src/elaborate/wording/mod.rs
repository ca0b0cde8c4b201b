//! Messages about widths, bits and drivers.

mod tables;

pub(super) use tables::{missing_row, no_rows, overlap, too_many_bits, too_many_rows, uneven, wide_number};
pub use tables::{not_a_pattern, two_else};

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Fix, Label, Suggestion, counted, suggest};
use nbc_base::source::Span;

fn bits(width: impl Into<u64>) -> String {
    counted(width.into() as usize, "bit")
}

pub(super) struct OperandText {
    pub(super) width: u32,
    pub(super) span: Span,
    pub(super) net: Option<String>,
    pub(super) constant: Option<u128>,
}

impl OperandText {
    fn resized(&self, to: u32) -> Option<String> {
        let value = self.constant.filter(|value| to >= u128::BITS || value >> to == 0)?;
        Some(if to == 1 { value.to_string() } else { format!("{to}'d{value}") })
    }

    fn widened(&self, to: u32) -> String {
        let net = self.net.as_deref().unwrap_or("…");
        let zeros = format!("`{{{}'d0, {net}}}`", to - self.width);
        match self.width {
            1 => format!("repeat the bit with `{{{to}{{{net}}}}}`, or prepend zeros with {zeros}"),
            _ => format!("prepend zeros with {zeros}"),
        }
    }

    fn narrowed(&self, to: u32) -> String {
        let bits = if to == 1 { "0".to_owned() } else { format!("{}..0", to.saturating_sub(1)) };
        match &self.net {
            Some(net) => format!("select some of its bits with `{net}[{bits}]`"),
            None => format!("name the value, `t = …`, and select some of its bits with `t[{bits}]`"),
        }
    }
}

pub(super) fn wrong_width(what: &str, expected: u32, found: &OperandText, target: Option<Span>) -> Diagnostic {
    let message = format!("{what} is {} wide, expected {}", bits(found.width), bits(expected));
    let help = if found.width > expected { found.narrowed(expected) } else { found.widened(expected) };
    let error = Diagnostic::new(Code::Width, message, found.span, bits(found.width));
    let error = with_resized(error, found, found.resized(expected), help);
    target.into_iter().fold(error, |error, target| error.with_label(target, bits(expected)))
}

pub(super) fn wide_condition(found: &OperandText) -> Diagnostic {
    let (net, width) = (found.net.as_deref().unwrap_or("…"), found.width);
    Diagnostic::new(
        Code::Width,
        format!("the condition is {} wide, expected 1 bit", bits(width)),
        found.span,
        bits(width),
    )
    .with_help(format!("test all bits, any bit or a value: `all({net})`, `any({net})`, `{net} == {width}'d3`"))
}

pub(super) fn unequal(what: &str, first: &OperandText, second: &OperandText) -> Diagnostic {
    let message = format!("{what} are {} and {} wide", bits(first.width), bits(second.width));
    let (narrow, wide) = if first.width < second.width { (first, second) } else { (second, first) };
    let (widened, narrowed) = (narrow.widened(wide.width), wide.narrowed(narrow.width));
    let help = match narrow.width {
        1 => widened,
        _ => format!("for the narrow one, {widened}; for the wide one, {narrowed}"),
    };
    let error = Diagnostic::new(Code::Width, message, second.span, bits(second.width))
        .with_label(first.span, bits(first.width));
    match second.resized(first.width) {
        None => with_resized(error, first, first.resized(second.width), help),
        resized => with_resized(error, second, resized, help),
    }
}

fn with_resized(error: Diagnostic, operand: &OperandText, resized: Option<String>, help: String) -> Diagnostic {
    match resized {
        Some(text) => error.with_help(format!("write `{text}`")).with_fix(Fix::replace(operand.span, text)),
        None => error.with_help(help),
    }
}

pub(super) fn unknown_width(net: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::UnknownWidth, format!("the width of `{net}` is unknown"), at, "this net")
        .with_help(format!("declare it: `net {net}` for one bit, `net {net}[8]` for eight"))
}

pub(super) fn number_without_width(value: u128, at: Span) -> Diagnostic {
    let constant = format!("{}'d{value}", (u128::BITS - value.leading_zeros()).max(1));
    let message = format!("the width of `{value}` is unknown");
    Diagnostic::new(Code::UnknownWidth, message, at, "nothing beside it has a width")
        .with_help(format!("write it with its width: `{constant}`"))
        .with_fix(Fix::replace(at, constant))
}

pub(super) fn unknown_parameter(circuit: &str, parameter: &str, at: Span) -> Diagnostic {
    let message = format!("the parameter `{parameter}` of `{circuit}` is unknown");
    Diagnostic::new(Code::UnknownWidth, message, at, "used here")
        .with_help(format!("give its value: `{circuit}[{parameter} = 8]`"))
}

pub(super) fn pattern_width(found: usize, expected: usize, at: Span) -> Diagnostic {
    let label = format!("expected {}, found {}", bits(expected as u64), bits(found as u64));
    Diagnostic::new(Code::RowWidth, "the pattern is not as wide as the table's inputs", at, label)
}

pub(super) fn driven_again(net: &str, first: Option<Span>, at: Span) -> Diagnostic {
    let message = format!("`{net}` is driven more than once");
    let error = Diagnostic::new(Code::MultipleDrivers, message, at, "driven again here")
        .with_help("a net has one driver; choose between values with `if c then a else b`");
    first.into_iter().fold(error, |error, first| error.with_label(first, "driven here"))
}

pub(super) fn undriven(bits: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Undriven, format!("nothing drives `{bits}`"), at, "declared here")
        .with_help(format!("drive it: `{bits} = …`"))
}

pub(super) fn driven_by_itself(net: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Undriven, format!("`{net}` is driven only by itself"), at, "declared here")
        .with_help("a loop needs a gate")
}

pub(super) fn other_start(net: &str, at: Span) -> Diagnostic {
    let message = format!("`{net}` cannot have this start value");
    Diagnostic::new(Code::StartValue, message, at, "the memory that drives it starts with another value")
        .with_help("remove the `init`, or let the circuit with the memory take its start value as a parameter")
}

pub(super) fn no_start(nets: &[String], at: Span) -> Diagnostic {
    let message = format!("the loop through {} has no start value", suggest::alternatives(nets, "and"));
    Diagnostic::new(Code::LoopWithoutStart, message, at, "this net feeds back on itself")
        .with_help(format!("give one of its nets a start value: `{} init 0 = …`", nets[0]))
}

/// A value up to `most` that selects one of `count` bits, or words.
pub(super) fn index_outside(net: &str, count: u32, most: u64, is_word: bool, at: Span) -> Diagnostic {
    let part = if is_word { "word" } else { "bit" };
    let message = format!("this value can select a {part} that `{net}` does not have");
    let label = format!("it can be {most}, but the last {part} is {}", count - 1);
    let help = if is_word {
        format!("declare {} words: outside, words are 0, and nothing is written", most + 1)
    } else {
        let missing = most + 1 - u64::from(count);
        format!("if 0 is meant for the others, say so: select from `{{{missing}'d0, {net}}}`")
    };
    Diagnostic::new(Code::IndexOutside, message, at, label).with_help(help)
}

pub(super) fn too_deep(at: Span) -> Diagnostic {
    let message = format!("circuits are nested more than {} levels deep", Limit::Hierarchy.most());
    Diagnostic::new(Code::Nesting, message, at, "the limit is reached here")
}

pub(super) fn too_large(circuit: &str, count: u64, limit: Limit, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` needs {count} {}", limit.things());
    Diagnostic::new(Code::TooLarge, message, at, format!("expected at most {}", limit.most()))
}

pub(super) fn too_many_turns(statements: u64, at: Span) -> Diagnostic {
    let message = format!("the loop makes {statements} statements and turns");
    Diagnostic::new(Code::TooLarge, message, at, format!("expected at most {}", Limit::Statements.most()))
}

fn out_of_range(message: impl Into<String>, at: Span, label: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, message, at, label)
}

pub(super) fn overflow(at: Span) -> Diagnostic {
    out_of_range("number cannot be computed", at, "too large, or a division by zero")
}

pub(super) fn net_width(width: i128, at: Span) -> Diagnostic {
    let label = format!("expected 1 to {}", Limit::Width.most());
    out_of_range(format!("a width of {width} bits is out of range"), at, label)
}

/// A slice that begins with its lowest bit; `is_literal` where both ends are written as digits.
pub(super) fn ascending_slice(net: &str, [first, last]: [i128; 2], is_literal: bool, at: Span) -> Diagnostic {
    let message = format!("the slice `{first}..{last}` is in ascending order");
    out_of_range(message, at, "expected the highest bit first")
        .with_help(format!("write `{net}[{last}..{first}]`"))
        .with_fix(is_literal.then(|| Fix::replace(at, format!("{last}..{first}"))))
}

pub(super) fn descending_loop([first, last]: [i128; 2], is_literal: bool, at: Span) -> Diagnostic {
    out_of_range(format!("the loop from {first} to {last} makes no turn"), at, "expected the lower end first")
        .with_help(format!("a loop counts up, and leaves out its end: `{last}..{first}`"))
        .with_fix(is_literal.then(|| Fix::replace(at, format!("{last}..{first}"))))
}

pub(super) fn no_such_bit(net: &str, bit: i128, width: u32, at: Span) -> Diagnostic {
    let help = match width {
        1 => format!("it has a single bit, `{net}`"),
        _ => format!("its bits are 0 to {}", width - 1),
    };
    out_of_range(format!("`{net}` has no bit {bit}"), at, format!("`{net}` is {} wide", bits(width))).with_help(help)
}

pub(super) fn no_such_word(net: &str, word: i128, words: u32, at: Span) -> Diagnostic {
    let label = format!("`{net}` has {}", counted(words as usize, "word"));
    out_of_range(format!("`{net}` has no word {word}"), at, label)
        .with_help(format!("its words are 0 to {}", words - 1))
}

pub(super) fn start_value(value: i128, width: u32, at: Span) -> Diagnostic {
    let label = match width {
        0..63 => format!("expected 0 to {}", (1i64 << width) - 1),
        _ => "expected 0 or more".to_owned(),
    };
    out_of_range(format!("the start value {value} does not fit into {}", bits(width)), at, label)
}

pub(super) fn negative_constant(value: i128, at: Span) -> Diagnostic {
    out_of_range(format!("the constant {value} is negative"), at, "expected 0 or more")
}

pub(super) fn constant_width(value: u128, width: u32, at: Span) -> Diagnostic {
    let message = format!("the constant {value} does not fit into {}", bits(width));
    let needed = u128::BITS - value.leading_zeros();
    out_of_range(message, at, format!("expected at most {}", (1u128 << width) - 1))
        .with_help(format!("it needs {}: `{needed}'d{value}`", bits(needed)))
}

pub(super) fn repetitions(times: i128, at: Span) -> Diagnostic {
    let label = format!("expected 0 or more, and at most {} in all", bits(Limit::Width.most()));
    out_of_range(format!("a value cannot be repeated {times} times"), at, label)
}

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
