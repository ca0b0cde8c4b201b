//! Trials and what comes of them.

use serde::Serialize;

use super::{Body, Schedule};

/// The place where robots are tried: the strip of ground they walk on (docs/physics.md 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Ground voxels in a row.
    pub world_width: usize,
    /// The ground column of a body's left column; `None` puts the body in the middle: half the world less half the body, rounded down.
    pub start_x: Option<usize>,
}

impl Default for Setting {
    /// The paper's world of 500 ground voxels.
    fn default() -> Self {
        Self { world_width: 500, start_x: None }
    }
}

impl Setting {
    /// The start column of a body of that many columns.
    pub fn start_column(&self, body_width: usize) -> usize {
        self.start_x.unwrap_or_else(|| (self.world_width / 2).saturating_sub(body_width / 2))
    }
}

/// One simulation to run: a body, fresh at its start, under a schedule.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The body.
    pub body: Body,
    /// The stimuli over time.
    pub schedule: Schedule,
}

/// What a trial gave: the center of mass over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// Horizontal place of the center of mass in voxels: the start, then after each env step. Ends early at a fault.
    pub com_x: Vec<f64>,
    /// Height of the center of mass in voxels, likewise.
    pub com_y: Vec<f64>,
    /// What ended it early, if anything did.
    pub fault: Option<Fault>,
}

/// A simulation that could not go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Fault {
    /// The env step that was abandoned, from 1.
    pub env_step: u32,
    /// What happened.
    pub kind: FaultKind,
}

/// Why a simulation could not go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// Too many of the body's voxels overlap (docs/physics.md 9).
    Unstable,
    /// A position was no finite number.
    NonFinite,
}
