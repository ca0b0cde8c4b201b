//! `nbc export`: archives and libraries as data for other programs.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::cli::documents::RobotList;
use crate::cli::draw::{is_run, read_run};
use crate::cli::options::new_path::new_path;
use crate::cli::wording;
use crate::cli::{Context, Failure, OutputFormat, Status, robots};
use nbc_base::model::Library;
use nbc_session::report::{Document, Elites, Schema, robots_csv};
use nbc_session::store::RobotRecord;

/// Export the elites of evolution runs, or the robots of a library, as CSV or JSON
#[derive(Args)]
#[command(after_help = "Examples:
  nbc export out/gates -o elites.csv        every elite of every seed
  nbc export out/gates/seed-1 --to json     one seed
  nbc export shipped --to csv               the built-in library

docs/export.md lists the columns and shows how pandas and pyribs read them.")]
pub struct ExportArguments {
    /// The folder of a run or of one of its seeds, a folder of robot files, a robot file, or `shipped`
    what: String,
    /// The format [default: from the name of the file, else CSV]
    #[arg(long, value_enum)]
    to: Option<Target>,
    /// The file to write instead of standard output
    #[arg(short, long, value_name = "FILE", value_parser = new_path())]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Target {
    /// A table with a header and a row for each elite or robot
    Csv,
    /// All data, described in docs/schema
    Json,
}

impl ExportArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let (target, what) = (self.target(context.format)?, Path::new(&self.what));
        if is_run(what) {
            let results = read_run(what, context)?;
            let elites = Elites::of(&results);
            self.write(target, Schema::Elites, &elites, || elites.csv(), context)?;
        } else {
            let library = self.library()?;
            let robots = RobotList { robots: library.robots.iter().map(RobotRecord::of).collect() };
            self.write(target, Schema::Robots, &robots, || robots_csv(&library), context)?;
        }
        Ok(Status::Done)
    }

    fn write(
        &self,
        target: Target,
        schema: Schema,
        content: &impl Serialize,
        csv: impl Fn() -> String,
        context: &mut Context,
    ) -> Result<(), Failure> {
        match (target, &self.output) {
            (Target::Json, None) => context.print_json(schema, content),
            (Target::Json, Some(path)) => {
                let text = serde_json::to_string(&Document::new(schema, content));
                context.write(path, (text.expect("an export can be written as JSON") + "\n").as_bytes())
            }
            (_, None) => context.print(csv()),
            (_, Some(path)) => context.write(path, csv().as_bytes()),
        }
    }

    fn library(&self) -> Result<Library, Failure> {
        let found = robots::robots(Path::new(&self.what))?;
        if found.robots.is_empty() {
            return Err(wording::nothing_to_export(&self.what).into());
        }
        Ok(found)
    }

    fn target(&self, format: OutputFormat) -> Result<Target, Failure> {
        let ending = self.output.as_ref().and_then(|path| path.extension()).map(|ending| ending.to_ascii_lowercase());
        let by_name = ending.and_then(|ending| match ending.to_str() {
            Some("csv") => Some(Target::Csv),
            Some("json") => Some(Target::Json),
            _ => None,
        });
        let by_format = (format == OutputFormat::Json && self.output.is_none()).then_some(Target::Json);
        match (self.to, by_format.or(by_name)) {
            (Some(Target::Csv), Some(Target::Json)) if by_format.is_some() => {
                Err(wording::two_formats("--to csv").into())
            }
            (Some(target), _) | (None, Some(target)) => Ok(target),
            (None, None) => Ok(Target::Csv),
        }
    }
}
