//! `nbc manual`: the pages for `man`.

use std::path::PathBuf;

use clap::{Args, Command};
use clap_mangen::Man;

use crate::cli::options::new_path::new_path;
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_session::store;

/// Write the manual pages of all commands
#[derive(Args)]
#[command(after_help = "Example:\n  nbc manual ~/.local/share/man/man1 && man nbc-run")]
pub struct ManualArguments {
    /// The folder of the pages, which is made if it does not exist
    #[arg(value_parser = new_path())]
    folder: PathBuf,
}

impl ManualArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        if context.format == OutputFormat::Json {
            return Err(wording::no_json("a manual page").into());
        }
        let mut program = (context.command)();
        program.build();
        store::create_folder(&self.folder).map_err(|error| Failure::unwritable(&self.folder, &error))?;
        let mut pages = Vec::new();
        collect(&program, &mut pages);
        for page in &pages {
            let name = page.get_display_name().unwrap_or(page.get_name());
            let path = self.folder.join(format!("{name}.1"));
            let mut text = Vec::new();
            let made = Man::new(page.clone()).render(&mut text).and_then(|()| store::write(&path, &text));
            made.map_err(|error| Failure::unwritable(&path, &error))?;
        }
        context.print(format_args!("wrote {} pages to {}\n", pages.len(), self.folder.display()))?;
        Ok(Status::Done)
    }
}

fn collect(command: &Command, pages: &mut Vec<Command>) {
    pages.push(command.clone());
    let listed = command.get_subcommands().filter(|inner| inner.get_name() != "help");
    listed.for_each(|inner| collect(inner, pages));
}
