//! The reasons for which pages cannot be served, and their messages.

use nbc_base::diag::{Code, Diagnostic};

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlayError {
    Address { host: String, port: u16, reason: String },
    File { path: String, reason: String },
    System { reason: String },
}

impl From<PlayError> for Diagnostic {
    fn from(error: PlayError) -> Self {
        match error {
            PlayError::Address { host, port, reason } => {
                let message = format!("cannot listen at {host}, port {port}: {reason}");
                Self::without_place(Code::BadValue, message).with_help("`--port 0` takes any free port")
            }
            PlayError::File { path, reason } => {
                Self::without_place(Code::Unreadable, format!("cannot read `{path}`: {reason}"))
            }
            PlayError::System { reason } => {
                Self::without_place(Code::Unreadable, format!("cannot start the server: {reason}"))
            }
        }
    }
}
