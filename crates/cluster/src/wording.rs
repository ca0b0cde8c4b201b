//! Errors of work on several machines, and their messages.

use nbc_base::diag::{Code, Diagnostic};

/// Work on several machines that cannot be done; `server` is as the user wrote it, without a password.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ClusterError {
    /// A server that cannot be reached, or that refuses the client.
    Connect {
        /// Its address.
        server: String,
        /// What the client says.
        reason: String,
    },
    /// A file with credentials that cannot be used.
    Credentials {
        /// The file, as the user wrote it.
        path: String,
        /// What the client says.
        reason: String,
    },
    /// A server without JetStream, or without the right to use it.
    JetStream {
        /// Its address.
        server: String,
        /// What the server says.
        reason: String,
    },
    /// A name that a worker cannot have, because it is part of a subject.
    Name {
        /// The name.
        name: String,
    },
    /// A worker whose messages or results were rejected.
    Rejected {
        /// Its name.
        name: String,
        /// The reason.
        reason: &'static str,
    },
    /// A client that cannot be started.
    Start {
        /// What the system says.
        reason: String,
    },
    /// A worker that sent a wrong result after others were used.
    Unsound {
        /// Its name.
        worker: String,
    },
}

impl From<ClusterError> for Diagnostic {
    fn from(error: ClusterError) -> Self {
        let bad = |message: String| Self::without_place(Code::BadValue, message);
        match error {
            ClusterError::Connect { server, reason } => {
                Self::without_place(Code::Unreadable, format!("cannot use the NATS server `{server}`: {reason}"))
                    .with_help("start one with `nats-server --jetstream --store_dir DIR`; see docs/cluster.md")
            }
            ClusterError::Credentials { path, reason } => {
                Self::without_place(Code::Unreadable, format!("cannot use the credentials in `{path}`: {reason}"))
            }
            ClusterError::JetStream { server, reason } => {
                let message = format!("the NATS server `{server}` cannot keep a queue: {reason}");
                Self::without_place(Code::Unwritable, message)
                    .with_help("start it with `--jetstream`, on a disk with room, and allow the user JetStream")
            }
            ClusterError::Name { name } => bad(format!("`{name}` cannot be the name of a worker"))
                .with_help("a name has letters, digits, `-` and `_`, at most 100 of them"),
            ClusterError::Rejected { name, reason } => bad(format!("the search rejected worker `{name}`: {reason}"))
                .with_help("use the same build of the program everywhere, and check the memory of this machine"),
            ClusterError::Unsound { worker } => {
                bad(format!("worker `{worker}` sent a wrong result, and earlier ones of it were used"))
                    .with_help("the runs in progress may differ from those of one machine; start them again without it")
            }
            ClusterError::Start { reason } => {
                Self::without_place(Code::Unreadable, format!("cannot start the client of NATS: {reason}"))
            }
        }
    }
}
