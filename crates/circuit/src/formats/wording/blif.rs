//! BLIF files: their lines, then their models.

use nbc_base::diag::{Code, Diagnostic};
use nbc_base::source::Span;

/// A line of BLIF that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BlifError {
    /// A file without models.
    NoModel,
    /// External don't-cares.
    DontCares,
    /// A second model of a name.
    ModelTwice { model: String },
    /// A directive outside of a model.
    BeforeModel { directive: String },
    /// A directive without all its words.
    Incomplete { directive: &'static str, expected: &'static str },
    /// A cell of a library.
    LibraryCell { directive: String },
    /// A directive that BLIF does not have, or that is not supported.
    UnknownDirective { directive: String },
    /// A start value of a net that is neither 0 nor 1.
    NetStart { found: String },
    /// A line that is neither a directive nor a row.
    NotADirective { found: String },
    /// A row without its two words.
    MalformedRow,
    /// A row that is not as wide as its inputs.
    RowWidth { expected: usize, found: String },
    /// A row with another output than 0 or 1.
    RowOutput { found: String },
    /// Rows with the outputs 0 and 1.
    MixedRows,
}

impl BlifError {
    /// The message and the label.
    pub(super) fn words(self) -> (String, String) {
        let fixed = |message: &str, label: &str| (message.to_owned(), label.to_owned());
        match self {
            Self::NoModel => fixed("no `.model` in this BLIF file", "expected `.model`"),
            Self::DontCares => fixed("external don't-cares are ignored", "up to the end of the model"),
            Self::ModelTwice { model } => fixed(&format!("model `{model}` is defined twice"), "defined again here"),
            Self::BeforeModel { directive } => {
                fixed(&format!("`{directive}` before `.model`"), "expected `.model` first")
            }
            Self::Incomplete { directive, expected } => fixed(&format!("`{directive}` is incomplete"), expected),
            Self::LibraryCell { directive } => fixed(
                &format!("`{directive}` names a cell of a library that is not in the file"),
                "expected its function, written with `.names`",
            ),
            Self::UnknownDirective { directive } => {
                fixed(&format!("unknown BLIF directive `{directive}`"), "not supported")
            }
            Self::NetStart { found } => fixed(&format!("invalid start value `{found}` of a net"), "expected 0 or 1"),
            Self::NotADirective { found } => fixed(
                &format!("`{found}` is not a directive"),
                "expected a directive such as `.names`, or a row after one",
            ),
            Self::MalformedRow => fixed("malformed row", "expected the digits of the inputs and of the output"),
            Self::RowWidth { expected, found } => fixed(
                "row has the wrong width",
                &format!("expected {expected} digits `0`, `1` or `-`, found `{found}`"),
            ),
            Self::RowOutput { found } => {
                fixed("row has an invalid output", &format!("expected `0` or `1`, found `{found}`"))
            }
            Self::MixedRows => {
                fixed("rows have different outputs", "expected the same output in all rows of a `.names`")
            }
        }
    }
}

/// A model that cannot be expanded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ModelError {
    /// Models that are nested too deeply.
    ModelDepth { most: u64 },
    /// Models that take too much memory when they are expanded.
    ModelSize,
    /// A start value that a latch does not have.
    LatchStart { found: String },
    /// A kind that a latch does not have.
    LatchKind { found: String },
    /// A latch without a clock.
    NoClock { latch: String, input: String },
    /// A model that the file does not have.
    MissingModel { model: String },
    /// A model that contains itself.
    RecursiveModel { model: String },
    /// A connection without `=`.
    NotAConnection { found: String },
    /// A port that the model does not have.
    UnknownPort { model: String, port: String },
    /// A port with two nets.
    ConnectedTwice { port: String },
    /// An input without a net.
    Unconnected { model: String, port: String },
}

impl ModelError {
    /// The error at its place.
    pub fn at(self, span: Span) -> Diagnostic {
        let damaged = |message: String, label: &str| Diagnostic::new(Code::CircuitFile, message, span, label);
        match self {
            Self::ModelDepth { most } => {
                damaged(format!("models are nested more than {most} levels deep"), "the limit is reached here")
            }
            Self::ModelSize => {
                damaged("the circuit is too large once its models are expanded".to_owned(), "the limit is reached here")
            }
            Self::LatchStart { found } => {
                let message = format!("invalid start value `{found}` of a latch");
                damaged(message, "expected 0, 1, 2 (any) or 3 (unknown)")
            }
            Self::LatchKind { found } => {
                damaged(format!("invalid kind `{found}` of a latch"), "expected re, fe, ah or al")
            }
            Self::NoClock { latch, input } => {
                let help = format!("write `.latch {input} {latch} re clk 0` or `.clock clk`, or pass `--clock clk`");
                damaged(format!("latch `{latch}` has no clock"), "expected a clock").with_help(help)
            }
            Self::MissingModel { model } => {
                damaged(format!("model `{model}` is missing"), "expected its `.model` in the file")
            }
            Self::RecursiveModel { model } => damaged(format!("model `{model}` contains itself"), "instantiated here"),
            Self::NotAConnection { found } => damaged(format!("`{found}` is not a connection"), "expected `port=net`"),
            Self::UnknownPort { model, port } => {
                damaged(format!("model `{model}` has no port `{port}`"), "connected here")
            }
            Self::ConnectedTwice { port } => {
                damaged(format!("port `{port}` is connected twice"), "connected again here")
            }
            Self::Unconnected { model, port } => {
                let message = format!("input `{port}` of model `{model}` is not connected");
                damaged(message, &format!("expected `{port}=net`"))
            }
        }
    }
}
