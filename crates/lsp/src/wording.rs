//! Errors of the language server, and their messages.

use std::fmt;

use crate::request_error::RequestError;
use crate::runs::{COMMANDS, OrderError};
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

impl fmt::Display for RequestError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotInitialized { method } => write!(f, "expected `initialize`, found `{method}`"),
            Self::InitializeParameters => f.write_str("expected an object as the parameters of `initialize`"),
            Self::Initialized { method } => write!(f, "the server is initialized, and does not answer `{method}`"),
            Self::ShutDown { method } => write!(f, "the server is shut down, and does not answer `{method}`"),
            Self::UnknownMethod { method } => write!(f, "`{method}` is not a request of this server"),
            Self::Parameters { reason } | Self::Unwritable { reason } => f.write_str(reason),
            Self::Internal => f.write_str("this is a bug of nbc; details are on standard error"),
            Self::Order(error) => error.fmt(f),
            Self::OfPrelude => f.write_str("the prelude declares this name"),
            Self::NotAName { new } => {
                write!(f, "`{new}` is not a name: expected letters, digits and `_`, and no reserved word")
            }
            Self::BadName { new, fault } => write!(f, "`{new}` cannot be the new name: {fault}"),
            Self::OtherMeaning { new } => write!(f, "`{new}` has another meaning where the name is used"),
            Self::SourceErrors => f.write_str("the source has errors"),
            Self::NothingToRun => f.write_str("there is no such test or simulation"),
            Self::Cancelled => f.write_str("cancelled"),
            Self::Compile { fault } => f.write_str(fault),
        }
    }
}

impl fmt::Display for OrderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Command(name) => {
                write!(f, "`{name}` is not a command of this server; expected one of {}", COMMANDS.join(", "))
            }
            Self::Arguments => f.write_str("expected an object with the `uri` of an open text"),
            Self::NoPlace => f.write_str("commands write their results outside of the folder of this client"),
            Self::Closed(uri) => write!(f, "`{uri}` is not open"),
        }
    }
}
