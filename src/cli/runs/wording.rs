//! Errors in the choice of a file's tests and simulations, and their messages.

use nbc_base::diag::{Code, Diagnostic};

use crate::cli::wording::no_such;

/// Tests and simulations that a file does not have; `file` is as the user wrote it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum RunChoiceError {
    /// A file without tests.
    NoTest { file: String },
    /// A file without tests and simulations.
    NothingToRun { file: String },
    /// A file without claims.
    NoClaim { file: String },
    /// A claim that the file does not have.
    UnknownClaim { file: String, name: String, known: Vec<String> },
    /// A test or simulation that the file does not have.
    UnknownRun { file: String, name: String, known: Vec<String> },
}

impl From<RunChoiceError> for Diagnostic {
    fn from(error: RunChoiceError) -> Self {
        let fault = Self::without_place;
        match error {
            RunChoiceError::NoTest { file } => fault(Code::Empty, format!("`{file}` declares no test"))
                .with_help("declare one: `test my_circuit { a b | q` and a row for each input pattern"),
            RunChoiceError::NothingToRun { file } => {
                let message = format!("`{file}` declares no test and no simulation, so there is nothing to run");
                let help = "declare a test: `test my_circuit { a b | q` and a row for each input pattern; \
                            `nbc check` only checks, and `nbc test` decides tests for ever";
                fault(Code::Empty, message).with_help(help)
            }
            RunChoiceError::NoClaim { file } => fault(Code::Empty, format!("`{file}` claims nothing"))
                .with_help("declare what is always or never so: `prove my_circuit { never a and b }`"),
            RunChoiceError::UnknownClaim { file, name, known } => {
                no_such(format!("no claim of `{file}` is called `{name}`"), &name, &known)
            }
            RunChoiceError::UnknownRun { file, name, known } => {
                let message = format!("no test and no simulation of `{file}` is called `{name}`");
                no_such(message, &name, &known)
            }
        }
    }
}
