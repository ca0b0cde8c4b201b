//! Circuit files.

use nbc_base::diag::{Code, Diagnostic};
use nbc_base::source::{FileId, Span};

/// A circuit file that cannot be read or written.
#[derive(Debug)]
pub(crate) enum StoreError {
    /// A file name without the extension of a circuit format.
    CircuitFormat { file: String },
    /// A module of a file that has none.
    NoModules { file: String },
    /// A file that is no model with properties.
    NoModel { file: String },
    /// Several files of which one is not Verilog.
    SeveralFiles,
    /// Parameters of a file that has none.
    NoParameters { file: String },
    /// A clock for registers without one, in a file that has none.
    NoUnclocked { file: String, clock: String },
    /// A circuit without outputs.
    NoOutputs { circuit: String },
    /// A circuit whose text would be too large to be read again.
    NbTooLarge { bytes: usize, most: u64 },
}

impl From<StoreError> for Diagnostic {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::CircuitFormat { file } => {
                let message = format!(
                    "unrecognized circuit format of `{file}`; expected .blif, .pla, .aig, .aag, .bench, .v or .sv"
                );
                Self::without_place(Code::BadValue, message)
            }
            StoreError::NoModel { file } => {
                Self::without_place(Code::CircuitFile, format!("`{file}` is no model: expected .aig or .aag"))
            }
            StoreError::NoModules { file } => {
                Self::without_place(Code::BadValue, format!("`{file}` has one circuit, which has no name"))
                    .with_help("leave out `--top`: Verilog has modules, and BLIF has models")
            }
            StoreError::SeveralFiles => Self::without_place(Code::BadValue, "only Verilog can be in several files")
                .with_help("give one file of another format"),
            StoreError::NoParameters { file } => {
                Self::without_place(Code::BadValue, format!("`{file}` has no parameters"))
                    .with_help("leave out `--param`: only modules of Verilog have parameters")
            }
            StoreError::NoUnclocked { file, clock } => {
                let message = format!("`{file}` has no registers without a clock, which `--clock {clock}` is for");
                Self::without_place(Code::BadValue, message).with_help("leave out `--clock`")
            }
            StoreError::NoOutputs { circuit } => {
                let message = format!("`{circuit}` has no outputs, but a circuit needs one");
                // The label moves to the place of the design, if it is known.
                Self::new(Code::CircuitFile, message, Span::new(FileId(0), 0, 0), "expected an output port")
            }
            StoreError::NbTooLarge { bytes, most } => {
                Self::without_place(Code::TooLarge, format!("the circuit takes {bytes} bytes as a .nb file"))
                    .with_help(format!("a .nb file has at most {most} bytes; write BLIF"))
            }
        }
    }
}
