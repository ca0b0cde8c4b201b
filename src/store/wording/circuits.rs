//! Circuit files and Yosys.

use std::io;

use crate::diag::{Code, Diagnostic, io_words};
use crate::source::Span;

/// A circuit file that cannot be read or written.
#[derive(Debug)]
pub(in crate::store) enum StoreError {
    /// A file name without the extension of a circuit format.
    CircuitFormat { file: String },
    /// A circuit whose text would be too large to be read again.
    NbTooLarge { bytes: usize, most: u64 },
    /// A temporary folder that cannot be written.
    TemporaryFolder(io::Error),
    /// Yosys is missing.
    YosysMissing,
    /// Yosys wrote no result.
    YosysSilent { file: String },
    /// An error message of Yosys, with its place in the file if it names one.
    Yosys { file: String, reason: String, place: Option<Span> },
}

impl From<StoreError> for Diagnostic {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::CircuitFormat { file } => {
                let message =
                    format!("unrecognized circuit format of `{file}`; expected .blif, .aig, .aag, .bench or .v");
                Self::without_place(Code::BadValue, message)
            }
            StoreError::NbTooLarge { bytes, most } => {
                Self::without_place(Code::TooLarge, format!("the circuit takes {bytes} bytes as a .nb file"))
                    .with_help(format!("a .nb file has at most {most} bytes; write BLIF"))
            }
            StoreError::TemporaryFolder(error) => {
                let message = format!("cannot write a temporary folder: {}", io_words(&error));
                Self::without_place(Code::Unwritable, message)
            }
            StoreError::YosysMissing => {
                Self::without_place(Code::Unreadable, "Verilog is read through Yosys, which is not installed")
                    .with_help("install it, on Debian with `apt-get install yosys`, or give a BLIF file")
            }
            StoreError::YosysSilent { file } => {
                Self::without_place(Code::CircuitFile, format!("yosys made no BLIF of `{file}`"))
            }
            StoreError::Yosys { file, reason, place } => {
                let message = format!("yosys cannot read `{file}`");
                match place {
                    Some(span) => Self::new(Code::CircuitFile, message, span, reason),
                    None => Self::without_place(Code::CircuitFile, format!("{message}: {reason}")),
                }
            }
        }
    }
}
