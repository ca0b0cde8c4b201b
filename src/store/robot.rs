//! Robot files: a [`Robot`] as YAML with a format version.

use serde::{Deserialize, Serialize};

use crate::diag::{Code, Diagnostic};
use crate::model::{Behavior, Body, Character, Genotype, Palette, Provenance, Robot};
use crate::source::SourceFile;
use crate::store::{shape, yaml};

/// The version of robot files that this program writes and reads.
pub const FORMAT: u32 = 1;

/// A robot as data: the fields of its file, in the order in which they are written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotRecord {
    format: u32,
    name: String,
    behavior: Behavior,
    body: Vec<String>,
    displacement: [f64; 4],
    character: Character,
    provenance: Provenance,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    genotype: Option<Genotype>,
}

/// The one field that every version has.
#[derive(Deserialize)]
#[serde(expecting = "a mapping with the fields of a robot")]
struct Version {
    format: u32,
}

/// A robot as the text of its file.
pub fn print_robot(robot: &Robot) -> String {
    serde_yaml::to_string(&RobotRecord::of(robot)).expect("a robot has nothing that YAML cannot say")
}

impl RobotRecord {
    /// A robot as data.
    pub fn of(robot: &Robot) -> Self {
        let robot = robot.clone();
        Self {
            format: FORMAT,
            name: robot.name,
            behavior: robot.behavior,
            body: robot.body.rows(),
            displacement: robot.displacement,
            character: robot.character,
            provenance: robot.provenance,
            genotype: robot.genotype,
        }
    }
}

/// Reads a robot file.
///
/// # Errors
/// A diagnostic with its place for text that is no YAML, for missing, unknown or wrong fields, for a body that is none, and for the file
/// of another version.
pub fn read_robot(file: &SourceFile) -> Result<Robot, Diagnostic> {
    let read_fault = |error| yaml::fault(file, &error);
    let version: Version = serde_yaml::from_str(&file.text).map_err(read_fault)?;
    if version.format != FORMAT {
        return Err(foreign(file, version.format));
    }
    let read: RobotRecord = serde_yaml::from_str(&file.text).map_err(read_fault)?;
    let body = Body::parse(&read.body, &Palette::paper()).map_err(|error| shape::fault(file, &read.body, &error))?;
    Ok(Robot {
        name: read.name,
        behavior: read.behavior,
        body,
        displacement: read.displacement,
        character: read.character,
        provenance: read.provenance,
        genotype: read.genotype,
    })
}

fn foreign(file: &SourceFile, format: u32) -> Diagnostic {
    let message = format!("`{}` is a robot file of format {format}, expected format {FORMAT}", file.name);
    Diagnostic::new(Code::ForeignFormat, message, yaml::key_span(file, "format"), "written by another version of nbc")
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::model::{Pattern, Transition};
    use crate::source::Sources;

    /// A robot with every field filled.
    pub(crate) fn robot() -> Robot {
        let body = Body::parse(&["00345", "33333"], &Palette::paper()).unwrap();
        Robot {
            name: "nand_1".to_owned(),
            behavior: "RRRL".parse().unwrap(),
            body,
            displacement: [1.0, 0.1 + 0.2, 3.0, -4.0e-7],
            character: Character {
                clock: 4,
                switches: 1000,
                error_rate: 0.001,
                glitch_rate: 0.0,
                margin: 0.25,
                topples: false,
                settle: vec![Transition { from: Pattern::PAIRS[1], to: Pattern::PAIRS[3], cycles: 2 }],
            },
            provenance: Provenance {
                program: "nbc".to_owned(),
                version: "0.1.0".to_owned(),
                evolution: "gates".to_owned(),
                seed: 1,
                generation: 2,
                evaluations: 3,
            },
            genotype: None,
        }
    }

    fn read(text: &str) -> Result<Robot, (Code, String, String)> {
        let mut sources = Sources::default();
        let id = sources.add("a.yaml", text);
        read_robot(sources.file(id))
            .map_err(|fault| (fault.code, fault.message, sources.text(fault.labels[0].span).to_owned()))
    }

    #[test]
    fn a_robot_reads_back_bit_for_bit() {
        assert_eq!(read(&print_robot(&robot())), Ok(robot()));
    }

    #[test]
    fn another_version_is_refused_as_such() {
        let (code, message, place) = read(&print_robot(&robot()).replace("format: 1", "format: 7")).unwrap_err();
        assert_eq!(code, Code::ForeignFormat);
        assert_eq!(message, "`a.yaml` is a robot file of format 7, expected format 1");
        assert_eq!(place, "format");
    }

    #[test]
    fn damage_is_named() {
        let whole = print_robot(&robot());
        let check = |from: &str, to: &str, expected: &str| {
            let damaged = whole.replace(from, to);
            assert_ne!(damaged, whole, "{from:?} is in the file");
            let (_, message, _) = read(&damaged).unwrap_err();
            assert!(message.contains(expected), "{message:?} does not say {expected:?}");
        };
        check("behavior: RRRL\n", "", "missing field `behavior`");
        check("behavior: RRRL", "behavior: RRRX", "`RRRX` is no behavior");
        check("- '00345'", "- '0034'", "row 2 has 5 voxels, expected 4");
        check("- '00345'", "- '0034x'", "`x` is no material");
        check("format: 1\n", "", "missing field `format`");
        check("name: ", "nom: ", "unknown field `nom`");
        check("clock: 4", "clock: four", "expected u32");
    }

    #[test]
    fn a_file_cut_short_anywhere_is_refused_without_a_panic() {
        let whole = print_robot(&robot());
        let end = whole.find("evaluations").unwrap();
        for length in 0..end {
            assert!(read(&whole[..length]).is_err(), "cut to {length} bytes it was read");
        }
    }
}
