//! Recordings: every frame of a swarm's film as small numbers, for pages that play it.

use crate::model::CYCLE_STEPS;
use crate::report::stage::Stage;

/// The most bytes of one recording, so that a page with a few of them stays below five megabytes.
const MAX_BYTES: usize = 1_500_000;

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
    /// The stride in env steps, and the number of robots, for which a recording has room.
    pub fn room(points: &[usize], cycles: usize) -> (u32, usize) {
        let bytes = |points: usize, stride: u32| points * 4 * (cycles * (CYCLE_STEPS / stride) as usize + 1);
        let strides = [7, 12, 21, 42, 84];
        let all: usize = points.iter().sum();
        let stride = strides.into_iter().find(|&stride| bytes(all, stride) <= MAX_BYTES).unwrap_or(CYCLE_STEPS);
        let mut used = 0;
        let fitting = points.iter().take_while(|&&points| {
            used += bytes(points, stride);
            used <= MAX_BYTES
        });
        (stride, fitting.count())
    }

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
