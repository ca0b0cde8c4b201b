//! What an exported page contains.

use serde::Serialize;
#[cfg(test)]
use ts_rs::TS;

use super::swarm::ShownSwarm;

/// A circuit that a page plays without a server: the swarm, how its robots walk, and the rows of the tests.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ExportedSwarm {
    pub(crate) version: &'static str,
    pub(crate) file: String,
    pub(crate) swarm: Box<ShownSwarm>,
    /// Cycles for which robots sense the same; more than one only in wave machines.
    pub(crate) beat: u32,
    pub(crate) robots: Vec<ExportedRobot>,
    /// How each of the different robots walks.
    pub(crate) walks: Vec<ExportedWalk>,
    pub(crate) tests: Vec<ExportedTest>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ExportedRobot {
    /// The index of its walk.
    pub(crate) walk: usize,
    /// Its output before the first cycle.
    pub(crate) start: bool,
    /// Cycles of the same stimuli after which it answers.
    pub(crate) delay: u32,
    /// For each stimulus, what it senses in the first cycles instead of its source.
    pub(crate) held: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ExportedWalk {
    /// The directions, such as `RRRL`.
    pub(crate) letters: String,
    pub(crate) strides: Vec<ExportedStride>,
}

/// A recorded cycle under one pattern, as a loop.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ExportedStride {
    /// Voxels that the robot moves in it.
    pub(crate) shift: f64,
    /// Base64 of numbers as in a frame, without the motion of the whole.
    pub(crate) poses: String,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ExportedTest {
    pub(crate) title: String,
    pub(crate) rows: Vec<ExportedRow>,
}

/// A row: the digits `0` and `1` of the inputs, and for the outputs also `-`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(TS))]
pub(crate) struct ExportedRow {
    pub(crate) inputs: String,
    pub(crate) expected: String,
}
