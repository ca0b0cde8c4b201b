//! Recordings: poses of robots over time as small numbers, for pages that play them. They are made while the robots are
//! simulated.

use nbc_base::model::CYCLE_STEPS;
use nbc_sim::Flock;

/// The limit of the size of a recording, and the choice of its frame rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Room {
    /// The most bytes, so that a page with a few recordings stays below five megabytes.
    bytes: usize,
    /// Strides in env steps to choose from, the smoothest first.
    strides: &'static [u32],
}

impl Room {
    pub const SWARM: Self = Self { bytes: 1_500_000, strides: &[7, 12, 21, 42, 84] };
    /// For a swarm that is shown while it runs: all robots with many frames. The recording is emptied in every cycle.
    pub const LIVE: Self = Self { bytes: usize::MAX, strides: &[7] };
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

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    pub frames_per_cycle: u32,
    pub robots: Vec<Recorded>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
    pub robot: usize,
    /// Each voxel's points, by their numbers, and its material code.
    pub voxels: Vec<([usize; 4], u8)>,
    pub points: usize,
    /// Hundredths of a voxel: x from the robot's start and height above the ground, point by point, frame by frame.
    pub frames: Vec<i16>,
    start: f64,
}

impl Recording {
    pub fn new(flock: &dyn Flock, robots: impl IntoIterator<Item = usize>, stride: u32) -> Self {
        let robots = robots.into_iter().map(|robot| Recorded::new(flock, robot)).collect();
        Self { frames_per_cycle: CYCLE_STEPS / stride, robots }
    }

    /// The origin of each robot's x is now its leftmost point, so that it stays in range however far it walks.
    pub fn restart(&mut self, flock: &dyn Flock) {
        for recorded in &mut self.robots {
            recorded.frames.clear();
            recorded.start = leftmost(&flock.points(recorded.robot));
        }
    }

    pub(super) fn forget_cycle(&mut self) {
        for recorded in &mut self.robots {
            let length = 2 * recorded.points * self.frames_per_cycle as usize;
            recorded.frames.truncate(recorded.frames.len() - length);
        }
    }

    pub fn record(&mut self, flock: &dyn Flock) {
        for recorded in &mut self.robots {
            let (points, start) = (flock.points(recorded.robot), recorded.start);
            recorded.frames.extend(points.into_iter().flat_map(|[x, y]| [hundredths(x - start), hundredths(y - 1.0)]));
        }
    }
}

impl Recorded {
    /// The origin of its x, in voxels of the world.
    pub fn origin(&self) -> f64 {
        self.start
    }

    fn new(flock: &dyn Flock, robot: usize) -> Self {
        let (lattice, points) = (flock.lattice(robot), flock.points(robot));
        Self {
            robot,
            voxels: lattice.voxels().iter().map(|voxel| (voxel.corners, voxel.code)).collect(),
            points: points.len(),
            frames: Vec::new(),
            start: leftmost(&points),
        }
    }
}

fn leftmost(points: &[[f64; 2]]) -> f64 {
    points.iter().map(|point| point[0]).fold(f64::INFINITY, f64::min)
}

/// Hundredths; a value that is out of range or not a number is clamped.
fn hundredths(voxels: f64) -> i16 {
    (voxels * 100.0).round() as i16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recording_has_room_for_what_fits() {
        assert_eq!(Room::SWARM.fit(&[36; 5], 60), (7, 5));
        let (stride, robots) = Room::SWARM.fit(&[36; 100], 300);
        assert!(stride > 7 && robots <= 100);
        assert_eq!(Room::SWARM.fit(&[100_000_000], 1000).1, 0);
        let (stride, robots) = Room::GAITS.fit(&[26; 1024], 8);
        assert!(stride <= 14 && robots > 300, "{robots} gaits every {stride} steps");
    }
}
