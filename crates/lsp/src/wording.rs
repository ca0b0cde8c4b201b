//! The messages of the language server.

use lsp_server::{ErrorCode, RequestId, Response};

#[cfg(feature = "disk")]
use nbc_base::diag::{Code, Diagnostic};

#[cfg(feature = "disk")]
pub(super) fn protocol(reason: &str) -> Diagnostic {
    let message = format!("the client does not speak the Language Server Protocol: {reason}");
    Diagnostic::without_place(Code::Unreadable, message)
        .with_help("editors start `nbc lsp` themselves: see docs/editors.md")
}

#[derive(Debug)]
pub(super) struct RequestError {
    code: ErrorCode,
    message: String,
}

impl RequestError {
    pub(super) fn answer(&self, id: RequestId) -> Response {
        Response::new_err(id, self.code as i32, self.message.clone())
    }
}

fn refused(code: ErrorCode, message: impl Into<String>) -> RequestError {
    RequestError { code, message: message.into() }
}

pub(super) fn failed(message: impl Into<String>) -> RequestError {
    refused(ErrorCode::RequestFailed, message)
}

pub(super) fn not_initialized(method: &str) -> RequestError {
    refused(ErrorCode::ServerNotInitialized, format!("expected `initialize`, found `{method}`"))
}

pub(super) fn initialize_parameters() -> RequestError {
    invalid_parameters("expected an object as the parameters of `initialize`")
}

pub(super) fn initialized(method: &str) -> RequestError {
    let message = format!("the server is initialized, and does not answer `{method}`");
    refused(ErrorCode::InvalidRequest, message)
}

pub(super) fn shut_down(method: &str) -> RequestError {
    refused(ErrorCode::InvalidRequest, format!("the server is shut down, and does not answer `{method}`"))
}

pub(super) fn unknown_method(method: &str) -> RequestError {
    refused(ErrorCode::MethodNotFound, format!("`{method}` is not a request of this server"))
}

pub(super) fn invalid_parameters(reason: impl Into<String>) -> RequestError {
    refused(ErrorCode::InvalidParams, reason)
}

pub(super) fn internal() -> RequestError {
    refused(ErrorCode::InternalError, "this is a bug of nbc; details are on standard error")
}

pub(super) fn name_of_prelude() -> RequestError {
    failed("the prelude declares this name")
}

pub(super) fn not_a_name(new: &str) -> RequestError {
    failed(format!("`{new}` is not a name: expected letters, digits and `_`, and no reserved word"))
}

pub(super) fn bad_name(new: &str, fault: &str) -> RequestError {
    failed(format!("`{new}` cannot be the new name: {fault}"))
}

pub(super) fn other_meaning(new: &str) -> RequestError {
    failed(format!("`{new}` has another meaning where the name is used"))
}

pub(super) fn source_errors() -> RequestError {
    failed("the source has errors")
}

pub(super) fn nothing_to_run() -> RequestError {
    failed("there is no such test or simulation")
}

pub(super) fn cancelled() -> RequestError {
    failed("cancelled")
}

pub(super) fn unknown_command(name: &str, known: &[&str]) -> RequestError {
    let known = known.join(", ");
    invalid_parameters(format!("`{name}` is not a command of this server; expected one of {known}"))
}

pub(super) fn command_arguments() -> RequestError {
    invalid_parameters("expected an object with the `uri` of an open text")
}

pub(super) fn no_place() -> RequestError {
    invalid_parameters("commands write their results outside of the folder of this client")
}

pub(super) fn not_open(uri: &str) -> RequestError {
    invalid_parameters(format!("`{uri}` is not open"))
}
