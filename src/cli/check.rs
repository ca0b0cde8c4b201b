//! `nbc check`: prints the errors and warnings of programs.

use clap::Args;

use crate::cli::documents::DiagnosticList;
use crate::cli::{Context, Failure, OutputFormat, Status, standard_input};
use nbc_base::diag::{Severity, counted};
use nbc_session::report::Schema;
use nbc_session::store::DiskWorld;
use nbc_session::{Checked, Session};

/// Check programs and print their errors
#[derive(Args)]
#[command(after_help = "Examples:
  nbc check circuits/latch.nb
  nbc check circuits/*.nb --format json
  cat latch.nb | nbc check -

Exit status: 0 no errors, 2 errors. `nbc explain CODE` describes an error in detail.")]
pub struct CheckArguments {
    /// The source files; `-` is standard input
    #[arg(required = true)]
    files: Vec<String>,
}

impl CheckArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let mut session = Session::new(DiskWorld);
        let mut check = |path: &String| match path.as_str() {
            standard_input::DASH => {
                let path = standard_input::open(&mut session);
                session.checked(path)
            }
            path => session.checked(path),
        };
        let found: Vec<_> = self.files.iter().map(&mut check).collect();
        match context.format {
            OutputFormat::Json => {
                let diagnostics = found.iter().flat_map(|checked| checked.findings()).collect();
                context.print_json(Schema::Diagnostics, &DiagnosticList { diagnostics })?
            }
            OutputFormat::Text => {
                for checked in &found {
                    context.tell(&checked.diagnostics, &checked.sources);
                    if !checked.has_errors() {
                        context.print(describe(checked))?;
                    }
                }
            }
        }
        let has_errors = found.iter().any(|checked| checked.has_errors());
        Ok(if has_errors { Status::BadInput } else { Status::Done })
    }
}

pub(super) fn describe(checked: &Checked) -> String {
    let count = |severity| checked.diagnostics.iter().filter(|found| found.severity == severity).count();
    let errors = match count(Severity::Error) {
        0 => "no errors".to_owned(),
        errors => counted(errors, "error"),
    };
    let warnings = match count(Severity::Warning) {
        0 => String::new(),
        warnings => format!(", {}", counted(warnings, "warning")),
    };
    format!("{}: {errors}{warnings}\n", checked.path)
}
