//! A swarm that a page can run.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use super::bodies::VoxelLook;
use super::program::PortEntry;
use nbc_swarm::StimulusSource;

/// The answer to `compile` and to `replay`.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct SwarmAnswer {
    pub(crate) swarm: ShownSwarm,
}

/// The swarm of a page.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ShownSwarm {
    /// Counts the swarms of a connection; frames have its lowest byte.
    pub(crate) number: u32,
    pub(crate) circuit: String,
    pub(crate) swarm: Option<String>,
    pub(crate) inputs: Vec<PortEntry>,
    pub(crate) outputs: Vec<PortEntry>,
    /// The source of each bit of the outputs.
    pub(crate) shown: Vec<BitSource>,
    pub(crate) robots: Vec<SwarmRobot>,
    pub(crate) looks: Vec<VoxelLook>,
    /// An SVG.
    pub(crate) schematic: String,
    pub(crate) timing: String,
    /// Cycles after which every change has settled.
    pub(crate) hold: u32,
    /// Cycles at the start in which the robots take their shape.
    pub(crate) start: usize,
    /// Poses in a cycle.
    pub(crate) frames: u32,
}

/// A robot of the swarm.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct SwarmRobot {
    pub(crate) net: String,
    pub(crate) function: &'static str,
    pub(crate) robot: String,
    /// Words with their texts.
    pub(crate) about: Vec<[String; 2]>,
    /// The sources of its two stimuli.
    pub(crate) senses: [BitSource; 2],
    /// The rows from the top.
    pub(crate) body: Vec<String>,
    /// Columns and rows.
    pub(crate) size: [usize; 2],
    /// The numbers of the corner points around each voxel, and its index in the looks.
    pub(crate) voxels: Vec<[usize; 5]>,
    /// The number of points.
    pub(crate) points: usize,
    pub(crate) clock: u32,
    pub(crate) margin: f64,
    pub(crate) errors: f64,
}

/// Where a bit comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
#[serde(rename_all = "lowercase")]
pub(crate) enum BitSource {
    /// A bit of the inputs.
    Input(usize),
    /// A robot of the swarm.
    Robot(usize),
    /// A bit that never changes.
    Constant(bool),
}

impl From<StimulusSource> for BitSource {
    fn from(source: StimulusSource) -> Self {
        match source {
            StimulusSource::Input(bit) => Self::Input(bit),
            StimulusSource::Robot(index) => Self::Robot(index),
            StimulusSource::Constant(bit) => Self::Constant(bit),
        }
    }
}
