//! Rows of tests, simulations and schedules, and their values.

use nbc_base::diag::{Code, Diagnostic, Fix, counted, suggest};
use nbc_base::source::Span;

/// The most bits of an example of a value.
const SHOWN: usize = 16;

/// A value that is invalid in its column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum CellError {
    /// Neither bits nor a constant.
    NotAValue { word: String, meant: Option<String> },
    /// A pulse on a column of several bits.
    WidePulse { column: String, width: usize },
    /// A value that is not as wide as its column.
    Width { found: String, column: String, width: usize, meant: Option<String>, number: Option<String> },
    /// A number that does not fit into its width.
    Unfitting { value: u128, width: usize },
    /// A number of too many bits.
    TooLarge,
    /// Neither 0 nor 1 in a schedule of stimuli.
    NotAStimulus { word: String },
    /// An input without a definite value.
    NotAnInput { word: String },
    /// A pulse on an output.
    PulsedOutput,
}

impl CellError {
    /// The error at the value.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::NotAValue { word, meant } => {
                let label = "expected bits such as `0`, `1`, `0110`, or `4'd6`";
                let error = Diagnostic::new(Code::Value, format!("`{word}` is not a value"), span, label);
                let general = "`-` stands for any value, `^` for a clock pulse: 0, then 1";
                written_so(error, span, meant).unwrap_or_else(|error| error.with_help(general))
            }
            Self::WidePulse { column, width } => {
                let message = format!("`^` pulses a single bit, but `{column}` has {width}");
                Diagnostic::new(Code::Value, message, span, "expected a value of all bits")
                    .with_help(format!("write a number with its width, for example `{width}'d0`"))
            }
            Self::Width { found, column, width, meant, number } => {
                let label = format!("expected {}, found {found}", counted(width, "bit"));
                let message = format!("wrong width of a value for `{column}`");
                let error = Diagnostic::new(Code::Width, message, span, label);
                written_so(error, span, meant).unwrap_or_else(|error| {
                    error.with_help(match number {
                        Some(number) => format!("digits of 0 and 1 are bits; as a number it is `{number}`"),
                        None => example_of(width),
                    })
                })
            }
            Self::Unfitting { value, width } => {
                let message = format!("`{value}` does not fit into {}", counted(width, "bit"));
                Diagnostic::new(Code::OutOfRange, message, span, format!("expected at most {}", (1u128 << width) - 1))
            }
            Self::TooLarge => {
                Diagnostic::new(Code::OutOfRange, "value is too large", span, "expected at most 128 bits")
                    .with_help("write every bit, for example `0110`")
            }
            Self::NotAStimulus { word } => {
                Diagnostic::new(Code::Value, format!("`{word}` is not a stimulus value"), span, "expected `0` or `1`")
            }
            Self::NotAnInput { word } => {
                Diagnostic::new(Code::Value, format!("`{word}` is not an input value"), span, "expected `0` or `1`")
            }
            Self::PulsedOutput => {
                Diagnostic::new(Code::Value, "an output cannot be pulsed", span, "expected `0`, `1` or `-`")
            }
        }
    }
}

/// The error with how the value is written; without that, the error as it was.
fn written_so(error: Diagnostic, span: Span, meant: Option<String>) -> Result<Diagnostic, Diagnostic> {
    match meant {
        Some(meant) => Ok(error.with_help(format!("write `{meant}`")).with_fix(Fix::replace(span, meant))),
        None => Err(error),
    }
}

/// How a value of that width is written.
fn example_of(width: usize) -> String {
    let number = format!("a number with its width, for example `{width}'d0`");
    if width > SHOWN {
        format!("write every bit, or {number}")
    } else {
        format!("write every bit, for example `{}`, or {number}", "0".repeat(width))
    }
}

/// A row, or a table of rows, of the wrong shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum RowError {
    /// More or fewer values than columns.
    Width { values: usize, columns: usize },
    /// A schedule without rows.
    EmptySchedule { schedule: String },
    /// A test without rows.
    EmptyTest,
    /// A test without columns for some inputs.
    MissingInputs { inputs: Vec<String>, circuit: String },
    /// A simulation without a column for an input.
    MissingInput { input: String },
    /// A schedule of stimuli with times that are not whole cycles.
    PartOfCycle { schedule: String },
    /// A second `|`.
    TwoBars,
    /// No `|`.
    NoBar,
    /// `|` in another place than in the header.
    BarElsewhere { inputs: usize },
    /// `-` for an input.
    InputWithoutValue { input: String },
    /// A column of an input that the environment gives.
    GivenInput { input: String },
    /// Rows that are repeated no times, or a number of times that is too large.
    NoTimes { text: String },
    /// Too many rows.
    TooManyRows { most: u64 },
    /// A row that is repeated until an output of several bits has no value that is given.
    UntilWithoutValue { output: String },
}

impl RowError {
    /// The error at the row, the header or the bar.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Width { values, columns } => {
                let message = format!("row has {} for {}", counted(values, "value"), counted(columns, "column"));
                Diagnostic::new(Code::RowWidth, message, span, format!("expected {}", counted(columns, "value")))
            }
            Self::EmptySchedule { schedule } => {
                let message = format!("the schedule `{schedule}` has no rows");
                Diagnostic::new(Code::Empty, message, span, "expected a row in this schedule")
                    .with_help("add a row: `0 1 for 10 cycles`")
            }
            Self::EmptyTest => {
                Diagnostic::new(Code::Empty, "test has no rows", span, "expected a row after the header")
                    .with_help("add rows with a value for each column, and `|` between inputs and outputs")
            }
            Self::MissingInputs { inputs, circuit } => {
                let names = suggest::alternatives(&inputs, "and");
                let message = format!("the test gives no values for {names} of `{circuit}`");
                Diagnostic::new(Code::MissingField, message, span, format!("expected columns for {names}"))
                    .with_help("every input needs a column")
            }
            Self::MissingInput { input } => {
                let message = format!("the schedule gives no values for the input `{input}`");
                Diagnostic::new(Code::MissingField, message, span, format!("expected a column for `{input}`"))
            }
            Self::PartOfCycle { schedule } => {
                let message = format!("the schedule `{schedule}` has times that are not whole cycles");
                let label = "expected whole cycles, between which a swarm's inputs change";
                Diagnostic::new(Code::Unit, message, span, label)
            }
            Self::TwoBars => Diagnostic::new(Code::Syntax, "row has more than one `|`", span, "unexpected `|`"),
            Self::NoBar => {
                Diagnostic::new(Code::Syntax, "row has no `|`", span, "expected `|` between inputs and outputs")
                    .with_help("write it where the header has it")
            }
            Self::BarElsewhere { inputs } => {
                let label = format!("expected after {}", counted(inputs, "value"));
                Diagnostic::new(Code::RowWidth, "`|` is in a different place than in the header", span, label)
            }
            Self::InputWithoutValue { input } => {
                let message = format!("the input `{input}` has no value");
                Diagnostic::new(Code::Value, message, span, "expected `0` or `1` for an input, found `-`")
            }
            Self::GivenInput { input } => {
                let message = format!("the environment gives the input `{input}`");
                Diagnostic::new(Code::RowWidth, message, span, "expected no column for it")
                    .with_help("remove the column")
            }
            Self::NoTimes { text } => {
                let message = format!("rows cannot be repeated {text} times");
                Diagnostic::new(Code::OutOfRange, message, span, "expected a number from 1")
            }
            Self::TooManyRows { most } => {
                Diagnostic::new(Code::TooLarge, "the test has too many rows", span, format!("expected at most {most}"))
            }
            Self::UntilWithoutValue { output } => {
                let message = format!("`{output}` has several bits");
                Diagnostic::new(Code::Value, message, span, "expected a value").with_help(format!(
                    "write the value that ends the repetition: `until {output} = 5, at most 100 rows`"
                ))
            }
        }
    }
}

/// An environment that does not fit the circuit of a test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum EnvironmentError {
    /// A circuit that is none.
    NoEnvironment { circuit: String },
    /// A port with another width than that of the circuit.
    Width { port: String, widths: [usize; 2] },
    /// An input that is neither an output of the circuit nor an input with a column.
    NoPort { port: String, circuit: String },
    /// A test whose rows are from a file.
    RowsFromFile { circuit: String },
}

impl EnvironmentError {
    /// The error at the name of the environment.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::NoEnvironment { circuit } => {
                let message = format!("`{circuit}` is a circuit, not an environment");
                Diagnostic::new(Code::Unknown, message, span, "expected an environment")
                    .with_help(format!("declare it so: `environment {circuit}(…) -> (…) {{ … }}`"))
            }
            Self::Width { port, widths: [own, other] } => {
                let message =
                    format!("the port `{port}` of the environment has another width than that of the circuit");
                let label = format!("{} instead of {}", counted(own, "bit"), counted(other, "bit"));
                Diagnostic::new(Code::Width, message, span, label)
            }
            Self::NoPort { port, circuit } => {
                let message = format!("the environment needs `{port}`, which `{circuit}` does not give");
                Diagnostic::new(Code::Unknown, message, span, "expected an output or another input of the circuit")
            }
            Self::RowsFromFile { circuit } => {
                let message = format!("the rows of a test of `{circuit}` with an environment cannot be from a file");
                Diagnostic::new(Code::NoEffect, message, span, "expected a table of rows")
            }
        }
    }
}
