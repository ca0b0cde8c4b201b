//! Diagnostics for Verilog that cannot be translated.

use super::file::file_error;
use super::suggest::alternatives;
use super::{Code, Diagnostic, Severity, Suggestion};
use crate::source::{SourceFile, Span, VerilogDifference, VerilogError, VerilogFault, VerilogName, VerilogPlace};

impl Diagnostic {
    /// The error of translating a Verilog file, at its line if there is one.
    pub fn untranslated(file: &SourceFile, error: &VerilogError) -> Self {
        let name = &file.name;
        match error {
            VerilogError::NoTranslator => {
                Self::without_place(Code::Unreadable, format!("cannot read `{name}`: Verilog is not read here"))
                    .with_help("translate it to BLIF with Yosys, and use that")
            }
            VerilogError::Untrusted => {
                let message =
                    format!("`{name}` is not translated: Yosys does not run in a workspace that is not trusted");
                Self::without_place(Code::Unreadable, message).with_help(
                    "if you trust these files, trust the workspace in the editor, or start the language server with \
                     the option `verilog.trusted`: see docs/editors.md",
                )
            }
            VerilogError::NoYosys => {
                Self::without_place(Code::Unreadable, "Verilog is read through Yosys, which is not installed")
                    .with_help("install it, on Debian with `apt-get install yosys`, or give a BLIF file")
            }
            VerilogError::NoFolder(why) => {
                Self::without_place(Code::Unwritable, format!("cannot write a temporary folder: {why}"))
            }
            VerilogError::NoResult => Self::without_place(Code::CircuitFile, format!("yosys made no BLIF of `{name}`")),
            VerilogError::Cancelled => {
                Self::without_place(Code::CircuitFile, format!("the translation of `{name}` was stopped"))
            }
            VerilogError::TooLong { seconds } => {
                Self::without_place(Code::CircuitFile, format!("yosys takes more than {seconds} s for `{name}`"))
                    .with_help("does it have a loop of many steps? Split large files, or translate them to BLIF first")
            }
            VerilogError::TooLarge { megabytes } => {
                let message = format!("yosys needs more than {megabytes} MB of memory for `{name}`");
                Self::without_place(Code::CircuitFile, message)
                    .with_help("does it have a loop of many steps? Split large files, or translate them to BLIF first")
            }
            VerilogError::NoModule { module, known } => {
                let message = format!("`{name}` has no module `{module}`");
                Self::without_place(Code::Unknown, message)
                    .with_suggestion(None, &Suggestion::of(module, known.iter().map(String::as_str)))
            }
            VerilogError::NoParameter { parameter, known } => {
                let message = format!("the top module of `{name}` has no parameter `{parameter}`");
                Self::without_place(Code::Unknown, message)
                    .with_suggestion(None, &Suggestion::of(parameter, known.iter().map(String::as_str)))
            }
            VerilogError::SeveralModules { known } => {
                let message = format!("`{name}` has several modules that could have the parameters");
                let help = format!("choose one with `--top`: {}", alternatives(known, "or"));
                Self::without_place(Code::BadValue, message).with_help(help)
            }
            VerilogError::WideExponent { place } => {
                let message = format!("`{name}` uses `**` with a wide exponent");
                at_place(file, place.as_ref(), message, "expected a constant, or an exponent of at most 16 bits")
                    .with_help("`2 ** n` may have any exponent: it is `1 << n`")
            }
            VerilogError::NotLogic { cell, place } => {
                let message = format!("`{name}` has a part that is no logic: `{cell}`");
                at_place(file, place.as_ref(), message, "cannot be made of gates")
            }
            VerilogError::Outside { place, word } => {
                let message = format!("`{name}` uses `{word}`, which could reach other files or programs");
                at_place(file, Some(place), message, "expected Verilog that only computes")
                    .with_help("write values into the text, instead of reading or calling them")
            }
            VerilogError::Include { place, path, error } => {
                let message = format!("cannot read `{path}`: {}", file_error(error));
                at_place(file, Some(place), message, "included here")
                    .with_help("only files in the folder of the Verilog file, or below it, can be included")
            }
            VerilogError::HighImpedance { place, construct } => {
                let message = format!("`{name}` uses `{construct}`: a net that may be driven by nothing");
                at_place(file, Some(place), message, "robots always compute 0 or 1")
                    .with_help("drive the net at all times, and declare each port as `input` or `output`")
            }
            VerilogError::Unclear { place, fault } => {
                at_place(file, Some(place), format!("cannot read `{name}`"), &unclear(fault))
            }
            VerilogError::Different(difference) => {
                let VerilogDifference { module, step, output, source, translation, inputs, place } = &**difference;
                let message = format!("yosys misreads module `{module}` of `{name}`");
                let label =
                    format!("step {step}: `{output}` is {source} in iverilog, and {translation} in yosys' netlist");
                let inputs: Vec<_> = inputs.iter().map(|(name, value)| format!("{name}={value}")).collect();
                let fault = at_place(file, place.as_ref(), message, &label);
                fault.with_help(format!(
                    "the inputs are {} then, after random steps from the start; write it in another way, such as with \
                     complete sensitivity lists and constants of plain widths, or try a newer version of Yosys",
                    inputs.join(" ")
                ))
            }
            VerilogError::Rejected { reason, place } => {
                at_place(file, place.as_ref(), format!("yosys cannot read `{name}`"), reason)
            }
        }
    }
}

/// Warnings about a translation.
impl Diagnostic {
    /// A wire that nothing drives.
    pub fn undriven_wire(file: &SourceFile, wire: &VerilogName) -> Self {
        let message = format!("nothing drives the wire `{}`", wire.name);
        let fault =
            at_place(file, wire.place.as_ref(), message, "it is 0").with_help("drive it, or write the constant");
        Self { code: Code::Undriven, severity: Severity::Warning, ..fault }
    }

    /// A module that is not translated.
    pub fn left_out(file: &SourceFile, module: &VerilogName) -> Self {
        let message = format!("module `{}` is left out", module.name);
        let fault = at_place(file, module.place.as_ref(), message, "it has no outputs");
        Self { severity: Severity::Warning, ..fault }
    }

    /// A fault of a text that a translator wrote, at a line of the Verilog file if it is known.
    pub fn of_verilog(self, file: &SourceFile, place: Option<&VerilogPlace>) -> Self {
        let label = self.labels.into_iter().next().map(|label| label.text).unwrap_or_default();
        let there = match place {
            Some(place) => at_place(file, Some(place), self.message, &label),
            None => Self::without_place(self.code, self.message),
        };
        Self { code: self.code, severity: self.severity, help: self.help, ..there }
    }
}

/// What is wrong before Yosys reads a text.
fn unclear(fault: &VerilogFault) -> String {
    match fault {
        VerilogFault::OpenComment => "expected `*/` at the end of the comment".to_owned(),
        VerilogFault::OpenQuote => "expected `\"` in the same line".to_owned(),
        VerilogFault::OpenCondition => "expected `` `endif ``".to_owned(),
        VerilogFault::NoCondition { word } => format!("`` {word} `` without `` `ifdef ``"),
        VerilogFault::Character { character } => format!("unexpected character {character:?}"),
        VerilogFault::NoDigits { base } => format!("expected digits after `{base}`"),
        VerilogFault::Directive { word, expected } => format!("expected {expected} after `` {word} ``"),
        VerilogFault::Undefined { word } => format!("`` {word} `` is not defined"),
        VerilogFault::Arguments { word, expected } => {
            format!("`` {word} `` has another number of arguments than it declares ({expected})")
        }
        VerilogFault::TooDeep => "macros or files contain each other".to_owned(),
        VerilogFault::TooMuch { megabytes } => {
            format!("macros and included files become more than {megabytes} MB of text")
        }
    }
}

/// A fault at a line of the file, or of one that it includes.
fn at_place(file: &SourceFile, place: Option<&VerilogPlace>, message: String, label: &str) -> Diagnostic {
    match place {
        Some(place) if place.file == file.name => at_line(file, Some(place.line), message, label),
        Some(VerilogPlace { file: other, line }) => {
            Diagnostic::without_place(Code::CircuitFile, format!("{message}: {label} (`{other}`, line {line})"))
        }
        None => at_line(file, None, message, label),
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
