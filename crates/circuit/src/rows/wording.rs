//! What can be wrong with rows of a file.

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Suggestion, counted};
use nbc_base::source::Span;

/// The most errors that are reported of a file.
pub(super) const MOST_ERRORS: usize = 20;

/// A file that has no rows for a circuit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RowFileError {
    /// A file without a line.
    Empty,
    /// A file that begins with numbers.
    NoHeader,
    /// A file that ends after the names of its columns.
    NoRows,
    /// A column without a name.
    Unnamed,
    /// A name that is too long.
    LongName { bytes: usize },
    /// Two columns of a name.
    Twice { name: String, first: Span },
    /// More or fewer values than columns.
    Width { values: usize, columns: usize },
    /// A cell that is no number.
    NotANumber { word: String, column: String },
    /// A number of too many bits.
    Wide { column: String, bits: usize },
    /// Too many rows.
    TooManyRows,
    /// Too many bits in all rows.
    TooManyBits,
    /// Rows of a PLA that stand for too many.
    OpenInputs { open: usize },
    /// A PLA that says where outputs are 1, of too many inputs to list the others.
    OnesOnly { inputs: usize },
    /// A column that is not a port.
    NoPort { column: String, circuit: String, meant: Suggestion },
    /// A port with no column, or without some of its bits.
    NoColumn { port: String, circuit: String },
    /// A port and a bit of it.
    BitAndPort { port: String },
    /// A value that does not fit into its port.
    Unfitting { port: String, width: usize },
    /// An input without a value.
    OpenInput { port: String },
    /// An output that no column has.
    NoOutput { output: String, meant: Suggestion },
    /// A file whose columns are all outputs.
    NoInputs,
}

impl RowFileError {
    /// The error of a name that is not in the file.
    pub(super) fn without_place(self) -> Diagnostic {
        match self {
            Self::NoOutput { output, meant } => {
                let message = format!("the file has no columns for the output `{output}`");
                Diagnostic::without_place(Code::Unknown, message).with_suggestion(None, &meant)
            }
            other => unreachable!("{other:?} has a place"),
        }
    }

    /// The error at its place.
    pub(super) fn at(self, span: Span) -> Diagnostic {
        let error = |code, message: &str, label: &str| Diagnostic::new(code, message, span, label);
        match self {
            Self::Empty => error(Code::Empty, "file has no columns", "expected names of columns between commas"),
            Self::NoHeader => {
                error(Code::Value, "file has no names of columns", "expected the names of ports before the first row")
                    .with_help("write a first line such as `a,b,q`")
            }
            Self::NoRows => error(Code::Empty, "file has no rows", "expected a line of values after the names"),
            Self::Unnamed => {
                error(Code::Value, "column has no name", "expected the name of a port, such as `a` or `a[0]`")
            }
            Self::LongName { bytes } => error(
                Code::TooLarge,
                &format!("name of {bytes} bytes is too long"),
                &format!("expected at most {}", Limit::FileNameBytes.most()),
            ),
            Self::Twice { name, first } => {
                error(Code::Duplicate, &format!("column `{name}` is there twice"), "again here")
                    .with_related(first, "first here")
            }
            Self::Width { values, columns } => error(
                Code::RowWidth,
                &format!("row has {} for {}", counted(values, "value"), counted(columns, "column")),
                "expected a value for each column",
            ),
            Self::NotANumber { word, column } => error(
                Code::Value,
                &format!("`{word}` is not a value of `{column}`"),
                "expected a whole number such as 5 or 0x1f, or `-` for any",
            ),
            Self::Wide { column, bits } => error(
                Code::TooLarge,
                &format!("value of `{column}` has {bits} bits"),
                &format!("expected at most {}, four for each hexadecimal digit", Limit::Width.most()),
            ),
            Self::TooManyRows => error(
                Code::TooLarge,
                &format!("file has more than {} rows", Limit::Rows.most()),
                "the limit is reached here",
            ),
            Self::TooManyBits => error(
                Code::TooLarge,
                &format!("the rows of the file have more than {} bits", Limit::RowBits.most()),
                "the limit is reached here",
            ),
            Self::OpenInputs { open } => error(
                Code::TooLarge,
                &format!("row leaves {} open", counted(open, "input")),
                &format!("expected at most {}, because all of their values are rows", Limit::TriedBits.most()),
            ),
            Self::OnesOnly { inputs } => error(
                Code::TooLarge,
                &format!("a PLA of this type describes all rows of {}", counted(inputs, "input")),
                &format!("expected at most {} inputs, or the type `fr` or `fdr`", Limit::TriedBits.most()),
            ),
            Self::NoPort { column, circuit, meant } => error(
                Code::Unknown,
                &format!("`{circuit}` has no port for the column `{column}`"),
                "expected the name of a port or of a bit of one",
            )
            .with_suggestion(None, &meant),
            Self::NoColumn { port, circuit } => error(
                Code::RowWidth,
                &format!("file has no column for `{port}` of `{circuit}`"),
                "expected it among these columns",
            )
            .with_help(format!("name a column `{port}`, or columns for each of its bits, such as `{port}[0]`")),
            Self::BitAndPort { port } => error(
                Code::Duplicate,
                &format!("columns have `{port}` and its bits"),
                "expected either the port or all of its bits",
            ),
            Self::Unfitting { port, width } => error(
                Code::OutOfRange,
                &format!("row has a value that does not fit into `{port}`"),
                &format!("expected a value of {}", counted(width, "bit")),
            ),
            Self::OpenInput { port } => error(
                Code::Value,
                &format!("row has no value for the input `{port}`"),
                "expected a value in each column of an input",
            ),
            Self::NoInputs => error(Code::Value, "no column is an input", "expected a column of an input, too"),
            Self::NoOutput { .. } => unreachable!("it is a name of an option"),
        }
    }
}
