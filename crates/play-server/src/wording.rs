//! The reasons for which pages cannot be served, and their messages.

use nbc_base::diag::{Code, Diagnostic};

/// The reason for which pages cannot be served.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlayError {
    /// An address at which nothing can listen.
    Address {
        /// The host, as the user gave it.
        host: String,
        /// The port; 0 is any.
        port: u16,
        /// What the system says.
        reason: String,
    },
    /// A file or folder that cannot be found.
    File {
        /// The path, as the user gave it.
        path: String,
        /// What the system says.
        reason: String,
    },
    /// A resource that the system does not provide, such as threads.
    System {
        /// What the system says.
        reason: String,
    },
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
