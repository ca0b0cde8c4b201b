//! `nbc library`: the robots that circuits are made of.

mod add;
mod verify;

use clap::{Args, Subcommand};

use crate::cli::{Context, Failure, Format, Status};
use crate::diag::{Code, Diagnostic};
use crate::model::{Function, Library, Robot};
use crate::report::{self, Listing};
use crate::store;

/// List, show, verify or add the robots that circuits are made of
#[derive(Args)]
#[command(after_help = "Example:\n  nbc library show nand")]
pub struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    Add(add::Arguments),
    /// List all robots, best first within each function
    List,
    /// Show one robot
    Show {
        /// The robot's name, or a function such as `nand` for its best robot
        name: String,
    },
    /// Simulate every robot again and compare it with its file
    Verify,
}

impl Arguments {
    /// Prints what is asked for.
    ///
    /// # Errors
    /// When the output cannot be written, or no robot has the name.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let library = store::shipped_library();
        match self.action {
            Action::Add(arguments) => arguments.run(context),
            Action::List => list(library, context),
            Action::Show { name } => show(find(library, &name)?, context),
            Action::Verify => verify::verify(library, context),
        }
    }
}

fn list(library: &Library, context: &mut Context) -> Result<Status, Failure> {
    let list = Listing::all(library);
    match context.format {
        Format::Json => context.print_json(&list)?,
        Format::Text => context.print(Listing::table(&list))?,
    }
    Ok(Status::Done)
}

fn show(robot: &Robot, context: &mut Context) -> Result<Status, Failure> {
    match context.format {
        Format::Json => context.print_json(robot)?,
        Format::Text => context.print(report::describe_robot(robot))?,
    }
    Ok(Status::Done)
}

/// The robot of that name, else the best one of the function of that name.
pub(super) fn find<'a>(library: &'a Library, name: &str) -> Result<&'a Robot, Failure> {
    let named = library.robots.iter().find(|robot| robot.name == name);
    let best = || Function::parse(name).and_then(|function| library.robots_for(function).next());
    named.or_else(best).ok_or_else(|| {
        let message = format!("no robot of the library is called `{name}`");
        let fault = Diagnostic::without_place(Code::UnknownRobot, message);
        Failure::plain(
            fault.with_help("`nbc library list` lists the robots; a function such as `nand` names its best one"),
        )
    })
}
