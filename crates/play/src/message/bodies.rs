//! Robots of the library, bodies that a page has made, how voxels look, and a search for gates while it runs.

use serde::Serialize;

use nbc_base::model::Character;
use nbc_session::report::{ArchiveAxis, EliteData, Listing, VoxelLook};

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
    #[serde(flatten)]
    pub(crate) listing: Listing,
    pub(crate) about: String,
    /// The numbers of the corner points around each voxel, and its index in the looks.
    pub(crate) voxels: Vec<[usize; 5]>,
    pub(crate) points: usize,
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
    /// Over a few switches.
    pub(crate) character: Option<Box<Character>>,
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
    pub(crate) axes: Vec<ArchiveAxis>,
    pub(crate) niches: Vec<EliteData>,
    pub(crate) evaluations: u64,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(crate) struct EvolutionEnd {
    pub(crate) generations: u32,
    pub(crate) evaluations: u64,
}
