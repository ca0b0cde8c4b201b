//! Bodies on pages: their voxels, the looks of these, and their materials.

use serde_json::{Value, json};

use crate::model::Body;
use crate::report::looks::{Look, Looks, material_words};
use crate::swarm::Recorded;

/// How voxels look, for the page's script.
pub fn look_data(looks: &Looks) -> Vec<Value> {
    let data = |Look { color, mark }: Look| match mark {
        None => json!({ "color": color.to_string() }),
        Some(mark) => {
            json!({ "color": color.to_string(), "ink": mark.ink.to_string(), "mark": mark.polygons })
        }
    };
    looks.all().map(data).collect()
}

/// Each voxel of a recorded body: its points from the top left around it, and the place of its look.
pub fn voxel_data(recorded: &Recorded, body: &Body, looks: &Looks) -> Vec<[usize; 5]> {
    let voxel = |&([a, b, c, d], code): &([usize; 4], u8)| [a, b, c, d, looks.index(body.palette(), code)];
    recorded.voxels.iter().map(voxel).collect()
}

/// The materials that occur in a body.
pub fn materials(body: &Body) -> String {
    material_words(body).join("; ")
}
