//! `nbc completions`: completion scripts for shells.

use clap::Args;
use clap_complete::Shell;

use crate::cli::{Context, Failure, OutputFormat, Status};
use crate::diag::{Code, Diagnostic};

/// Print a completion script for a shell
#[derive(Args)]
#[command(after_help = "Example:\n  nbc completions bash > ~/.local/share/bash-completion/completions/nbc")]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

impl CompletionsArguments {
    /// Prints the script.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        if context.format == OutputFormat::Json {
            let fault = Diagnostic::without_place(Code::BadValue, "a completion script cannot be JSON");
            return Err(Failure::plain(fault.with_help("leave out `--format json`")));
        }
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut (context.command)(), "nbc", &mut script);
        context.print(String::from_utf8_lossy(&script))?;
        Ok(Status::Done)
    }
}
