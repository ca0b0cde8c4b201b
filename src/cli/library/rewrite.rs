//! `nbc library rewrite`: robot files in the newest format.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use crate::cli::robots::{read_source, robot_paths};
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status};
use nbc_base::diag::counted;
use nbc_base::source::Sources;
use nbc_session::report::Schema;
use nbc_session::store;

/// Convert robot files to the newest format
#[derive(Args)]
#[command(after_help = "Example:\n  nbc library rewrite library/robots")]
pub struct RewriteArguments {
    /// Robot files, or folders of them
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
}

#[derive(Serialize)]
struct Rewritten {
    path: String,
    changed: bool,
}

impl RewriteArguments {
    /// Reads all files before it writes the first one.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let mut files = Vec::new();
        for path in &self.paths {
            let found = robot_paths(path)?;
            if found.is_empty() {
                return Err(wording::no_robots(path).into());
            }
            for path in found {
                let (old, new) = texts(&path)?;
                files.push((path, old != new, new));
            }
        }
        for (path, _, text) in files.iter().filter(|(_, changed, _)| *changed) {
            store::write(path, text.as_bytes()).map_err(|error| Failure::unwritable(path, &error))?;
        }
        let written = |(path, changed, _): &(PathBuf, bool, String)| Rewritten {
            path: path.display().to_string(),
            changed: *changed,
        };
        let done: Vec<Rewritten> = files.iter().map(written).collect();
        match context.format {
            OutputFormat::Json => context.print_json(Schema::Rewritten, &serde_json::json!({ "files": done }))?,
            OutputFormat::Text => {
                let changed = done.iter().filter(|file| file.changed).count();
                context.print(format_args!("{changed} of {} rewritten\n", counted(done.len(), "robot file")))?;
            }
        }
        Ok(Status::Done)
    }
}

/// The text of a robot file, and its text in the newest format.
fn texts(path: &Path) -> Result<(String, String), Failure> {
    let mut sources = Sources::default();
    let id = read_source(path, &mut sources)?;
    let file = sources.file(id);
    match store::read_robot(file) {
        Ok(robot) => Ok((file.text.clone(), store::print_robot(&robot))),
        Err(fault) => Err(Failure::input(vec![fault], sources)),
    }
}
