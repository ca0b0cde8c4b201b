//! Rows of tests, simulations and schedules, and their values.

use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Code, Diagnostic, Fix, counted, suggest};
use nbc_base::source::Span;

const SHOWN: usize = 16;

/// `meant` is how the value is written in this language.
pub(crate) fn not_a_value(word: &NameSyntax, meant: Option<String>) -> Diagnostic {
    let label = "expected bits such as `0`, `1`, `0110`, or `4'd6`";
    let error = Diagnostic::new(Code::Value, format!("`{}` is not a value", word.text), word.span, label);
    match meant {
        Some(meant) => error.with_help(format!("write `{meant}`")).with_fix(Fix::replace(word.span, meant)),
        None => error.with_help("`-` stands for any value, `^` for a clock pulse: 0, then 1"),
    }
}

pub(crate) fn wide_pulse(column: &str, width: usize, at: Span) -> Diagnostic {
    let message = format!("`^` pulses a single bit, but `{column}` has {width}");
    Diagnostic::new(Code::Value, message, at, "expected a value of all bits")
        .with_help(format!("write a number with its width, for example `{width}'d0`"))
}

/// `meant` is how the value is written in this language, `number` how digits of 0 and 1 are written as a number.
pub(crate) fn value_width(
    found: &str,
    column: &str,
    width: usize,
    [meant, number]: [Option<String>; 2],
    at: Span,
) -> Diagnostic {
    let label = format!("expected {}, found {found}", counted(width, "bit"));
    let error = Diagnostic::new(Code::Width, format!("wrong width of a value for `{column}`"), at, label);
    match (meant, number) {
        (Some(meant), _) => error.with_help(format!("write `{meant}`")).with_fix(Fix::replace(at, meant)),
        (None, Some(number)) => error.with_help(format!("digits of 0 and 1 are bits; as a number it is `{number}`")),
        (None, None) => {
            let bits = "0".repeat(width.min(SHOWN));
            let bits = if width > SHOWN { String::new() } else { format!(" for example `{bits}`,") };
            error.with_help(format!("write every bit,{bits} or a number with its width, for example `{width}'d0`"))
        }
    }
}

pub(crate) fn unfitting(value: u128, width: usize, at: Span) -> Diagnostic {
    let message = format!("`{value}` does not fit into {}", counted(width, "bit"));
    Diagnostic::new(Code::OutOfRange, message, at, format!("expected at most {}", (1u128 << width) - 1))
}

pub(crate) fn large_value(at: Span) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, "value is too large", at, "expected at most 128 bits")
        .with_help("write every bit, for example `0110`")
}

pub(crate) fn not_a_stimulus(word: &NameSyntax) -> Diagnostic {
    let message = format!("`{}` is not a stimulus value", word.text);
    Diagnostic::new(Code::Value, message, word.span, "expected `0` or `1`")
}

pub(crate) fn not_an_input(word: &NameSyntax) -> Diagnostic {
    let message = format!("`{}` is not an input value", word.text);
    Diagnostic::new(Code::Value, message, word.span, "expected `0` or `1`")
}

pub(crate) fn pulsed_output(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Value, "an output cannot be pulsed", at, "expected `0`, `1` or `-`")
}

pub(crate) fn row_width(values: usize, columns: usize, at: Span) -> Diagnostic {
    let message = format!("row has {} for {}", counted(values, "value"), counted(columns, "column"));
    Diagnostic::new(Code::RowWidth, message, at, format!("expected {}", counted(columns, "value")))
}

pub(crate) fn empty_schedule(schedule: &NameSyntax) -> Diagnostic {
    let message = format!("the schedule `{}` has no rows", schedule.text);
    Diagnostic::new(Code::Empty, message, schedule.span, "expected a row in this schedule")
        .with_help("add a row: `0 1 for 10 cycles`")
}

pub(crate) fn empty_test(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Empty, "test has no rows", at, "expected a row after the header")
        .with_help("add rows with a value for each column, and `|` between inputs and outputs")
}

pub(crate) fn missing_inputs(inputs: &[&str], circuit: &str, at: Span) -> Diagnostic {
    let names = suggest::alternatives(inputs, "and");
    let message = format!("the test gives no values for {names} of `{circuit}`");
    Diagnostic::new(Code::MissingField, message, at, format!("expected columns for {names}"))
        .with_help("every input needs a column")
}

pub(crate) fn missing_input(input: &str, at: Span) -> Diagnostic {
    let message = format!("the schedule gives no values for the input `{input}`");
    Diagnostic::new(Code::MissingField, message, at, format!("expected a column for `{input}`"))
}

pub(crate) fn part_of_cycle(schedule: &str, at: Span) -> Diagnostic {
    let message = format!("the schedule `{schedule}` has times that are not whole cycles");
    Diagnostic::new(Code::Unit, message, at, "expected whole cycles, between which a swarm's inputs change")
}

pub(crate) fn two_bars(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, "row has more than one `|`", at, "unexpected `|`")
}

pub(crate) fn no_bar(at: Span) -> Diagnostic {
    Diagnostic::new(Code::Syntax, "row has no `|`", at, "expected `|` between inputs and outputs")
        .with_help("write it where the header has it")
}

pub(crate) fn bar_elsewhere(inputs: usize, at: Span) -> Diagnostic {
    let label = format!("expected after {}", counted(inputs, "value"));
    Diagnostic::new(Code::RowWidth, "`|` is in a different place than in the header", at, label)
}

pub(crate) fn input_without_value(input: &str, at: Span) -> Diagnostic {
    let message = format!("the input `{input}` has no value");
    Diagnostic::new(Code::Value, message, at, "expected `0` or `1` for an input, found `-`")
}

pub(crate) fn given_input(input: &NameSyntax) -> Diagnostic {
    let message = format!("the environment gives the input `{}`", input.text);
    Diagnostic::new(Code::RowWidth, message, input.span, "expected no column for it").with_help("remove the column")
}

pub(crate) fn no_times(text: &str, at: Span) -> Diagnostic {
    let message = format!("rows cannot be repeated {text} times");
    Diagnostic::new(Code::OutOfRange, message, at, "expected a number from 1")
}

pub(crate) fn many_rows(most: u64, at: Span) -> Diagnostic {
    Diagnostic::new(Code::TooLarge, "the test has too many rows", at, format!("expected at most {most}"))
}

pub(crate) fn until_without_value(output: &NameSyntax) -> Diagnostic {
    let NameSyntax { text: name, span } = output;
    let help = format!("write the value that ends the repetition: `until {name} = 5, at most 100 rows`");
    Diagnostic::new(Code::Value, format!("`{name}` has several bits"), *span, "expected a value").with_help(help)
}

// ---- environments of tests ----

pub(crate) fn no_environment(circuit: &NameSyntax) -> Diagnostic {
    let NameSyntax { text: name, span } = circuit;
    let message = format!("`{name}` is a circuit, not an environment");
    Diagnostic::new(Code::Unknown, message, *span, "expected an environment")
        .with_help(format!("declare it so: `environment {name}(…) -> (…) {{ … }}`"))
}

pub(crate) fn environment_width(port: &str, own: usize, other: usize, at: Span) -> Diagnostic {
    let message = format!("the port `{port}` of the environment has another width than that of the circuit");
    let label = format!("{} instead of {}", counted(own, "bit"), counted(other, "bit"));
    Diagnostic::new(Code::Width, message, at, label)
}

pub(crate) fn environment_port(port: &str, circuit: &str, at: Span) -> Diagnostic {
    let message = format!("the environment needs `{port}`, which `{circuit}` does not give");
    Diagnostic::new(Code::Unknown, message, at, "expected an output or another input of the circuit")
}

pub(crate) fn rows_from_file(circuit: &str, at: Span) -> Diagnostic {
    let message = format!("the rows of a test of `{circuit}` with an environment cannot be from a file");
    Diagnostic::new(Code::NoEffect, message, at, "expected a table of rows")
}
