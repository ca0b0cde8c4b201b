//! `nbc check`: what is wrong with programs.

use clap::Args;
use serde_json::Value;

use crate::cli::{Context, Failure, OutputFormat, Status};
use crate::report::Schema;
use crate::session::Session;
use crate::store::DiskWorld;

/// Check programs and print their errors
#[derive(Args)]
#[command(after_help = "Examples:
  nbc check circuits/latch.nb
  nbc check circuits/*.nb --format json

Exit status: 0 no errors, 2 errors. `nbc explain CODE` describes an error in detail.")]
pub struct CheckArguments {
    /// The source files
    #[arg(required = true)]
    files: Vec<String>,
}

impl CheckArguments {
    /// Checks and prints.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let mut session = Session::new(DiskWorld);
        let found: Vec<_> = self.files.iter().map(|path| session.checked(path)).collect();
        match context.format {
            OutputFormat::Json => {
                let all: Vec<Value> = found.iter().flat_map(|checked| checked.json()).collect();
                context.print_json(Schema::Diagnostics, &serde_json::json!({ "diagnostics": all }))?
            }
            OutputFormat::Text => found.iter().for_each(|checked| context.tell(&checked.diagnostics, &checked.sources)),
        }
        let has_errors = found.iter().any(|checked| checked.has_errors());
        Ok(if has_errors { Status::BadInput } else { Status::Done })
    }
}
