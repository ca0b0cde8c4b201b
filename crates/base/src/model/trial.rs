//! Trials and their results.

use serde::{Deserialize, Serialize};

use super::{Body, FaultKind, GroundProfile, Schedule, SettingError, WorldFactors};

/// The environment of a trial: the strip of ground that a robot walks on (docs/physics.md 1), and its physics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    pub world_width: usize,
    /// The ground column of a body's left column; `None` puts the body in the middle: half the world less half the
    /// body, rounded down.
    pub start_x: Option<usize>,
    /// Voxels by which a body starts to the right of that column.
    pub shift: f64,
    /// The physics as factors of the paper's.
    pub factors: WorldFactors,
    /// Columns that repeat from the left end. A body starts above the highest voxel of the columns below it.
    pub ground: GroundProfile,
}

impl Default for Setting {
    /// The paper's world of 500 ground voxels.
    fn default() -> Self {
        Self {
            world_width: 500,
            start_x: None,
            shift: 0.0,
            factors: WorldFactors::default(),
            ground: GroundProfile::default(),
        }
    }
}

impl Setting {
    pub const MAX_WIDTH: usize = 1_000_000;

    pub fn check(&self, body: &Body) -> Result<(), SettingError> {
        let (width, columns) = (self.world_width, body.width());
        if width > Self::MAX_WIDTH {
            return Err(SettingError::WideWorld { width, most: Self::MAX_WIDTH });
        }
        if width < columns {
            return Err(SettingError::NarrowWorld { width, columns });
        }
        let (start, most) = (self.start_column(columns), width - columns);
        if start > most { Err(SettingError::OffGround { start, most, columns, width }) } else { Ok(()) }
    }

    /// The place of a body of that many columns at its start: the column of its left side and the row of its lower
    /// side, in voxels from the lower left corner of the ground.
    pub fn start(&self, body_width: usize) -> [f64; 2] {
        let left = self.start_column(body_width) as f64 + self.shift;
        let below = |side: f64| side.clamp(0.0, self.world_width as f64) as usize;
        let columns = below(left.floor())..below((left + body_width as f64).ceil());
        [left, self.ground.highest(columns) as f64]
    }

    pub fn start_column(&self, body_width: usize) -> usize {
        self.start_x.unwrap_or_else(|| (self.world_width / 2).saturating_sub(body_width / 2))
    }
}

/// One simulation to run: a body, fresh at its start, under a schedule.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    pub body: Body,
    pub schedule: Schedule,
}

/// The result of a trial: the center of mass over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// Horizontal position of the center of mass in voxels: `com_x[0]` at the start, `com_x[n]` after env step `n`. It
    /// ends early at a fault.
    pub com_x: Vec<f64>,
    /// Height of the center of mass in voxels, at the same times.
    pub com_y: Vec<f64>,
    pub fault: Option<Fault>,
}

impl Trajectory {
    pub fn push(&mut self, [x, y]: [f64; 2]) {
        self.com_x.push(x);
        self.com_y.push(y);
    }

    /// Voxels walked in each spell of the trial's schedule; `None` for spells that were not simulated to their end.
    pub fn displacements(&self, schedule: &Schedule) -> Vec<Option<f64>> {
        let mut start = 0;
        let walked = schedule.spells.iter().map(|spell| {
            let end = start + spell.steps as usize;
            let walked = Some(self.com_x.get(end)? - self.com_x.get(start)?);
            start = end;
            walked
        });
        walked.collect()
    }
}

/// Why and when a simulation ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fault {
    /// The env step that was abandoned, from 1.
    pub env_step: u32,
    pub kind: FaultKind,
}
