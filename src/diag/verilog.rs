//! Diagnostics for Verilog that cannot be translated.

use super::{Code, Diagnostic};
use crate::source::{SourceFile, Span, VerilogError};

impl Diagnostic {
    /// The error of translating a Verilog file, at its line if there is one.
    pub fn untranslated(file: &SourceFile, error: &VerilogError) -> Self {
        let name = &file.name;
        match error {
            VerilogError::NoTranslator => {
                Self::without_place(Code::Unreadable, format!("cannot read `{name}`: Verilog is not read here"))
                    .with_help("translate it to BLIF with Yosys, and use that")
            }
            VerilogError::NoYosys => {
                Self::without_place(Code::Unreadable, "Verilog is read through Yosys, which is not installed")
                    .with_help("install it, on Debian with `apt-get install yosys`, or give a BLIF file")
            }
            VerilogError::NoFolder(why) => {
                Self::without_place(Code::Unwritable, format!("cannot write a temporary folder: {why}"))
            }
            VerilogError::NoResult => Self::without_place(Code::CircuitFile, format!("yosys made no BLIF of `{name}`")),
            VerilogError::Asynchronous { line } => {
                let message = format!("`{name}` has a register with an asynchronous set or reset");
                let label = "expected a register that changes with its clock only";
                at_line(file, *line, message, label)
                    .with_help("reset it at the clock: `always @(posedge clk) if (reset) … else …`")
            }
            VerilogError::Outside { line, word } => {
                let message = format!("`{name}` uses `{word}`, which could read files outside of the served folder");
                at_line(file, Some(*line), message, "expected Verilog that only computes")
                    .with_help("write it without macros, included files and such functions, or use `nbc run`")
            }
            VerilogError::Rejected { reason, line } => {
                at_line(file, *line, format!("yosys cannot read `{name}`"), reason)
            }
        }
    }
}

/// A fault of a line, or of the file.
fn at_line(file: &SourceFile, line: Option<usize>, message: String, label: &str) -> Diagnostic {
    let Some(line) = line else {
        return Diagnostic::without_place(Code::CircuitFile, format!("{message}: {label}"));
    };
    let start = file.text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum::<usize>();
    let text = file.text[start..].lines().next().unwrap_or_default();
    let indent = text.len() - text.trim_start().len();
    let span = Span::new(file.id, start + indent, start + text.trim_end().len().max(indent));
    Diagnostic::new(Code::CircuitFile, message, span, label)
}
