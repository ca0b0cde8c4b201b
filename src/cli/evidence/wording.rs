//! Errors of `nbc evidence`, and their messages.

use nbc_base::diag::{Code, Diagnostic};

/// Why claims cannot be shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::cli) enum EvidenceError {
    /// A file that is not a list of claims.
    List { path: String, reason: String },
    /// A program that lists of claims may not start.
    OtherProgram { program: String },
    /// A program that cannot be started, or a folder for its files that cannot be made.
    NotStarted { program: String, reason: String },
}

impl From<EvidenceError> for Diagnostic {
    fn from(error: EvidenceError) -> Self {
        match error {
            EvidenceError::List { path, reason } => {
                Self::without_place(Code::BadValue, format!("`{path}` is not a list of claims: {reason}"))
            }
            EvidenceError::OtherProgram { program } => {
                Self::without_place(Code::BadValue, format!("claims start `nbc` or `cargo`, not `{program}`"))
            }
            EvidenceError::NotStarted { program, reason } => {
                Self::without_place(Code::Unreadable, format!("cannot start `{program}`: {reason}"))
            }
        }
    }
}
