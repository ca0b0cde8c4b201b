//! The `nbc` program.
#![deny(missing_docs)]

use std::process::ExitCode;

fn main() -> ExitCode {
    nbc::cli::main()
}
