//! Bodies on pages: their voxels, the appearance of these, and their materials.

use serde::Serialize;
use serde_json::{Value, json};

use crate::element::Point;
use crate::looks::{Look, Looks, material_words};
use nbc_base::diag::counted;
use nbc_base::model::{Body, Material};
use nbc_swarm::{Assembly, Member, Recorded, StimulusSource};

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct VoxelLook {
    pub name: String,
    pub color: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ink: Option<String>,
    /// Polygons within the unit square.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mark: Option<&'static [&'static [Point]]>,
}

pub fn voxel_looks(looks: &Looks) -> Vec<VoxelLook> {
    let look = |(material, Look { color, mark }): (&Material, Look)| VoxelLook {
        name: material.name.clone(),
        color: color.to_string(),
        ink: mark.map(|mark| mark.ink.to_string()),
        mark: mark.map(|mark| mark.polygons),
    };
    looks.all().map(look).collect()
}

/// Each voxel of a recorded body: its points from the top left around it, and the place of its look.
pub fn voxel_data(recorded: &Recorded, body: &Body, looks: &Looks) -> Vec<[usize; 5]> {
    let voxel = |&([a, b, c, d], code): &([usize; 4], u8)| [a, b, c, d, looks.index(body.palette(), code)];
    recorded.voxels.iter().map(voxel).collect()
}

pub fn materials(body: &Body) -> String {
    material_words(body).join("; ")
}

/// Pairs of a word and a text. `called` names a source.
pub fn about_robot(assembly: &Assembly, number: usize, called: &dyn Fn(StimulusSource) -> String) -> Vec<[String; 2]> {
    let member = &assembly.members[number];
    let (robot, body, character) = (&member.robot, &member.robot.body, &member.robot.character);
    let wired = |source: &StimulusSource| match source {
        StimulusSource::Constant(value) => format!("nothing (always {})", u8::from(*value)),
        StimulusSource::Input(_) | StimulusSource::Robot(_) => called(*source),
    };
    let (clock, switches) = (counted(character.clock as usize, "cycle"), character.switches);
    let pair = |word: &str, text: String| [word.to_owned(), text];
    let mut pairs = vec![pair("robot", robot.name.clone()), pair("behavior", robot.behavior.to_string())];
    if !member.block.is_empty() {
        pairs.push(pair("part", member.block.join(" / ")));
    }
    let stimuli = member.senses.iter().enumerate();
    pairs.extend(stimuli.map(|(i, source)| pair(&format!("stimulus {}", i + 1), wired(source))));
    pairs.extend([
        pair("body", body.rows().join(" ")),
        pair("materials", materials(body)),
        pair("clock", format!("{clock}, margin {:.3} voxels a cycle", character.margin)),
        pair("errors", format!("{:.2} % of {switches} switches", character.error_rate * 100.0)),
    ]);
    pairs
}

pub fn cell_data(assembly: &Assembly) -> Vec<Value> {
    let data = |(number, member): (usize, &Member)| {
        let wired = member.senses.iter().filter(|source| !matches!(source, StimulusSource::Constant(_)));
        json!({
            "net": member.net,
            "function": member.robot.function().name(),
            "about": about_robot(assembly, number, &|source| assembly.source_name(source)),
            "reads": wired.map(|&source| assembly.source_name(source)).collect::<Vec<_>>(),
        })
    };
    assembly.members.iter().enumerate().map(data).collect()
}
