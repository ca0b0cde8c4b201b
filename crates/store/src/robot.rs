//! Robot files: a [`Robot`] as YAML with a format version.

use std::sync::Arc;

use serde::{Deserialize, Deserializer, Serialize, de::Error};
use serde_yaml::Value;
use serde_yaml::with::singleton_map_recursive;

use crate::{shape, soundness, wording, yaml};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Behavior, Character, Displacements, Genotype, Palette, Provenance, Robot};
use nbc_base::source::SourceFile;

/// The version of robot files.
pub const FORMAT: u32 = 2;

/// A robot as data: the fields of its file, in the order in which they are written.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RobotRecord {
    /// The version of robot files.
    format: u32,
    name: String,
    behavior: Behavior,
    /// Rows of material codes, top row first; 0 is empty.
    body: Vec<String>,
    /// In order of their codes; left out when they are the paper's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    materials: Option<Arc<Palette>>,
    displacement: Displacements,
    character: Character,
    provenance: Provenance,
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        serialize_with = "singleton_map_recursive::serialize",
        deserialize_with = "genotype"
    )]
    /// The network that the body was developed from.
    #[cfg_attr(feature = "schema", schemars(with = "serde_json::Map<String, serde_json::Value>"))]
    genotype: Option<Genotype>,
}

/// The one field that every version has.
#[derive(Deserialize)]
#[serde(expecting = "a mapping with the fields of a robot")]
struct Version {
    format: u32,
}

pub fn print_robot(robot: &Robot) -> String {
    yaml::print(&RobotRecord::of(robot))
}

impl RobotRecord {
    pub fn of(robot: &Robot) -> Self {
        let robot = robot.clone();
        Self {
            format: FORMAT,
            name: robot.name,
            behavior: robot.behavior,
            body: robot.body.rows(),
            materials: robot.body.own_materials(),
            displacement: robot.displacement,
            character: robot.character,
            provenance: robot.provenance,
            genotype: robot.genotype,
        }
    }
}

pub fn read_robot(file: &SourceFile) -> Result<Robot, Diagnostic> {
    let read = yaml::read::<RobotRecord>(file);
    if !read.as_ref().is_ok_and(|read| read.format == FORMAT) {
        let version: Version = yaml::read(file)?;
        if version.format != FORMAT {
            return Err(wording::robot_format(file, version.format, FORMAT, yaml::key_span(file, "format")));
        }
    }
    let read = read?;
    let palette = read.materials.unwrap_or_else(Palette::paper);
    let robot = Robot {
        name: read.name,
        behavior: read.behavior,
        body: shape::body(file, &read.body, &palette)?,
        displacement: read.displacement,
        character: read.character,
        provenance: read.provenance,
        genotype: read.genotype,
    };
    soundness::check(file, &robot)?;
    Ok(robot)
}

/// Reads mappings with one key, and says in errors where they are.
fn genotype<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Genotype>, D::Error> {
    let value = Value::deserialize(deserializer)?;
    singleton_map_recursive::deserialize(value).map_err(|error| D::Error::custom(format!("`genotype`: {error}")))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use nbc_base::diag::Code;
    use nbc_base::model::{Body, Drive, Material, MaterialKind, Pattern, Response, SafeRadius, Transition};
    use nbc_base::source::Sources;

    pub(crate) fn robot() -> Robot {
        let body = Body::parse(&["00345", "33333"], &Palette::paper()).unwrap();
        Robot {
            name: "nand_1".to_owned(),
            behavior: "RRRL".parse().unwrap(),
            body,
            displacement: vec![1.0, 0.1 + 0.2, 3.0, -4.0e-7].try_into().unwrap(),
            character: Character {
                clock: 4,
                switches: 1000,
                error_rate: 0.001,
                glitch_rate: 0.0,
                margin: 0.25,
                topples: false,
                settle: vec![Transition { stimuli: 2, from: Pattern::PAIRS[1], to: Pattern::PAIRS[3], cycles: 2 }],
                radius: Some(SafeRadius {
                    vary: "all=10%".to_owned(),
                    worlds: 20,
                    seed: 1,
                    radius: 1.5,
                    error_rate: Some(0.0),
                }),
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

    /// The fault of a text with a change, and what stands at its place.
    fn damage(whole: &str, from: &str, to: &str) -> (Code, String, String) {
        let damaged = whole.replacen(from, to, 1);
        assert_ne!(damaged, whole, "{from:?} is in the file");
        read(&damaged).expect_err(to)
    }

    #[test]
    fn a_robot_reads_back_bit_for_bit() {
        assert_eq!(read(&print_robot(&robot())), Ok(robot()));
    }

    fn own_palette() -> Arc<Palette> {
        let named = |name: &str, kind| Material { name: name.to_owned(), kind };
        let drive = Drive { period: 84, phase: 1e-7, low: 0.98, high: 1.02 };
        let mut materials = Palette::paper().materials().to_vec();
        materials[0] = named("no", MaterialKind::Rigid);
        materials[2] = named("heart", MaterialKind::Actuator(drive));
        materials.push(named("e5", MaterialKind::Sensor(Response::of(31, 1.0, 1.1))));
        Arc::new(Palette::new(materials))
    }

    fn own_robot() -> Robot {
        Robot { body: Body::parse(&["10945", "33333"], &own_palette()).unwrap(), ..robot() }
    }

    #[test]
    fn materials_are_written_unless_they_are_the_papers() {
        let text = print_robot(&own_robot());
        assert_eq!(read(&text), Ok(own_robot()));
        assert!(text.contains(
            "- name: heart\n  kind: actuator\n  period: 84\n  phase: 1.0e-7\n  range:\n  - 0.98\n  - 1.02\n"
        ));
        assert!(text.contains("  stimulus: 32\n"), "stimuli are counted from 1: {text}");
        assert!(!print_robot(&robot()).contains("materials"));
    }

    #[test]
    fn invalid_materials_are_reported_at_their_place() {
        let whole = print_robot(&own_robot());
        let check = |from: &str, to: &str, expected: &str, place: &str| {
            let (_, message, found) = damage(&whole, from, to);
            assert!(message.contains(expected), "{message:?} does not say {expected:?}");
            assert_eq!(found, place, "{message}");
        };
        check("  period: 84\n", "", "the material `heart` lacks the field `period`", "-");
        check("kind: soft", "kind: soft\n  phase: 0.0", "`flesh` cannot have the field `phase`", "-");
        check("  - 1.02\n", "  - .inf\n", "`heart` has `range: [0.98, inf]`", "-");
        check("name: heart", "name: flesh", "two materials are called `flesh`", "f");
        check("stimulus: 32", "stimulus: 0", "`e5` has `stimulus: 0`, expected 1 to 32", "-");
        check("- '10945'", "- '1094a'", "`a` is not a material code; expected 0 to 9", "a");
        check("absent: 1.0\n", "absent: 1.0\n  smell: 1\n", "unknown field `smell`", "s");
    }

    #[test]
    fn impossible_measurements_are_rejected() {
        let whole = print_robot(&robot());
        let check = |from: &str, to: &str, place: &str| {
            let (code, message, found) = damage(&whole, from, to);
            assert_eq!((code, found.as_str()), (Code::RobotFile, place), "{message}");
        };
        check("clock: 4", "clock: 0", "clock");
        check("clock: 4", "clock: 4294967295", "clock");
        check("error_rate: 0.001", "error_rate: 1.5", "error_rate");
        check("glitch_rate: 0.0", "glitch_rate: .nan", "glitch_rate");
        check("margin: 0.25", "margin: .nan", "margin");
        check("cycles: 2", "cycles: 0", "settle");
        check("- 3.0", "- .inf", "displacement");
        check("- 3.0", "- -3.0", "behavior");
        check("- '00345'\n- '33333'", "- '30303'", "body");
        check("name: nand_1", "name: ../nand", "name");
        check("evolution: gates", "evolution: \"\\e[2J\"", "evolution");
    }

    #[test]
    fn another_version_is_rejected_with_its_number() {
        let message = "`a.yaml` is a robot file of format 7, expected format 2".to_owned();
        let found = damage(&print_robot(&robot()), "format: 2", "format: 7");
        assert_eq!(found, (Code::ForeignFormat, message, "format".to_owned()));
    }

    #[test]
    fn damage_is_reported() {
        let whole = print_robot(&robot());
        let check = |from: &str, to: &str, expected: &str| {
            let (_, message, _) = damage(&whole, from, to);
            assert!(message.contains(expected), "{message:?} does not say {expected:?}");
        };
        check("behavior: RRRL\n", "", "missing field `behavior`");
        check("behavior: RRRL", "behavior: RRRX", "`RRRX` is not a behavior");
        check("- '00345'", "- '0034'", "row 2 has 5 voxels, expected 4");
        check("- '00345'", "- '0034x'", "`x` is not a material code");
        check("format: 2\n", "", "missing field `format`");
        check("name: ", "nom: ", "unknown field `nom`");
        check("clock: 4", "clock: four", "expected u32");
    }

    #[test]
    fn a_truncated_file_is_rejected_without_a_panic() {
        let whole = print_robot(&robot());
        let end = whole.find("evaluations").unwrap();
        for length in 0..end {
            assert!(read(&whole[..length]).is_err(), "cut to {length} bytes it was read");
        }
    }
}
