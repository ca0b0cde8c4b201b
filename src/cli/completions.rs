//! `nbc completions`: completion scripts for shells.

use clap::Args;
use clap_complete::Shell;

use crate::cli::wording::UsageError;
use crate::cli::{Context, Failure, OutputFormat, Status};

/// Print a completion script for a shell
#[derive(Args)]
#[command(after_help = "Example:\n  mkdir -p ~/.local/share/bash-completion/completions\n  nbc completions bash > \
                         ~/.local/share/bash-completion/completions/nbc")]
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
            return Err(UsageError::NoJson { what: "a completion script" }.into());
        }
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut (context.command)(), "nbc", &mut script);
        context.print(String::from_utf8_lossy(&script))?;
        Ok(Status::Done)
    }
}
