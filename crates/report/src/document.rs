//! Output for programs: a JSON object with the name of its schema.

use serde::Serialize;

macro_rules! schemas {
    ($($name:ident = $word:literal, $version:literal: $title:literal;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Schema {
            $(#[doc = $title] $name,)*
        }

        impl Schema {
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            pub fn word(self) -> &'static str {
                match self {
                    $(Self::$name => $word,)*
                }
            }

            pub fn title(self) -> &'static str {
                match self {
                    $(Self::$name => $title,)*
                }
            }

            /// The identifier: a word and a version, which increases with every incompatible change.
            pub fn id(self) -> &'static str {
                match self {
                    $(Self::$name => concat!("urn:nbc:", $word, ":", $version),)*
                }
            }
        }
    };
}

schemas! {
    Added = "added", 1: "`nbc library add`: robots that were added to a library, and those that were not";
    Bench = "bench", 1: "`nbc bench`: how fast this machine simulates, on one core";
    BugReport = "bug-report", 1: "`nbc bug-report`: the program and the machine, for a report of a defect";
    Build = "build", 1: "`nbc build`: a circuit as a netlist of cells";
    Devices = "devices", 1: "`nbc devices`: the OpenCL devices of this machine";
    Diagnostics = "diagnostics", 2: "`nbc check`, and every command that cannot do its work: errors and warnings";
    Drawn = "drawn", 1: "`nbc draw`: a picture that was written";
    Elites = "elites", 1: "`nbc export` of a run: every elite of every seed";
    Evolve = "evolve", 1: "`nbc evolve`: runs, each with its last line of progress, and their comparison";
    Explain = "explain", 1: "`nbc explain`: codes of diagnostics with their pages, or the sources of the prelude";
    Formatted = "formatted", 1: "`nbc fmt`: which files are in their canonical form";
    Learn = "learn", 1: "`nbc learn`: a circuit that was learned from rows";
    Library = "library", 1: "`nbc library list`: robots in short, best first within each function";
    Play = "play", 1: "`nbc play`: the address of a live page";
    Player = "player", 1: "`nbc play --export`: a circuit that was written as a page of its own";
    Prove = "prove", 1: "`nbc prove`: properties that were proved, refuted, or neither";
    Radii = "radii", 1: "`nbc library verify --vary`: how far worlds may differ before robots make errors";
    Robot = "robot", 1: "`nbc library show`: one robot in full, as in its file";
    Robots = "robots", 1: "`nbc export` of a library: robots in full, as in their files";
    Robustness = "robustness", 1: "`nbc test --vary`: tests in many worlds";
    Run = "run", 1: "`nbc run`, and its result.json: the results of the tests and simulations of a file";
    See = "see", 1: "`nbc see`: how well bodies tell images apart";
    Simulate = "simulate", 1: "`nbc simulate`: the path of one robot";
    Synth = "synth", 1: "`nbc synth`: a circuit made of cells";
    Test = "test", 1: "`nbc test`: the results of tests, row by row";
    Verify = "verify", 1: "`nbc library verify`: robots simulated again";
    Workers = "workers", 1: "`nbc workers`: the workers at a NATS server, and the searches that they work for";
}

#[derive(Clone, Debug, Serialize)]
pub struct Document<T> {
    schema: &'static str,
    #[serde(flatten)]
    content: T,
}

impl<T: Serialize> Document<T> {
    /// `content` must be an object.
    pub fn new(schema: Schema, content: T) -> Self {
        Self { schema: schema.id(), content }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_starts_with_its_schema() {
        let document = Document::new(Schema::Library, serde_json::json!({ "robots": [] }));
        assert_eq!(serde_json::to_string(&document).unwrap(), r#"{"schema":"urn:nbc:library:1","robots":[]}"#);
        assert!(Schema::ALL.is_sorted_by_key(|schema| schema.word()));
    }
}
