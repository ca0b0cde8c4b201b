//! `nbc completions`: completion scripts for shells.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;

use crate::cli::options::new_path::new_path;
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_session::store;

/// Print a completion script for a shell
#[derive(Args)]
#[command(after_help = "Example:\n  nbc completions bash -o ~/.local/share/bash-completion/completions/nbc")]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
    /// The file to write instead of standard output; its folder is made if it does not exist
    #[arg(short, long, value_name = "OUT", value_parser = new_path())]
    output: Option<PathBuf>,
}

impl CompletionsArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        if context.format == OutputFormat::Json {
            return Err(wording::no_json("a completion script").into());
        }
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut (context.command)(), "nbc", &mut script);
        match &self.output {
            None => context.print(String::from_utf8_lossy(&script))?,
            Some(path) => {
                if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
                    store::create_folder(folder).map_err(|error| Failure::unwritable(folder, &error))?;
                }
                context.write(path, &script)?;
            }
        }
        Ok(Status::Done)
    }
}
