//! `nbc library`: the robots that circuits are made of.

pub(super) mod add;
mod measured;
mod radius;
mod verify;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::cli::documents::RobotList;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::queue::QueueArguments;
use crate::cli::robots::{named, robots_of};
use crate::cli::{Context, Failure, Status};
use nbc_base::model::{Library, Robot};
use nbc_session::report::{self, Listing, Schema};
use nbc_session::store;

/// List, show, verify and add robots
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc library list                      the built-in robots
  nbc library list out/gates/robots     those of a folder
  nbc library show nand
  nbc library show nand out/gates/robots")]
pub struct LibraryArguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    Add(add::AddArguments),
    /// List all robots, best first within each function
    List {
        /// A robot file, or a folder of them, instead of the built-in library
        path: Option<PathBuf>,
    },
    /// Show one robot
    Show {
        /// The name of a robot, a function such as `nand` for its best robot, or a robot file
        name: String,
        /// A folder of robot files, instead of the built-in library
        path: Option<PathBuf>,
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
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let library = |path: Option<&Path>| path.map_or_else(|| Ok(store::shipped_library()), robots_of);
        match self.action {
            Action::Add(arguments) => arguments.run(context),
            Action::List { path } => list(&library(path.as_deref())?, context),
            Action::Show { name, path } => show(&named(&name, path.as_deref())?, context),
            Action::Verify { path, radius, device, queue } => {
                let library = library(path.as_deref())?;
                match radius.changes() {
                    Some(changes) => radius.run(&library, path.as_deref(), changes, context),
                    None => verify::verify(&library, device, &queue, context),
                }
            }
        }
    }
}

fn list(library: &Library, context: &mut Context) -> Result<Status, Failure> {
    let list = RobotList { robots: Listing::all(library) };
    context.print_result(Schema::Library, &list, || Listing::table(&list.robots))?;
    Ok(Status::Done)
}

fn show(robot: &Robot, context: &mut Context) -> Result<Status, Failure> {
    context.print_result(Schema::Robot, &store::RobotRecord::of(robot), || report::describe_robot(robot))?;
    Ok(Status::Done)
}
