//! BLIF and .bench files.

use crate::diag::{Code, Diagnostic, counted};
use crate::source::Span;

/// A text that does not describe a circuit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextError {
    // ---- BLIF
    /// A file without models.
    NoModel,
    /// Models of models of models.
    ModelDepth { most: usize },
    /// Models that take too much memory in their places.
    ModelSize,
    /// Don't-cares from outside.
    DontCares,
    /// A second model of a name.
    ModelTwice { model: String },
    /// A directive that belongs into a model.
    BeforeModel { directive: String },
    /// A directive without its words.
    Incomplete { directive: &'static str, expected: &'static str },
    /// A cell of a library.
    LibraryCell { directive: String },
    /// A directive that BLIF does not have, or that is not read.
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
    // ---- .bench
    /// A file without outputs.
    NoOutput,
    /// A line that is no statement.
    NotAStatement,
    /// Nothing between two commas.
    UnnamedNet,
    /// A name with a space in it.
    SpaceInName,
    /// A gate that the format does not have, of that many nets.
    UnknownGate { gate: String, nets: usize },
    /// A port of several nets.
    PortNets { word: String, nets: usize },
    /// A gate without a net.
    Unassigned { word: String },
    // ---- both
    /// A very long name.
    LongName { bytes: usize, most: usize },
    /// More gates than are read.
    TooLarge { most: usize },
    /// A net with two gates.
    DefinedTwice { net: String, first: Span },
    /// A clock that is neither an input nor a register.
    LogicClock { clock: String, register: String },
    /// An input or register with a gate.
    DrivenTwice { net: String },
    /// A net that nothing defines.
    Undefined { net: String },
    /// A net on a loop without a start value.
    Loop { net: String },
}

impl TextError {
    /// The error at its place.
    pub fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::TooLarge { most } => {
                let message = format!("the circuit has more than {most} pins of gates");
                Diagnostic::new(Code::TooLarge, message, span, "the limit is reached here")
            }
            Self::NoClock { latch, input } => {
                let help = format!("write `.latch {input} {latch} re clk 0` or `.clock clk`, or pass `--clock clk`");
                damaged(format!("latch `{latch}` has no clock"), span, "expected a clock").with_help(help)
            }
            Self::DefinedTwice { net, first } => {
                damaged(format!("`{net}` is defined twice"), span, "defined again here")
                    .with_related(first, "first defined here")
            }
            Self::Loop { net } => damaged(format!("`{net}` depends on itself"), span, "this closes the loop")
                .with_help("feedback needs a start value: in BLIF, write `.attr init 0` after its `.names`"),
            Self::RowWidth { expected, found } => {
                let label = format!("expected {expected} digits `0`, `1` or `-`, found `{found}`");
                damaged("row has the wrong width", span, label)
            }
            Self::RowOutput { found } => {
                damaged("row has an invalid output", span, format!("expected `0` or `1`, found `{found}`"))
            }
            Self::Unconnected { model, port } => {
                let message = format!("input `{port}` of model `{model}` is not connected");
                damaged(message, span, format!("expected `{port}=net`"))
            }
            Self::LongName { bytes, most } => {
                damaged(format!("name of {bytes} bytes is too long"), span, format!("expected at most {most}"))
            }
            Self::PortNets { word, nets } => {
                let message = format!("`{word}` names {}", counted(nets, "net"));
                damaged(message, span, format!("expected `{word}(net)` for each net"))
            }
            Self::Unassigned { word } => {
                let message = format!("the value of `{word}` is not assigned to a net");
                damaged(message, span, format!("expected `net = {word}(…)`"))
            }
            error => {
                let (message, label) = error.words();
                damaged(message, span, label)
            }
        }
    }

    /// The message and the label of errors whose label is always the same.
    fn words(self) -> (String, &'static str) {
        match self {
            Self::NoModel => ("no `.model` in this BLIF file".to_owned(), "expected `.model`"),
            Self::ModelDepth { most } => {
                (format!("models are nested more than {most} levels deep"), "the limit is reached here")
            }
            Self::ModelSize => {
                ("the circuit is too large once its models are expanded".to_owned(), "the limit is reached here")
            }
            Self::DontCares => ("`.exdc` is not supported".to_owned(), "external don't-cares"),
            Self::ModelTwice { model } => (format!("model `{model}` is defined twice"), "defined again here"),
            Self::BeforeModel { directive } => (format!("`{directive}` before `.model`"), "expected `.model` first"),
            Self::Incomplete { directive, expected } => (format!("`{directive}` is incomplete"), expected),
            Self::LibraryCell { directive } => (
                format!("`{directive}` names a cell of a library that is not in the file"),
                "expected its function, written with `.names`",
            ),
            Self::UnknownDirective { directive } => (format!("unknown BLIF directive `{directive}`"), "not supported"),
            Self::NetStart { found } => (format!("invalid start value `{found}` of a net"), "expected 0 or 1"),
            Self::NotADirective { found } => {
                (format!("`{found}` is not a directive"), "expected a directive such as `.names`, or a row after one")
            }
            Self::MalformedRow => ("malformed row".to_owned(), "expected the digits of the inputs and of the output"),
            Self::MixedRows => {
                ("rows have different outputs".to_owned(), "expected the same output in all rows of a `.names`")
            }
            Self::LatchStart { found } => {
                (format!("invalid start value `{found}` of a latch"), "expected 0, 1, 2 (any) or 3 (unknown)")
            }
            Self::LatchKind { found } => (format!("invalid kind `{found}` of a latch"), "expected re, fe, ah or al"),
            Self::MissingModel { model } => {
                (format!("model `{model}` is missing"), "expected its `.model` in the file")
            }
            Self::RecursiveModel { model } => (format!("model `{model}` contains itself"), "instantiated here"),
            Self::NotAConnection { found } => (format!("`{found}` is not a connection"), "expected `port=net`"),
            Self::UnknownPort { model, port } => (format!("model `{model}` has no port `{port}`"), "connected here"),
            Self::ConnectedTwice { port } => (format!("port `{port}` is connected twice"), "connected again here"),
            Self::NoOutput => ("no `OUTPUT` in this .bench file".to_owned(), "expected `OUTPUT(net)`"),
            Self::NotAStatement => {
                ("not a statement of .bench".to_owned(), "expected `INPUT(a)`, `OUTPUT(b)` or `b = NAND(a, c)`")
            }
            Self::UnnamedNet => ("net has no name".to_owned(), "expected a name between the commas"),
            Self::SpaceInName => ("name contains a space".to_owned(), "expected a comma between names"),
            Self::UnknownGate { gate, nets } => (
                format!(".bench has no gate `{gate}` of {}", counted(nets, "net")),
                "expected AND, NAND, OR, NOR, XOR or XNOR of any nets, NOT, BUFF or DFF of one",
            ),
            Self::LogicClock { clock, register } => (
                format!("the clock `{clock}` of `{register}` is driven by logic"),
                "expected an input or a register as clock",
            ),
            Self::DrivenTwice { net } => {
                (format!("`{net}` is driven twice"), "an input or a register cannot have another driver")
            }
            Self::Undefined { net } => (format!("`{net}` is used but not defined"), "used here"),
            _ => unreachable!("the others have their words already"),
        }
    }
}

fn damaged(message: impl Into<String>, span: Span, label: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::CircuitFile, message, span, label)
}
