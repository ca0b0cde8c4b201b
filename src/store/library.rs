//! The built-in library of robots.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::diag::{Code, Diagnostic};
use crate::model::{Library, Robot};
use crate::source::Sources;
use crate::store::{MAX_ROBOT_BYTES, read_robot, read_text};

static FILES: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/library/robots");

static SHIPPED: LazyLock<Library> = LazyLock::new(|| {
    let mut sources = Sources::default();
    let files = FILES.files().filter(|file| file.path().extension().is_some_and(|extension| extension == "yaml"));
    let robots = files.map(|file| {
        let text = file.contents_utf8().expect("robot files in the program are text");
        let id = sources.add(file.path().to_string_lossy(), text);
        read_robot(sources.file(id)).unwrap_or_else(|fault| panic!("a robot file in the program is damaged: {fault:?}"))
    });
    let library = best_first(robots.collect());
    let names: BTreeSet<&str> = library.robots.iter().map(|robot| robot.name.as_str()).collect();
    assert_eq!(names.len(), library.robots.len(), "the robots in the program have different names");
    library
});

/// The built-in robots, best first within each function; read at the first call.
pub fn shipped_library() -> &'static Library {
    &SHIPPED
}

/// The robots of a folder's `.yaml` files, best first within each function.
///
/// # Errors
/// What is wrong with the folder or its files; several faults where several files are wrong.
pub fn read_library(folder: &str) -> Result<Library, Vec<Diagnostic>> {
    let unreadable = |error: std::io::Error| {
        let message = format!("cannot read the library `{folder}`: {}", error.to_string().to_lowercase());
        vec![Diagnostic::without_place(Code::Unreadable, message)]
    };
    let entries = std::fs::read_dir(folder).and_then(|entries| entries.collect::<Result<Vec<_>, _>>());
    let mut paths: Vec<_> = entries.map_err(unreadable)?.into_iter().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "yaml"));
    paths.sort();
    let (mut robots, mut faults) = (Vec::new(), Vec::new());
    for path in paths {
        let name = path.display().to_string();
        let mut sources = Sources::default();
        let robot =
            read_text(&path, MAX_ROBOT_BYTES).map_err(|error| Diagnostic::unreadable(&name, &error)).and_then(|text| {
                let id = sources.add(&name, text);
                // The place is dropped, because the caller does not have this text.
                read_robot(sources.file(id)).map_err(|fault| Diagnostic { labels: Vec::new(), ..fault })
            });
        match robot {
            Ok(robot) => robots.push(robot),
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() { Ok(best_first(robots)) } else { Err(faults) }
}

/// A library of robots in order of their functions' bits. Within a function, the most reliable come first, then those
/// with the shortest clock, then those with the largest margin.
pub fn best_first(mut robots: Vec<Robot>) -> Library {
    robots.sort_by(|a, b| {
        (a.function().cmp(&b.function())).then(a.character.compare(&b.character)).then(a.name.cmp(&b.name))
    });
    Library { robots }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::robot::tests::robot;

    #[test]
    fn every_robot_in_the_program_reads() {
        assert!(shipped_library().robots.iter().all(|robot| robot.body.is_connected()));
    }

    #[test]
    fn the_best_robot_of_a_function_comes_first() {
        let with = |name: &str, behavior: &str, error_rate, clock, margin| {
            let mut robot = Robot { name: name.to_owned(), behavior: behavior.parse().unwrap(), ..robot() };
            (robot.character.error_rate, robot.character.clock, robot.character.margin) = (error_rate, clock, margin);
            robot
        };
        let library = best_first(vec![
            with("slow", "RRRL", 0.0, 4, 0.9),
            with("wrong", "RRRL", 0.1, 1, 0.9),
            with("weak", "RRRL", 0.0, 2, 0.1),
            with("good", "RRRL", 0.0, 2, 0.2),
            with("other", "RLLL", 0.5, 9, 0.0),
        ]);
        let names: Vec<&str> = library.robots.iter().map(|robot| robot.name.as_str()).collect();
        assert_eq!(names, ["other", "good", "weak", "slow", "wrong"]);
    }
}
