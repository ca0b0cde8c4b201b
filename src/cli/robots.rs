//! Robots and bodies that the command line names.

use std::path::{Path, PathBuf};

use crate::cli::Failure;
use crate::cli::wording::UsageError;
use crate::diag::Diagnostic;
use crate::model::{Body, Function, Library, Robot};
use crate::source::{FileError, Sources};
use crate::store;

/// The body in a file or, if there is no such file, that of a robot of the library.
pub(super) fn read_body(robot: &str) -> Result<Body, Failure> {
    let mut sources = Sources::default();
    match store::read_text(Path::new(robot), store::MAX_ROBOT_BYTES) {
        Ok(text) => {
            let id = sources.add(robot, text);
            store::read_body(sources.file(id)).map_err(|fault| Failure::input(vec![fault], sources))
        }
        Err(FileError::NotFound) if !robot.contains(['/', '.']) => {
            find(&store::shipped_library(), robot).map(|robot| robot.body.clone())
        }
        Err(error) => Err(Failure::plain(Diagnostic::unreadable(robot, &error))),
    }
}

/// The robot with that name, else the best robot for the function with that name.
pub(super) fn find<'a>(library: &'a Library, name: &str) -> Result<&'a Robot, Failure> {
    let named = library.robots.iter().find(|robot| robot.name == name);
    let best = || Function::parse(name).and_then(|function| library.robots_for(function).next());
    named.or_else(best).ok_or_else(|| UsageError::UnknownRobot { name: name.to_owned() }.into())
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

/// The robot file of that name, or every robot file of the folder of that name.
pub(super) fn robot_paths(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let entries = std::fs::read_dir(path).map_err(|error| Failure::unreadable(path, &error))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "yaml"));
    paths.sort();
    Ok(paths)
}
