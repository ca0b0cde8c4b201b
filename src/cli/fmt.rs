//! `nbc fmt`: programs in their canonical form.

use std::path::Path;

use clap::Args;
use serde::Serialize;

use crate::cli::standard_input::{self, DASH};
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_session::report::Schema;
use nbc_session::store::{self, DiskWorld};
use nbc_session::{Formatted, Session};

/// Format programs
#[derive(Args)]
#[command(after_help = "Examples:
  nbc fmt circuits/latch.nb
  nbc fmt --check circuits/*.nb
  nbc fmt - < draft.nb                  standard input to standard output

Exit status: 0 done, 1 with --check if a file is not formatted, 2 if a file cannot be parsed.")]
pub struct FmtArguments {
    /// The source files; `-` formats standard input and prints the result
    #[arg(required = true)]
    files: Vec<String>,
    /// List the files that would change, and change nothing
    #[arg(long)]
    check: bool,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct FormattedFiles {
    files: Vec<FormattedFile>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct FormattedFile {
    file: String,
    /// Whether it was in its canonical form.
    canonical: bool,
    /// Whether it was written in it.
    written: bool,
}

impl FmtArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let mut files = Vec::new();
        for path in &self.files {
            if path == DASH && !self.check {
                if context.format == OutputFormat::Json {
                    return Err(wording::two_formats(DASH).into());
                }
                context.print(&format_input()?.text)?;
                continue;
            }
            let canonical = self.format_file(path)?;
            if self.check && !canonical && context.format == OutputFormat::Text {
                context.print(format!("{path}\n"))?;
            }
            files.push(FormattedFile { file: path.clone(), canonical, written: !canonical && !self.check });
        }
        let differs = files.iter().any(|file| !file.canonical);
        if context.format == OutputFormat::Json {
            context.print_json(Schema::Formatted, &FormattedFiles { files })?;
        }
        Ok(if self.check && differs { Status::TestFailed } else { Status::Done })
    }

    /// Returns whether it was formatted.
    fn format_file(&self, path: &str) -> Result<bool, Failure> {
        let Formatted { text, is_canonical } = match path {
            DASH => format_input()?,
            path => Session::new(DiskWorld).formatted(path)?,
        };
        if !is_canonical && !self.check {
            let path = Path::new(path);
            store::write(path, text.as_bytes()).map_err(|error| Failure::unwritable(path, &error))?;
        }
        Ok(is_canonical)
    }
}

fn format_input() -> Result<Formatted, Failure> {
    let mut session = Session::new(DiskWorld);
    let path = standard_input::open(&mut session);
    Ok(session.formatted(path)?)
}
