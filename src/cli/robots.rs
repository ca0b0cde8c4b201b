//! Robots and bodies that the command line names.

use std::path::{Path, PathBuf};

use crate::cli::Failure;
use crate::cli::options::robots::RobotsArguments;
use crate::cli::wording;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Body, Function, Library, Robot};
use nbc_base::source::{FileError, FileId, Sources};
use nbc_session::store::{self, DiskWorld};

/// The robot of a folder or of the built-in library. Without a folder, the name may be that of a robot file.
pub(super) fn named(name: &str, library: Option<&Path>) -> Result<Robot, Failure> {
    let path = Path::new(name);
    if library.is_none() && path.is_file() {
        return Ok(robots(path)?.robots.remove(0));
    }
    let library = library.map_or_else(|| Ok(store::shipped_library()), robots_of)?;
    find(&library, name).cloned()
}

pub(super) fn named_library(arguments: &RobotsArguments) -> Result<Library, Failure> {
    arguments.library.as_deref().map_or_else(|| Ok(store::shipped_library()), robots_of)
}

/// The body in a file or, without such a file, that of a robot of the library.
pub(super) fn read_body(robot: &str, library: &RobotsArguments) -> Result<Body, Failure> {
    let mut sources = Sources::default();
    match store::read_text(Path::new(robot), Limit::RobotBytes.most()) {
        Ok(text) => {
            let id = sources.add(robot, text);
            store::read_body(sources.file(id)).map_err(|fault| Failure::input(vec![fault], sources))
        }
        Err(FileError::NotFound) if !robot.contains(['/', '.']) => {
            find(&named_library(library)?, robot).map(|robot| robot.body.clone())
        }
        Err(error) => Err(Diagnostic::unreadable_in(&DiskWorld, robot, &error).into()),
    }
}

/// The robot with that name, else the best robot for the function with that name.
pub(super) fn find<'a>(library: &'a Library, name: &str) -> Result<&'a Robot, Failure> {
    let named = library.robots.iter().find(|robot| robot.name == name);
    let best = || Function::parse(name).and_then(|function| library.robots_for(function).next());
    named.or_else(best).ok_or_else(|| {
        let functions = library.robots.iter().map(|robot| robot.function().name());
        let names = library.robots.iter().map(|robot| robot.name.as_str());
        wording::unknown_robot(name, names.chain(functions)).into()
    })
}

/// As [`robots`], but not empty.
pub(super) fn robots_of(path: &Path) -> Result<Library, Failure> {
    let found = robots(path)?;
    if found.robots.is_empty() {
        return Err(wording::no_robots(path).into());
    }
    Ok(found)
}

/// The robots of a file, of every robot file of a folder, or of a built-in library.
pub(super) fn robots(path: &Path) -> Result<Library, Failure> {
    if let Some(library) = path.to_str().and_then(store::built_in) {
        return Ok(library);
    }
    let mut sources = Sources::default();
    let mut found = Vec::new();
    for path in robot_paths(path)? {
        let id = read_source(&path, &mut sources)?;
        match store::read_robot(sources.file(id)) {
            Ok(robot) => found.push(robot),
            Err(diagnostic) => return Err(Failure::input(vec![diagnostic], sources)),
        }
    }
    Ok(store::best_first(found))
}

/// Adds a file of a robot or a body to the sources.
pub(super) fn read_source(path: &Path, sources: &mut Sources) -> Result<FileId, Failure> {
    let name = path.display().to_string();
    let text = store::read_text(path, Limit::RobotBytes.most());
    let text = text.map_err(|error| Diagnostic::unreadable_in(&DiskWorld, &name, &error))?;
    Ok(sources.add(&name, text))
}

/// A robot file itself, or every robot file of a folder.
pub(super) fn robot_paths(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let entries = std::fs::read_dir(path).map_err(|error| wording::unreadable(path, &error))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "yaml"));
    paths.sort();
    Ok(paths)
}
