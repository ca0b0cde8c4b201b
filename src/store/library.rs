//! The robots that come with the program.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use include_dir::{Dir, include_dir};

use crate::model::{Library, Robot};
use crate::source::Sources;
use crate::store::read_robot;

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

/// The robots that come with the program, best first within each function; read when first asked for.
pub fn shipped_library() -> &'static Library {
    &SHIPPED
}

/// A library of robots in order of their functions' bits, and within a function the most reliable first, then the shortest clock, then
/// the greatest margin.
pub fn best_first(mut robots: Vec<Robot>) -> Library {
    robots.sort_by(|a, b| {
        let (left, right) = (&a.character, &b.character);
        (a.function().cmp(&b.function()))
            .then(left.error_rate.total_cmp(&right.error_rate))
            .then(left.clock.cmp(&right.clock))
            .then(right.margin.total_cmp(&left.margin))
            .then(a.name.cmp(&b.name))
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
