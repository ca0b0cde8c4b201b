//! Files: those of the program, and folders of robots.

use nbc_base::diag::{Code, Diagnostic, Suggestion, counted, folder_error};
use nbc_base::model::GroundFileError;
use nbc_base::source::{FileError, Span};

/// A file or folder that a program cannot use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum LoadError {
    /// A file without declarations.
    Empty { file: String },
    /// A file that cannot be read.
    Unreadable { file: String, error: FileError, meant: Suggestion },
    /// A file name without the extension of a program or of a circuit file.
    NotUsable { file: String },
    /// A file name without the extension of rows.
    NotRows { file: String },
    /// A circuit with a name that is not legal in the language.
    CircuitName { circuit: String, rename: &'static str },
    /// A circuit of a file without outputs.
    NoOutputs { circuit: String },
    /// Files that use each other.
    Circular { circle: Vec<String> },
    /// Files that use each other too deeply.
    TooDeep { most: u64 },
    /// Too many files.
    TooManyFiles { most: u64 },
    /// Errors and warnings of a file above the number that is shown.
    MoreFaults { file: String, errors: usize, warnings: usize },
    /// Too much text.
    TooLarge { megabytes: u64 },
    /// A folder that cannot be read.
    UnreadableLibrary { folder: String, error: FileError },
    /// A folder without robot files.
    EmptyLibrary { folder: String },
    /// A file of ground that cannot be read.
    UnreadableGround { file: String, error: FileError },
    /// A file that is not ground.
    Ground { file: String, error: GroundFileError },
}

impl LoadError {
    /// The error at the path in the source.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::Empty { file } => {
                Diagnostic::new(Code::Empty, format!("`{file}` declares nothing"), span, "expected a declaration")
                    .with_help("declare a circuit: `circuit inverter(a) -> (q) { q = not a }`")
            }
            Self::Unreadable { file, error, meant } => Diagnostic::unreadable(&file, &error)
                .with_label(span, "used here")
                .with_help("the path is relative to the file that uses it")
                .with_suggestion(None, &meant),
            Self::NotUsable { file } => {
                let message = format!("cannot use `{file}`: it is neither a program nor a circuit file");
                let endings = ".nb, .blif, .pla, .aig, .aag, .bench, .v or .sv";
                let label = format!("expected a file name ending in {endings}, or a folder of Verilog");
                Diagnostic::new(Code::Unreadable, message, span, label)
                    .with_help("a link must lead to a file name with the same ending")
            }
            Self::NotRows { file } => {
                let message = format!("cannot read rows from `{file}`");
                Diagnostic::new(Code::Unreadable, message, span, "expected a file name ending in .csv or .pla")
            }
            Self::CircuitName { circuit, rename } => {
                let message = format!("`{circuit}` cannot be the name of a circuit");
                let label = "expected letters, digits and underscores, and no word of the language";
                Diagnostic::new(Code::CircuitFile, message, span, label).with_help(rename)
            }
            Self::NoOutputs { circuit } => {
                let message = format!("`{circuit}` has no outputs, but a circuit needs one");
                Diagnostic::new(Code::CircuitFile, message, span, "used here")
            }
            Self::Circular { circle } => {
                let circle: Vec<_> = circle.iter().map(|file| format!("`{file}`")).collect();
                let message = format!("files use each other in a circle: {}", circle.join(" uses "));
                Diagnostic::new(Code::CircularUse, message, span, "this closes the circle")
                    .with_help("put what both need into a file of its own")
            }
            Self::TooDeep { most } => {
                let message = format!("files use each other more than {most} levels deep");
                Diagnostic::new(Code::Nesting, message, span, "the limit is reached here")
            }
            Self::TooManyFiles { most } => too_large(format!("program has more than {most} files"), span),
            Self::TooLarge { megabytes } => too_large(format!("program is larger than {megabytes} MB"), span),
            Self::MoreFaults { file, errors, warnings } => {
                let more = |count, noun| (count > 0).then(|| counted(count, noun));
                let more: Vec<_> =
                    [more(errors, "more error"), more(warnings, "more warning")].into_iter().flatten().collect();
                let verb = if errors + warnings == 1 { "is" } else { "are" };
                let message = format!("{} in `{file}` {verb} not shown", more.join(" and "));
                Diagnostic::new(Code::TooLarge, message, span, "the first one of them")
                    .with_help("one fault may cause many others, so correct the first ones and check again")
            }
            Self::UnreadableLibrary { folder, error } => library(&folder, folder_error(&error), span),
            Self::EmptyLibrary { folder } => library(&folder, "it contains no robot files (.yaml)", span),
            Self::UnreadableGround { file, error } => Diagnostic::unreadable(&file, &error)
                .with_label(span, "used here")
                .with_help("the path is relative to the file that names it"),
            Self::Ground { file, error } => ground(&file, &error, span),
        }
    }
}

/// A fault of a file that a program uses, with the place of the use.
pub(crate) fn at_use(fault: Diagnostic, span: Span) -> Diagnostic {
    if fault.labels.is_empty() { fault.with_label(span, "used here") } else { fault.with_related(span, "used here") }
}

fn too_large(message: String, span: Span) -> Diagnostic {
    Diagnostic::new(Code::TooLarge, message, span, "the limit is reached here")
}

fn ground(file: &str, error: &GroundFileError, span: Span) -> Diagnostic {
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
    Diagnostic::new(code, message, span, label).with_help(help)
}

fn library(folder: &str, why: &str, span: Span) -> Diagnostic {
    let message = format!("cannot read the library `{folder}`: {why}");
    Diagnostic::new(Code::Unreadable, message, span, "expected a folder of robot files")
        .with_help("the path is relative to the file that names it; `nbc library add` writes robot files")
}
