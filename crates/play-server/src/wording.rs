//! Why pages cannot be served.

use std::io;
use std::path::Path;

use nbc_base::diag::{Code, Diagnostic, io_words};

pub(super) fn cannot_listen(host: &str, port: u16, error: &io::Error) -> Diagnostic {
    let message = format!("cannot listen at {host}, port {port}: {}", io_words(error));
    Diagnostic::without_place(Code::BadValue, message).with_help("`--port 0` takes any free port")
}

pub(super) fn missing(path: &Path, error: &io::Error) -> Diagnostic {
    Diagnostic::without_place(Code::Unreadable, format!("cannot read `{}`: {}", path.display(), io_words(error)))
}

pub(super) fn system(reason: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Unreadable, format!("cannot start the server: {reason}"))
}
