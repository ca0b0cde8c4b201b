//! `nbc manual`: the pages for `man`, and the reference of commands in docs/commands.md.

mod markdown;

use std::path::PathBuf;

use clap::{Args, Command};
use clap_mangen::Man;

use crate::cli::options::new_path::new_path;
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_session::store;

/// Write the manual pages of all commands
#[derive(Args)]
#[command(after_help = "Examples:
  nbc manual ~/.local/share/man/man1 && man nbc-run
  nbc manual docs/commands.md               one page, as in the manual")]
pub struct ManualArguments {
    /// The folder of the pages, which is made if it does not exist; or a file that ends in .md, for one page in
    /// Markdown
    #[arg(value_name = "FOLDER", value_parser = new_path())]
    place: PathBuf,
}

impl ManualArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        if context.format == OutputFormat::Json {
            return Err(wording::no_json("a manual page").into());
        }
        let mut program = (context.command)();
        program.build();
        if self.place.extension().is_some_and(|extension| extension == "md") {
            let page = markdown::page(&program);
            store::write(&self.place, page.as_bytes()).map_err(|error| Failure::unwritable(&self.place, &error))?;
            context.print(format_args!("wrote {}\n", self.place.display()))?;
            return Ok(Status::Done);
        }
        store::create_folder(&self.place).map_err(|error| Failure::unwritable(&self.place, &error))?;
        let mut pages = Vec::new();
        collect(&program, &mut pages);
        for page in &pages {
            let name = page.get_display_name().unwrap_or(page.get_name());
            let path = self.place.join(format!("{name}.1"));
            let text = page_of(page).map_err(|error| Failure::unwritable(&path, &error))?;
            store::write(&path, &text).map_err(|error| Failure::unwritable(&path, &error))?;
        }
        context.print(format_args!("wrote {} pages to {}\n", pages.len(), self.place.display()))?;
        Ok(Status::Done)
    }
}

fn page_of(command: &Command) -> std::io::Result<Vec<u8>> {
    let mut text = Vec::new();
    Man::new(command.clone()).render(&mut text)?;
    Ok(text)
}

fn collect(command: &Command, pages: &mut Vec<Command>) {
    pages.push(command.clone());
    let is_here = |inner: &&Command| inner.get_name() != "help" && !inner.is_hide_set();
    command.get_subcommands().filter(is_here).for_each(|inner| collect(inner, pages));
}
