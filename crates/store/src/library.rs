//! The built-in library of robots.

use std::collections::BTreeSet;

use include_dir::{Dir, include_dir};

use crate::{read_robot, wording};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Library, Robot};
use nbc_base::source::{SourceWorld, Sources};

const SHIPPED: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/library/robots");
const THREE: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/library/three");

const ENDING: &str = ".yaml";

/// The robots that come with the program, best first within each function; read afresh at each call.
pub fn shipped_library() -> Library {
    read_built_in(&[&SHIPPED])
}

/// The robots of [`shipped_library`] and those with three stimuli, best first within each function.
pub fn three_library() -> Library {
    read_built_in(&[&SHIPPED, &THREE])
}

pub fn built_in(name: &str) -> Option<Library> {
    match name {
        "shipped" => Some(shipped_library()),
        "three" => Some(three_library()),
        _ => None,
    }
}

fn read_built_in(folders: &[&Dir<'_>]) -> Library {
    let mut sources = Sources::default();
    let files =
        folders.iter().flat_map(|folder| folder.files()).filter(|file| file.path().to_string_lossy().ends_with(ENDING));
    let robots = files.map(|file| {
        let text = file.contents_utf8().expect("robot files in the program are text");
        let id = sources.add(file.path().to_string_lossy(), text);
        read_robot(sources.file(id)).unwrap_or_else(|fault| panic!("a robot file in the program is damaged: {fault:?}"))
    });
    let library = best_first(robots.collect());
    let names: BTreeSet<&str> = library.robots.iter().map(|robot| robot.name.as_str()).collect();
    assert_eq!(names.len(), library.robots.len(), "the robots in the program have different names");
    library
}

/// The robots of a folder's `.yaml` files, best first within each function.
pub fn read_library(world: &dyn SourceWorld, folder: &str) -> Result<Library, Vec<Diagnostic>> {
    let mut names = world.list(folder).map_err(|error| vec![wording::unreadable_library(folder, &error)])?;
    names.retain(|name| name.ends_with(ENDING));
    let (mut robots, mut faults) = (Vec::new(), Vec::new());
    for name in names {
        match read_member(world, &format!("{folder}/{name}")) {
            Ok(robot) => robots.push(robot),
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() { Ok(best_first(robots)) } else { Err(faults) }
}

fn read_member(world: &dyn SourceWorld, path: &str) -> Result<Robot, Diagnostic> {
    let text = world.read(path).map_err(|error| Diagnostic::unreadable(path, &error))?;
    let mut sources = Sources::default();
    let id = sources.add(path, text);
    // The caller has other texts, so a place in this one would mean nothing to it.
    read_robot(sources.file(id)).map_err(|fault| Diagnostic { labels: Vec::new(), ..fault })
}

/// A library of robots in order of their functions' bits, and within a function the most reliable first, then the
/// shortest clock, then the greatest margin.
pub fn best_first(mut robots: Vec<Robot>) -> Library {
    robots.sort_by(|a, b| {
        (a.function().cmp(&b.function())).then(a.character.compare(&b.character)).then(a.name.cmp(&b.name))
    });
    Library { robots }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print_robot;
    use crate::robot::tests::robot;
    use nbc_base::source::MemoryWorld;

    #[test]
    fn every_robot_in_the_program_reads() {
        assert!(shipped_library().robots.iter().all(|robot| robot.body.is_connected()));
    }

    #[test]
    fn a_library_in_memory_is_read_and_its_faults_are_named() {
        let mut world = MemoryWorld::default();
        world.insert("parts/one.yaml", print_robot(&robot()));
        world.insert("parts/notes.txt", "no robot");
        assert_eq!(read_library(&world, "parts").unwrap().robots, [robot()]);
        world.insert("parts/two.yaml", "format: 2");
        let faults = read_library(&world, "parts").unwrap_err();
        assert!(faults.len() == 1 && faults[0].message.contains("`parts/two.yaml`"), "{faults:?}");
        let missing = &read_library(&world, "nowhere").unwrap_err()[0].message;
        assert_eq!(missing, "cannot read the library `nowhere`: there is no such folder");
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
