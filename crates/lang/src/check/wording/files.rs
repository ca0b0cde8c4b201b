//! Files: those of the program, and folders of robots.

use nbc_base::diag::{Code, Diagnostic, Suggestion, counted, folder_error};
use nbc_base::model::GroundFileError;
use nbc_base::source::{FileError, Span};

pub(crate) fn empty_file(file: &str, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Empty, format!("`{file}` declares nothing"), at, "expected a declaration")
        .with_help("declare a circuit: `circuit inverter(a) -> (q) { q = not a }`")
}

pub(crate) fn unreadable_use(file: &str, error: &FileError, meant: &Suggestion, at: Span) -> Diagnostic {
    Diagnostic::unreadable(file, error)
        .with_label(at, "used here")
        .with_help("the path is relative to the file that uses it")
        .with_suggestion(None, meant)
}

pub(crate) fn unreadable_value(file: &str, error: &FileError, at: Span) -> Diagnostic {
    Diagnostic::unreadable(file, error)
        .with_label(at, "used here")
        .with_help("the path is relative to the file that names it")
}

pub(crate) fn not_usable(file: &str, at: Span) -> Diagnostic {
    let message = format!("cannot use `{file}`: it is neither a program nor a circuit file");
    let endings = ".nb, .blif, .pla, .aig, .aag, .bench, .v or .sv";
    let label = format!("expected a file name ending in {endings}, or a folder of Verilog");
    Diagnostic::new(Code::Unreadable, message, at, label)
        .with_help("a link must lead to a file name with the same ending")
}

pub(crate) fn not_rows(file: &str, at: Span) -> Diagnostic {
    let message = format!("cannot read rows from `{file}`");
    Diagnostic::new(Code::Unreadable, message, at, "expected a file name ending in .csv or .pla")
}

pub(crate) fn circuit_name(circuit: &str, rename: &str, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` cannot be the name of a circuit");
    let label = "expected letters, digits and underscores, and no word of the language";
    Diagnostic::new(Code::CircuitFile, message, at, label).with_help(rename)
}

pub(crate) fn no_outputs(circuit: &str, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` has no outputs, but a circuit needs one");
    Diagnostic::new(Code::CircuitFile, message, at, "used here")
}

pub(crate) fn circular_use<'a>(circle: impl Iterator<Item = &'a String>, at: Span) -> Diagnostic {
    let circle: Vec<_> = circle.map(|file| format!("`{file}`")).collect();
    let message = format!("files use each other in a circle: {}", circle.join(" uses "));
    Diagnostic::new(Code::CircularUse, message, at, "this closes the circle")
        .with_help("put what both need into a file of its own")
}

pub(crate) fn deep_use(most: u64, at: Span) -> Diagnostic {
    let message = format!("files use each other more than {most} levels deep");
    Diagnostic::new(Code::Nesting, message, at, "the limit is reached here")
}

pub(crate) fn many_files(most: u64, at: Span) -> Diagnostic {
    let message = format!("program has more than {most} files");
    Diagnostic::new(Code::TooLarge, message, at, "the limit is reached here")
}

pub(crate) fn large_program(megabytes: u64, at: Span) -> Diagnostic {
    let message = format!("program is larger than {megabytes} MB");
    Diagnostic::new(Code::TooLarge, message, at, "the limit is reached here")
}

pub(crate) fn more_faults(file: &str, errors: usize, warnings: usize, at: Span) -> Diagnostic {
    let more = [(errors, "more error"), (warnings, "more warning")].into_iter().filter(|(count, _)| *count > 0);
    let more: Vec<String> = more.map(|(count, noun)| counted(count, noun)).collect();
    let verb = if errors + warnings == 1 { "is" } else { "are" };
    let message = format!("{} in `{file}` {verb} not shown", more.join(" and "));
    Diagnostic::new(Code::TooLarge, message, at, "the first one of them")
        .with_help("one fault may cause many others, so correct the first ones and check again")
}

pub(crate) fn at_use(fault: Diagnostic, span: Span) -> Diagnostic {
    if fault.labels.is_empty() { fault.with_label(span, "used here") } else { fault.with_related(span, "used here") }
}

pub(crate) fn ground(file: &str, error: &GroundFileError, at: Span) -> Diagnostic {
    let (code, label, help) = match error {
        GroundFileError::NotFixed { .. } => {
            (Code::Value, "expected fixed voxels only", "remove the object, or make its voxels fixed (code 5)")
        }
        GroundFileError::TooLarge { .. } => {
            (Code::OutOfRange, "expected a smaller world", "keep the part in which the robots walk; it repeats")
        }
        _ => {
            let help = "the design tool of Evolution Gym writes such files, as JSON";
            (Code::Unreadable, "expected a world file of Evolution Gym", help)
        }
    };
    let message = format!("cannot use `{file}` as ground: {error}");
    Diagnostic::new(code, message, at, label).with_help(help)
}

pub(crate) fn unreadable_library(folder: &str, error: &FileError, at: Span) -> Diagnostic {
    library(folder, folder_error(error), at)
}

pub(crate) fn empty_library(folder: &str, at: Span) -> Diagnostic {
    library(folder, "it contains no robot files (.yaml)", at)
}

fn library(folder: &str, why: &str, at: Span) -> Diagnostic {
    let message = format!("cannot read the library `{folder}`: {why}");
    Diagnostic::new(Code::Unreadable, message, at, "expected a folder of robot files")
        .with_help("the path is relative to the file that names it; `nbc library add` writes robot files")
}
