//! Robots of the library, bodies that a page has made, how voxels look, and a search for gates while it runs.

use serde::Serialize;

use nbc_session::report::VoxelLook;

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct RobotCards {
    pub(crate) robots: Vec<RobotCard>,
    pub(crate) looks: Vec<VoxelLook>,
    pub(crate) palette: Vec<PaletteEntry>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct RobotCard {
    pub(crate) name: String,
    pub(crate) function: &'static str,
    pub(crate) letters: String,
    pub(crate) about: String,
    /// The rows from the top, a material's code a character.
    pub(crate) body: Vec<String>,
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// The numbers of the corner points around each voxel, and its index in the looks.
    pub(crate) voxels: Vec<[usize; 5]>,
    pub(crate) points: usize,
    pub(crate) clock: u32,
    pub(crate) margin: f64,
    pub(crate) errors: f64,
    pub(crate) shipped: bool,
    /// Whether it is of the materials that can be painted, so that it can be probed.
    pub(crate) painted: bool,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct PaletteEntry {
    /// Its character in the rows of bodies.
    pub(crate) code: char,
    pub(crate) name: String,
    pub(crate) about: String,
    /// Its index in the looks.
    pub(crate) look: usize,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ProbeReport {
    /// Under each pattern: 00, 01, 10 and 11, or 000 to 111.
    pub(crate) gaits: Vec<EncodedGait>,
    pub(crate) letters: String,
    pub(crate) function: &'static str,
    pub(crate) displacement: Vec<f64>,
    pub(crate) character: Option<CharacterSketch>,
    pub(crate) points: usize,
    pub(crate) voxels: Vec<[usize; 5]>,
    pub(crate) looks: Vec<VoxelLook>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct EncodedGait {
    /// Poses in a cycle.
    pub(crate) frames: u32,
    pub(crate) cycles: u32,
    /// Base64 of numbers as in a frame.
    pub(crate) poses: String,
}

/// The character of a body over a few switches.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct CharacterSketch {
    pub(crate) clock: u32,
    pub(crate) margin: f64,
    pub(crate) errors: f64,
    pub(crate) switches: u32,
    pub(crate) glitches: f64,
    pub(crate) topples: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct KeptRobot {
    pub(crate) path: String,
    #[serde(rename = "use")]
    pub(crate) declaration: String,
}

/// The niches of an archive that have changed in a generation.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct ArchiveChange {
    pub(crate) id: u64,
    pub(crate) generation: u32,
    pub(crate) axes: Vec<AxisEntry>,
    pub(crate) niches: Vec<NicheEntry>,
    pub(crate) evaluations: u64,
}

/// The name of an axis and its number of bins.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct AxisEntry(pub(crate) &'static str, pub(crate) usize);

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct NicheEntry {
    /// The bin on each axis.
    pub(crate) place: Vec<u16>,
    pub(crate) fitness: [f64; 2],
    pub(crate) body: Vec<String>,
    pub(crate) letters: String,
    pub(crate) function: &'static str,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct EvolutionEnd {
    pub(crate) generations: u32,
    pub(crate) evaluations: u64,
}
