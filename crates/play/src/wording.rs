//! Why a program cannot be exported.

use nbc_base::diag::{Code, Diagnostic};

pub(super) fn nothing_to_record(name: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Empty, format!("`{name}` has no test and no simulation to record")).with_help(
        "write a test: `test my_circuit { a b | q` and a row for each input pattern; a live page (`--live`) needs none",
    )
}
