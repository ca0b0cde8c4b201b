//! BLIF, .bench and PLA files, read as named nets in any order.

use crate::formats::wording::{BenchError, BlifError, ModelError, PlaError};
use nbc_base::diag::{Code, Diagnostic};
use nbc_base::source::Span;

/// A text that does not describe a circuit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextError {
    /// A line of BLIF that cannot be read.
    Blif(BlifError),
    /// A model of BLIF that cannot be expanded.
    Model(ModelError),
    /// A line of .bench that cannot be read.
    Bench(BenchError),
    /// A line of a PLA that cannot be read.
    Pla(PlaError),
    /// A name that is too long.
    LongName { bytes: usize, most: u64 },
    /// A circuit with too many gates.
    TooLarge { most: u64 },
    /// Too many other things.
    TooMany { what: &'static str, most: u64 },
    /// A net with two gates.
    DefinedTwice { net: String, first: Span },
    /// A clock that is neither an input nor a register.
    LogicClock { clock: String, register: String },
    /// A latch whose enable is neither an input nor a register.
    LogicEnable { latch: String },
    /// An input or register with a gate.
    DrivenTwice { net: String },
    /// A net without a definition.
    Undefined { net: String },
    /// A net on a loop without a start value.
    Loop { net: String },
}

impl From<BlifError> for TextError {
    fn from(error: BlifError) -> Self {
        Self::Blif(error)
    }
}

impl From<ModelError> for TextError {
    fn from(error: ModelError) -> Self {
        Self::Model(error)
    }
}

impl From<BenchError> for TextError {
    fn from(error: BenchError) -> Self {
        Self::Bench(error)
    }
}

impl From<PlaError> for TextError {
    fn from(error: PlaError) -> Self {
        Self::Pla(error)
    }
}

impl TextError {
    /// The error at its place.
    pub fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Blif(error) => worded(error.words(), span),
            Self::Model(error) => error.at(span),
            Self::Bench(error) => worded(error.words(), span),
            Self::Pla(error) => worded(error.words(), span),
            Self::TooLarge { most } => {
                let message = format!("the circuit has more than {most} pins of gates");
                Diagnostic::new(Code::TooLarge, message, span, "the limit is reached here")
            }
            Self::TooMany { what, most } => {
                let message = format!("the file has more than {most} {what}");
                Diagnostic::new(Code::TooLarge, message, span, "the limit is reached here")
            }
            Self::DefinedTwice { net, first } => {
                damaged(format!("`{net}` is defined twice"), span, "defined again here")
                    .with_related(first, "first defined here")
            }
            Self::Loop { net } => damaged(format!("`{net}` depends on itself"), span, "this closes the loop")
                .with_help(
                    "feedback needs a start value: `.attr init 0` after its `.names` in BLIF, `(* init = 1'b0 *)` \
                     before its instance in Verilog (docs/compiler.md, \"Exchange formats\")",
                ),
            Self::LongName { bytes, most } => {
                damaged(format!("name of {bytes} bytes is too long"), span, format!("expected at most {most}"))
            }
            Self::LogicClock { clock, register } => {
                let message = format!("the clock `{clock}` of `{register}` is driven by logic");
                damaged(message, span, "expected an input or a register as clock")
            }
            Self::LogicEnable { latch } => {
                let message = format!("`{latch}` is a latch, and logic computes when it is open");
                damaged(message, span, "it keeps its value wherever nothing sets it").with_help(
                    "set it in every case, such as by a value before the first `if`; a latch must be opened by an \
                     input or a register",
                )
            }
            Self::DrivenTwice { net } => {
                let label = "an input or a register cannot have another driver";
                damaged(format!("`{net}` is driven twice"), span, label)
            }
            Self::Undefined { net } => damaged(format!("`{net}` is used but not defined"), span, "used here"),
        }
    }
}

fn worded((message, label): (String, String), span: Span) -> Diagnostic {
    damaged(message, span, label)
}

fn damaged(message: impl Into<String>, span: Span, label: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::CircuitFile, message, span, label)
}
