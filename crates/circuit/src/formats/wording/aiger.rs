//! Messages about AIGER files; `found` is a line.

use std::fmt;

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, counted};

/// Gates of a binary file have no lines.
#[derive(Clone, Copy, Debug)]
pub enum AigerPlace {
    Line(usize),
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

fn damaged(message: impl fmt::Display, at: AigerPlace) -> Diagnostic {
    Diagnostic::without_place(Code::CircuitFile, format!("{message}, {at} of the AIGER file"))
}

fn excerpt(line: &str) -> String {
    line.chars().take(40).collect()
}

pub fn end_of_file(at: AigerPlace) -> Diagnostic {
    damaged("unexpected end of file", at)
}

pub fn not_text(at: AigerPlace) -> Diagnostic {
    damaged("expected text", at)
}

pub fn not_aiger(found: &str, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected `aag` or `aig`, found `{}`", excerpt(found)), at)
}

pub fn header(found: &str, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected a header such as `aag 3 2 0 1 1`, found `{}`", excerpt(found)), at)
}

pub fn header_numbers(found: usize, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected five to nine numbers in the header, found {found}"), at)
}

pub fn property(what: &str, number: usize, at: AigerPlace) -> Diagnostic {
    let message = format!("{what} are not part of a circuit, and the header has {number}; `nbc prove` reads them");
    damaged(message, at)
}

pub fn liveness(what: &str, number: usize, at: AigerPlace) -> Diagnostic {
    let why = "they are about runs without an end";
    damaged(format!("{what} are not supported, and the header has {number}: {why}"), at)
}

pub fn no_properties(at: AigerPlace) -> Diagnostic {
    damaged("no properties: expected bad states, or outputs in their place", at)
}

pub fn too_large(number: usize, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected at most {} variables, found {number}", Limit::AigerVariables.most()), at)
}

pub fn too_many_ports(at: AigerPlace) -> Diagnostic {
    let most = Limit::AigerPorts.most();
    damaged(format!("expected at most {most} inputs and {most} latches"), at)
}

pub fn sum(numbers: [usize; 3], variables: usize, binary: bool, at: AigerPlace) -> Diagnostic {
    let relation = if binary { "must equal" } else { "exceed" };
    let [inputs, latches, gates] = numbers;
    let (inputs, latches, gates) = (counted(inputs, "input"), counted(latches, "latch"), counted(gates, "gate"));
    let variables = counted(variables, "variable");
    damaged(format!("{inputs}, {latches} and {gates} {relation} the {variables} of the header"), at)
}

pub fn too_short(outputs: usize, ands: usize, at: AigerPlace) -> Diagnostic {
    let (outputs, gates) = (counted(outputs, "output"), counted(ands, "gate"));
    damaged(format!("the file is too short for {outputs} and {gates}"), at)
}

pub fn not_numbers(found: &str, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected numbers, found `{}`", excerpt(found)), at)
}

pub fn port_literals(what: &str, found: usize, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected one literal for {what}, found {found}"), at)
}

pub fn latch(at: AigerPlace) -> Diagnostic {
    damaged("expected a latch: its literal, its next literal and an optional start value", at)
}

pub fn latch_start(latch: usize, start: usize, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected the start value 0, 1 or {latch} (any) of a latch, found {start}"), at)
}

pub fn gate_literals(found: usize, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected three literals of a gate, found {found}"), at)
}

pub fn gate_order(gate: usize, at: AigerPlace) -> Diagnostic {
    damaged(format!("the inputs of gate {gate} are not smaller literals"), at)
}

pub fn long_number(at: AigerPlace) -> Diagnostic {
    damaged("expected a number of at most 35 bits", at)
}

pub fn not_a_symbol(found: &str, at: AigerPlace) -> Diagnostic {
    damaged(format!("expected a symbol such as `i0 name`, found `{}`", excerpt(found)), at)
}

pub fn unknown_symbol(found: &str, at: AigerPlace) -> Diagnostic {
    damaged(format!("`{}` names no input, output or latch", excerpt(found)), at)
}

#[derive(Clone, Copy)]
pub enum BadLiteral {
    NotAnInput,
    NotAGate,
    DefinedTwice,
    Undriven,
    OverHeader,
    Loop,
}

pub fn literal(fault: BadLiteral, literal: usize, at: AigerPlace) -> Diagnostic {
    let message = match fault {
        BadLiteral::NotAnInput => format!("literal {literal} cannot be an input or a latch"),
        BadLiteral::NotAGate => format!("literal {literal} cannot be a gate"),
        BadLiteral::DefinedTwice => format!("literal {literal} is defined twice"),
        BadLiteral::Undriven => format!("nothing drives literal {literal}"),
        BadLiteral::OverHeader => format!("literal {literal} is larger than the header allows"),
        BadLiteral::Loop => format!("literal {literal} depends on itself"),
    };
    damaged(message, at)
}
