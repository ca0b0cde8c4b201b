//! The reasons for which requests are refused; `wording.rs` has their messages.

use lsp_server::{ErrorCode, RequestId, Response};

use crate::runs::OrderError;

/// The reason for which a request is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RequestError {
    /// A request before `initialize`.
    NotInitialized { method: String },
    /// `initialize` without an object as its parameters.
    InitializeParameters,
    /// A second `initialize`.
    Initialized { method: String },
    /// A request after `shutdown`.
    ShutDown { method: String },
    /// A request that the service does not have.
    UnknownMethod { method: String },
    /// Parameters of another form.
    Parameters { reason: String },
    /// A bug of the service.
    Internal,
    /// A command that cannot be run.
    Order(OrderError),
    /// A name of the prelude cannot be changed.
    OfPrelude,
    /// The new name is not one.
    NotAName { new: String },
    /// With the new name, a program would have an error.
    BadName { new: String, fault: String },
    /// With the new name, another name would get another meaning.
    OtherMeaning { new: String },
    /// A command on a source with errors.
    SourceErrors,
    /// A command on a test or a simulation that is not there.
    NothingToRun,
    /// The client has cancelled the command.
    Cancelled,
    /// A circuit that cannot be compiled.
    Compile { fault: String },
    /// A result that cannot be written.
    Unwritable { reason: String },
}

impl RequestError {
    /// The code of the protocol.
    fn code(&self) -> ErrorCode {
        match self {
            Self::NotInitialized { .. } => ErrorCode::ServerNotInitialized,
            Self::Initialized { .. } | Self::ShutDown { .. } => ErrorCode::InvalidRequest,
            Self::UnknownMethod { .. } => ErrorCode::MethodNotFound,
            Self::InitializeParameters | Self::Parameters { .. } | Self::Order(_) => ErrorCode::InvalidParams,
            Self::Internal => ErrorCode::InternalError,
            _ => ErrorCode::RequestFailed,
        }
    }

    /// The answer to a request.
    pub(super) fn answer(&self, id: RequestId) -> Response {
        Response::new_err(id, self.code() as i32, self.to_string())
    }
}
