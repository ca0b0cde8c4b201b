//! `nbc check`: what is wrong with programs.

use clap::Args;

use crate::check;
use crate::cli::{Context, Failure, Format, Status};
use crate::diag::{Diagnostic, json};
use crate::report::Schema;
use crate::source::Sources;
use crate::store::DiskWorld;

/// Check programs and print their errors
#[derive(Args)]
#[command(after_help = "Examples:
  nbc check circuits/latch.nb
  nbc check circuits/*.nb --format json

Exit status: 0 no errors, 2 errors. `nbc explain CODE` describes an error in detail.")]
pub struct Arguments {
    /// The source files
    #[arg(required = true)]
    files: Vec<String>,
}

impl Arguments {
    /// Checks and prints.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let mut sources = Sources::default();
        let mut all: Vec<Diagnostic> = Vec::new();
        for path in &self.files {
            match check::open(&DiskWorld, path, &mut sources) {
                Ok(file) => all.extend(check::check(&DiskWorld, &mut sources, file).diagnostics),
                Err(fault) => all.push(fault),
            }
        }
        let status = if all.iter().any(Diagnostic::is_error) { Status::BadInput } else { Status::Done };
        match context.format {
            Format::Json => {
                context.print_json(Schema::Diagnostics, &serde_json::json!({ "diagnostics": json(&all, &sources) }))?
            }
            Format::Text => context.tell(&all, &sources),
        }
        Ok(status)
    }
}
