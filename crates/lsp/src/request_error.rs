//! The reasons for which requests are refused; `wording.rs` has their messages.

use lsp_server::{ErrorCode, RequestId, Response};

use crate::runs::OrderError;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RequestError {
    NotInitialized { method: String },
    InitializeParameters,
    Initialized { method: String },
    ShutDown { method: String },
    UnknownMethod { method: String },
    Parameters { reason: String },
    Internal,
    Order(OrderError),
    OfPrelude,
    NotAName { new: String },
    BadName { new: String, fault: String },
    OtherMeaning { new: String },
    SourceErrors,
    NothingToRun,
    Cancelled,
    Compile { fault: String },
    Unwritable { reason: String },
}

impl RequestError {
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

    pub(super) fn answer(&self, id: RequestId) -> Response {
        Response::new_err(id, self.code() as i32, self.to_string())
    }
}
