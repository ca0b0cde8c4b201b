//! AIGER files.

use std::fmt;

use nbc_base::diag::{Code, Diagnostic, counted};

/// A place in a file. Gates of a binary file have no lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AigerPlace {
    /// A line, from 1.
    Line(usize),
    /// A byte, from 0.
    Byte(usize),
}

impl fmt::Display for AigerPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// An AIGER file that cannot be read; `found` is the text of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AigerError {
    /// An unexpected end of the file.
    EndOfFile,
    /// Bytes that are not text.
    NotText,
    /// A first word other than `aag` and `aig`.
    NotAiger { found: String },
    /// A header with a word that is not a number.
    Header { found: String },
    /// A header with a wrong number of numbers.
    HeaderNumbers { found: usize },
    /// Properties, of which circuits have none.
    Property { what: &'static str, number: usize },
    /// Properties of infinite runs.
    Liveness { what: &'static str, number: usize },
    /// A model without outputs and bad states.
    NoProperties,
    /// A number of the header above the limit.
    TooLarge { number: usize, most: u64 },
    /// Too many ports or latches.
    TooManyPorts { most: u64 },
    /// Numbers of the header that do not add up.
    Sum { inputs: usize, latches: usize, ands: usize, variables: usize, binary: bool },
    /// A header that announces more than the file contains.
    TooShort { outputs: usize, ands: usize },
    /// A line with a word that is not a number.
    NotNumbers { found: String },
    /// A port with a wrong number of literals.
    PortLiterals { what: &'static str, found: usize },
    /// A latch with a wrong number of literals.
    Latch,
    /// A latch with an invalid start value.
    LatchStart { latch: usize, start: usize },
    /// A gate with a wrong number of literals.
    GateLiterals { found: usize },
    /// A gate that does not come after its inputs.
    GateOrder { gate: usize },
    /// A number of too many bytes.
    LongNumber,
    /// A line after the gates that is not a symbol.
    Symbol { found: String },
    /// A name for a port or latch that does not exist.
    UnknownSymbol { found: String },
    /// An input or latch whose literal is inverted, constant or taken.
    NotAnInput { literal: usize },
    /// A gate whose literal is inverted, constant or taken.
    NotAGate { literal: usize },
    /// A literal with two gates.
    DefinedTwice { literal: usize },
    /// A literal without a definition.
    Undriven { literal: usize },
    /// A literal above the number of variables in the header.
    OverHeader { literal: usize },
    /// A literal on a loop.
    Loop { literal: usize },
}

impl AigerError {
    /// The error at its place in the file.
    pub fn at(self, place: AigerPlace) -> Diagnostic {
        let message = match self {
            Self::EndOfFile => "unexpected end of file".to_owned(),
            Self::NotText => "expected text".to_owned(),
            Self::NotAiger { found } => format!("expected `aag` or `aig`, found `{found}`"),
            Self::Header { found } => format!("expected a header such as `aag 3 2 0 1 1`, found `{found}`"),
            Self::HeaderNumbers { found } => format!("expected five to nine numbers in the header, found {found}"),
            Self::Property { what, number } => {
                format!("{what} are not part of a circuit, and the header has {number}; `nbc prove` reads them")
            }
            Self::Liveness { what, number } => {
                format!("{what} are not supported, and the header has {number}: they are about runs without an end")
            }
            Self::NoProperties => "no properties: expected bad states, or outputs in their place".to_owned(),
            Self::TooLarge { number, most } => format!("expected at most {most} variables, found {number}"),
            Self::TooManyPorts { most } => format!("expected at most {most} inputs and {most} latches"),
            Self::Sum { inputs, latches, ands, variables, binary } => {
                let relation = if binary { "must equal" } else { "exceed" };
                let [inputs, latches, gates, variables] =
                    [(inputs, "input"), (latches, "latch"), (ands, "gate"), (variables, "variable")]
                        .map(|(count, noun)| counted(count, noun));
                format!("{inputs}, {latches} and {gates} {relation} the {variables} of the header")
            }
            Self::TooShort { outputs, ands } => {
                format!("the file is too short for {} and {}", counted(outputs, "output"), counted(ands, "gate"))
            }
            Self::NotNumbers { found } => format!("expected numbers, found `{found}`"),
            Self::PortLiterals { what, found } => format!("expected one literal for {what}, found {found}"),
            Self::Latch => "expected a latch: its literal, its next literal and an optional start value".to_owned(),
            Self::LatchStart { latch, start } => {
                format!("expected the start value 0, 1 or {latch} (any) of a latch, found {start}")
            }
            Self::GateLiterals { found } => format!("expected three literals of a gate, found {found}"),
            Self::GateOrder { gate } => format!("the inputs of gate {gate} are not smaller literals"),
            Self::LongNumber => "expected a number of at most 35 bits".to_owned(),
            Self::Symbol { found } => format!("expected a symbol such as `i0 name`, found `{found}`"),
            Self::UnknownSymbol { found } => format!("`{found}` names no input, output or latch"),
            Self::NotAnInput { literal } => format!("literal {literal} cannot be an input or a latch"),
            Self::NotAGate { literal } => format!("literal {literal} cannot be a gate"),
            Self::DefinedTwice { literal } => format!("literal {literal} is defined twice"),
            Self::Undriven { literal } => format!("nothing drives literal {literal}"),
            Self::OverHeader { literal } => format!("literal {literal} is larger than the header allows"),
            Self::Loop { literal } => format!("literal {literal} depends on itself"),
        };
        Diagnostic::without_place(Code::CircuitFile, format!("{message}, {place} of the AIGER file"))
    }
}
