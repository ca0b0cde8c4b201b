//! Errors of the language server, and their messages.

use nbc_base::diag::{Code, Diagnostic};

/// A client of the language server that breaks the protocol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ServerError {
    /// The rule that was broken.
    Protocol(String),
}

impl From<ServerError> for Diagnostic {
    fn from(error: ServerError) -> Self {
        let ServerError::Protocol(reason) = error;
        let message = format!("the client does not speak the Language Server Protocol: {reason}");
        Self::without_place(Code::Unreadable, message)
            .with_help("editors start `nbc lsp` themselves: see docs/editors.md")
    }
}
