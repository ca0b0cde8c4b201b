//! Messages about work on several machines. A server is named as the user wrote it, without a password.

use nbc_base::diag::{Code, Diagnostic};

fn bad(message: String) -> Diagnostic {
    Diagnostic::without_place(Code::BadValue, message)
}

fn unreadable(message: String) -> Diagnostic {
    Diagnostic::without_place(Code::Unreadable, message)
}

pub fn no_server(server: &str, reason: &str) -> Diagnostic {
    unreadable(format!("cannot use the NATS server `{server}`: {reason}"))
        .with_help("start one with `nats-server --jetstream --store_dir DIR`; see docs/cluster.md")
}

pub fn no_credentials(path: &str, reason: &str) -> Diagnostic {
    unreadable(format!("cannot use the credentials in `{path}`: {reason}"))
}

pub fn no_queue(server: &str, reason: &str) -> Diagnostic {
    let message = format!("the NATS server `{server}` cannot keep a queue: {reason}");
    Diagnostic::without_place(Code::Unwritable, message)
        .with_help("start it with `--jetstream`, on a disk with room, and allow the user JetStream")
}

pub fn bad_worker_name(name: &str) -> Diagnostic {
    bad(format!("`{name}` cannot be the name of a worker"))
        .with_help("a name has letters, digits, `-` and `_`, at most 100 of them")
}

pub fn rejected(name: &str, reason: &str) -> Diagnostic {
    bad(format!("the search rejected worker `{name}`: {reason}"))
        .with_help("use the same build of the program everywhere, and check the memory of this machine")
}

pub fn unsound(worker: &str) -> Diagnostic {
    bad(format!("worker `{worker}` sent a wrong result, and earlier ones of it were used"))
        .with_help("the runs in progress may differ from those of one machine; start them again without it")
}

pub fn no_client(reason: &str) -> Diagnostic {
    unreadable(format!("cannot start the client of NATS: {reason}"))
}
