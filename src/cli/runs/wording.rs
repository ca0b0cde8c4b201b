//! Messages on the choice of a file's tests, simulations and claims. `file` is as the user wrote it.

use nbc_base::diag::{Code, Diagnostic};

use crate::cli::wording::no_such;

pub(in crate::cli) fn no_test(file: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Empty, format!("`{file}` declares no test"))
        .with_help("declare one: `test my_circuit { a b | q` and a row for each input pattern")
}

pub(in crate::cli) fn nothing_to_run(file: &str) -> Diagnostic {
    let message = format!("`{file}` declares no test and no simulation, so there is nothing to run");
    Diagnostic::without_place(Code::Empty, message).with_help(
        "declare a test: `test my_circuit { a b | q` and a row for each input pattern; `nbc check` only checks, and \
         `nbc test` decides tests for ever",
    )
}

pub(in crate::cli) fn no_claim(file: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Empty, format!("`{file}` claims nothing"))
        .with_help("declare what is always or never so: `prove my_circuit { never a and b }`")
}

pub(in crate::cli) fn unknown_claim(file: &str, name: &str, known: &[String]) -> Diagnostic {
    no_such(format!("no claim of `{file}` is called `{name}`"), name, known)
}

pub(super) fn unknown_run(file: &str, name: &str, known: &[String]) -> Diagnostic {
    no_such(format!("no test and no simulation of `{file}` is called `{name}`"), name, known)
}
