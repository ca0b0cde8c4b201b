//! Recordings: every frame of a swarm's film as small numbers, for pages that play it.

use crate::model::CYCLE_STEPS;
use crate::report::stage::Stage;

/// How large a recording may be.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// The most bytes, so that a page with a few recordings stays below five megabytes.
    bytes: usize,
    /// Strides in env steps to choose from, the smoothest first.
    strides: &'static [u32],
}

impl Room {
    /// For a swarm: better a jerky film than one without all robots.
    pub const SWARM: Self = Self { bytes: 1_500_000, strides: &[7, 12, 21, 42, 84] };
    /// For gaits of elites: better some of them than jerky ones.
    pub const GAITS: Self = Self { bytes: 2_400_000, strides: &[7, 12, 14] };

    /// The stride, and the number of robots, for which there is room; `points` are those of each robot.
    pub fn fit(self, points: &[usize], cycles: usize) -> (u32, usize) {
        let bytes = |points: usize, stride: u32| points * 4 * (cycles * (CYCLE_STEPS / stride) as usize + 1);
        let all: usize = points.iter().sum();
        let jerkiest = self.strides[self.strides.len() - 1];
        let stride = self.strides.iter().copied().find(|&stride| bytes(all, stride) <= self.bytes).unwrap_or(jerkiest);
        let mut used = 0;
        let fitting = points.iter().take_while(|&&points| {
            used += bytes(points, stride);
            used <= self.bytes
        });
        (stride, fitting.count())
    }
}

/// The robots of a stage over time.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// Frames in a cycle.
    pub frames_per_cycle: u32,
    /// The robots; those for which there was no room are left out at the end.
    pub robots: Vec<Recorded>,
}

/// One robot over time.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    /// Each voxel's points, by their numbers, and its material code.
    pub voxels: Vec<([usize; 4], u8)>,
    /// How many points there are.
    pub points: usize,
    /// Hundredths of a voxel: x from where the robot started and height above the ground, point by point, frame by frame.
    pub frames: Vec<i16>,
}

impl Recording {
    /// Runs a stage to its end and records its first robots.
    pub fn of(mut stage: Stage, robots: usize) -> Self {
        let frames_per_cycle = CYCLE_STEPS / stage.stride();
        let mut recorded: Vec<Recorded> = (0..robots.min(stage.robots()))
            .map(|i| Recorded { voxels: stage.voxels(i), points: stage.points(i).len(), frames: Vec::new() })
            .collect();
        let starts: Vec<f64> = (0..recorded.len()).map(|i| start_of(&stage.points(i))).collect();
        while stage.turn() {
            for (i, robot) in recorded.iter_mut().enumerate() {
                let points = stage.points(i);
                robot.frames.extend(points.iter().flat_map(|[x, y]| [small(x - starts[i]), small(y - 1.0)]));
            }
        }
        Self { frames_per_cycle, robots: recorded }
    }
}

/// The leftmost point, which is where a recording's x begins.
fn start_of(points: &[[f64; 2]]) -> f64 {
    points.iter().map(|point| point[0]).fold(f64::INFINITY, f64::min)
}

/// Hundredths; what is too far or no number stays at the edge.
fn small(voxels: f64) -> i16 {
    (voxels * 100.0).round() as i16
}
