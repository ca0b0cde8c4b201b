//! `nbc library`: the robots that circuits are made of.

mod add;
mod radius;
mod rewrite;
mod verify;

use std::path::PathBuf;

use clap::{Args, Subcommand};

use crate::cli::device::DeviceArguments;
use crate::cli::nats_access::QueueArguments;
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
        #[command(flatten)]
        radius: radius::RadiusArguments,
        #[command(flatten)]
        device: DeviceArguments,
        #[command(flatten)]
        queue: QueueArguments,
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
            Action::Verify { path, radius, device, queue } => {
                let library = path.as_ref().map_or(Ok(library), |path| robots(path))?;
                match radius.sample() {
                    Some(sample) => radius.run(&library, path.as_deref(), sample, context),
                    None => verify::verify(&library, device, &queue, context),
                }
            }
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
