//! Circuit files.

use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic};
use nbc_base::source::{FileId, Span};

fn bad(message: String) -> Diagnostic {
    Diagnostic::without_place(Code::BadValue, message)
}

pub(crate) fn circuit_format(file: &str) -> Diagnostic {
    bad(format!("unrecognized circuit format of `{file}`; expected .blif, .pla, .aig, .aag, .bench, .v or .sv"))
}

pub(crate) fn no_model(file: &str) -> Diagnostic {
    Diagnostic::without_place(Code::CircuitFile, format!("`{file}` is no model: expected .aig or .aag"))
}

pub(crate) fn no_modules(file: &str) -> Diagnostic {
    bad(format!("`{file}` has one circuit, which has no name"))
        .with_help("leave out `--top`: Verilog has modules, and BLIF has models")
}

pub(crate) fn several_files() -> Diagnostic {
    bad("only Verilog can be in several files".to_owned()).with_help("give one file of another format")
}

pub(crate) fn no_parameters(file: &str) -> Diagnostic {
    bad(format!("`{file}` has no parameters")).with_help("leave out `--param`: only modules of Verilog have parameters")
}

pub(crate) fn no_unclocked(file: &str, clock: &str) -> Diagnostic {
    bad(format!("`{file}` has no registers without a clock, which `--clock {clock}` is for"))
        .with_help("leave out `--clock`")
}

/// The label moves to the place of the design, if it is known.
pub(crate) fn no_outputs(circuit: &str) -> Diagnostic {
    let message = format!("`{circuit}` has no outputs, but a circuit needs one");
    Diagnostic::new(Code::CircuitFile, message, Span::new(FileId(0), 0, 0), "expected an output port")
}

pub(crate) fn nb_too_large(bytes: usize) -> Diagnostic {
    let most = Limit::SourceBytes.most();
    Diagnostic::without_place(Code::TooLarge, format!("the circuit takes {bytes} bytes as a .nb file"))
        .with_help(format!("a .nb file has at most {most} bytes; write BLIF"))
}
