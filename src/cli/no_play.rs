//! `nbc play` in a program that was built without it.

use std::ffi::OsString;

use clap::Args;

use crate::cli::wording::NoPage;
use crate::cli::{Context, Failure, Status};

/// Show robots live in a browser (not in this build)
#[derive(Args)]
pub struct NoPlayArguments {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    rest: Vec<OsString>,
}

pub use NoPlayArguments as PlayArguments;

impl NoPlayArguments {
    /// Says how to get it.
    ///
    /// # Errors
    /// Always.
    pub fn run(self, _context: &mut Context) -> Result<Status, Failure> {
        let _ = self.rest;
        Err(NoPage.into())
    }
}
