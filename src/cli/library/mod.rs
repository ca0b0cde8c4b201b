//! `nbc library`: the robots that circuits are made of.

mod add;
mod rewrite;
mod verify;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use crate::cli::synth::unreadable;
use crate::cli::{Context, Failure, Format, Status};
use crate::diag::{Code, Diagnostic};
use crate::model::{Function, Library, Robot};
use crate::report::{self, Listing, Schema};
use crate::source::Sources;
use crate::store;

/// List, show, verify, add and rewrite robots
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
    Rewrite(rewrite::Arguments),
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

impl Arguments {
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

/// The robot file of that name, or every robot file of the folder of that name.
fn robot_paths(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let entries = std::fs::read_dir(path).map_err(|error| unreadable(path, &error))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "yaml"));
    paths.sort();
    Ok(paths)
}

/// The robots of a file, or of every robot file of a folder.
pub(super) fn robots(path: &Path) -> Result<Library, Failure> {
    let mut sources = Sources::default();
    let mut found = Vec::new();
    for path in robot_paths(path)? {
        let name = path.display().to_string();
        let text = store::read_text(&path, store::MAX_ROBOT_BYTES);
        let text = text.map_err(|error| Failure::plain(Diagnostic::unreadable(&name, &error)))?;
        let id = sources.add(&name, text);
        match store::read_robot(sources.file(id)) {
            Ok(robot) => found.push(robot),
            Err(diagnostic) => return Err(Failure::input(vec![diagnostic], sources)),
        }
    }
    Ok(store::best_first(found))
}

fn list(library: &Library, context: &mut Context) -> Result<Status, Failure> {
    let list = Listing::all(library);
    match context.format {
        Format::Json => context.print_json(Schema::Library, &serde_json::json!({ "robots": list }))?,
        Format::Text => context.print(Listing::table(&list))?,
    }
    Ok(Status::Done)
}

fn show(robot: &Robot, context: &mut Context) -> Result<Status, Failure> {
    match context.format {
        Format::Json => context.print_json(Schema::Robot, &store::RobotRecord::of(robot))?,
        Format::Text => context.print(report::describe_robot(robot))?,
    }
    Ok(Status::Done)
}

/// The robot with that name, else the best robot for the function with that name.
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
