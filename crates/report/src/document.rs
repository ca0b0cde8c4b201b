//! Output for programs: a JSON object with the name of its schema.

use serde::Serialize;

macro_rules! schemas {
    ($($name:ident = $word:literal, $version:literal: $meaning:literal;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Schema {
            $(#[doc = $meaning] $name,)*
        }

        impl Schema {
            pub const ALL: &[Self] = &[$(Self::$name,)*];

            pub fn word(self) -> &'static str {
                match self {
                    $(Self::$name => $word,)*
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
    Added = "added", 1: "Robots that were added to a library, and those that were not.";
    Bench = "bench", 1: "How fast a machine simulates.";
    BugReport = "bug-report", 1: "The program and the machine, for a report of a defect.";
    Build = "build", 1: "A circuit as a netlist of cells.";
    Devices = "devices", 1: "The OpenCL devices of a machine.";
    Diagnostics = "diagnostics", 2: "Errors and warnings, of any command.";
    Drawn = "drawn", 1: "A picture that was written.";
    Elites = "elites", 1: "The archive of evolution runs.";
    Evolve = "evolve", 1: "Evolution runs, and their comparison.";
    Explain = "explain", 1: "Codes of diagnostics with their pages, or the sources of the prelude.";
    Formatted = "formatted", 1: "Which files are in their canonical form.";
    Learn = "learn", 1: "A circuit that was learned from rows.";
    Library = "library", 1: "A summary of the robots of a library.";
    Play = "play", 1: "The address of a live page.";
    Player = "player", 1: "A circuit that was written as a page of its own.";
    Prove = "prove", 1: "Properties that were proved, refuted, or neither.";
    Radii = "radii", 1: "How far worlds may differ before robots make errors.";
    Robot = "robot", 1: "One robot in full.";
    Robots = "robots", 1: "The robots of a library in full.";
    Robustness = "robustness", 1: "Tests in many worlds.";
    Run = "run", 1: "The results of the tests and simulations of a file.";
    See = "see", 1: "How well bodies tell images apart.";
    Simulate = "simulate", 1: "The path of one robot.";
    Synth = "synth", 1: "A circuit made of cells.";
    Test = "test", 1: "The results of tests, row by row.";
    Verify = "verify", 1: "Robots simulated again.";
    Workers = "workers", 1: "The workers at a NATS server.";
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
