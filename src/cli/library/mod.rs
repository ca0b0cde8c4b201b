//! `nbc library`: the robots that circuits are made of.

mod add;
mod rewrite;
mod verify;

use std::path::PathBuf;

use clap::{Args, Subcommand};

use crate::cli::robots::{find, robots};
use crate::cli::{Context, Failure, OutputFormat, Status};
use crate::model::{Library, Robot};
use crate::report::{self, Listing, Schema};
use crate::store;

/// List, show, verify, add and rewrite robots
#[derive(Args)]
#[command(after_help = "Example:\n  nbc library show nand")]
pub struct LibraryArguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    Add(add::AddArguments),
    /// List all robots, best first within each function
    List,
    Rewrite(rewrite::RewriteArguments),
    /// Show one robot
    Show {
        /// The name of a robot, or a function such as `nand` for its best robot
        name: String,
    },
    /// Simulate all robots again and compare them with their files
    Verify {
        /// A robot file, or a folder of them, instead of the built-in library
        path: Option<PathBuf>,
    },
}

impl LibraryArguments {
    /// Runs the subcommand.
    ///
    /// # Errors
    /// When the output cannot be written, or no robot has the name.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let library = store::shipped_library();
        match self.action {
            Action::Add(arguments) => arguments.run(context),
            Action::List => list(&library, context),
            Action::Rewrite(arguments) => arguments.run(context),
            Action::Show { name } => show(find(&library, &name)?, context),
            Action::Verify { path: None } => verify::verify(&library, context),
            Action::Verify { path: Some(path) } => verify::verify(&robots(&path)?, context),
        }
    }
}

fn list(library: &Library, context: &mut Context) -> Result<Status, Failure> {
    let list = Listing::all(library);
    match context.format {
        OutputFormat::Json => context.print_json(Schema::Library, &serde_json::json!({ "robots": list }))?,
        OutputFormat::Text => context.print(Listing::table(&list))?,
    }
    Ok(Status::Done)
}

fn show(robot: &Robot, context: &mut Context) -> Result<Status, Failure> {
    match context.format {
        OutputFormat::Json => context.print_json(Schema::Robot, &store::RobotRecord::of(robot))?,
        OutputFormat::Text => context.print(report::describe_robot(robot))?,
    }
    Ok(Status::Done)
}
