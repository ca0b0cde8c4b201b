//! The world that robots live in: how much it differs from the paper's, and what goes wrong in it.

use serde::{Deserialize, Serialize};

/// A world to simulate in: its physics, and what goes wrong there. The default is the paper's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PhysicsWorld {
    /// The numbers of its physics, as factors of the paper's.
    pub factors: WorldFactors,
    /// What goes wrong for each robot by itself.
    pub noise: WorldNoise,
    /// What the robots stand on.
    #[serde(default, skip_serializing_if = "GroundProfile::is_flat")]
    pub ground: GroundProfile,
}

/// How high the ground is along its columns, in voxels above its lowest place (docs/physics.md 15). The columns repeat
/// from the left end of the ground to the right. The default is flat, as the paper's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Vec<u8>", into = "Vec<u8>")]
pub struct GroundProfile {
    heights: [u8; GroundProfile::MOST_COLUMNS],
    columns: u8,
}

/// The numbers of the physics as factors of the paper's, so 1 is the paper's world (docs/physics.md 15).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorldFactors {
    /// Friction on the ground, on the plane below it and between voxels.
    pub friction: f64,
    /// Downward acceleration.
    pub gravity: f64,
    /// Stiffness of all springs.
    pub stiffness: f64,
    /// Viscous drag on the points of a body.
    pub drag: f64,
    /// Damping where voxels touch the ground or each other.
    pub damping: f64,
    /// Speed at which voxels swell and shrink.
    pub swelling: f64,
}

/// What goes wrong for each robot by itself (docs/physics.md 15).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WorldNoise {
    /// The most voxels by which a robot starts to the left or the right of its place.
    pub start: f64,
    /// The probability that a robot does not notice its stimuli in a cycle and keeps those of the cycle before.
    pub missed: f64,
    /// The share by which actuators and sensors move less.
    pub weak: f64,
    /// The probability that an actuator or sensor never moves.
    pub dead: f64,
    /// The seed of all that is drawn.
    pub seed: u64,
}

impl Default for WorldFactors {
    fn default() -> Self {
        Self { friction: 1.0, gravity: 1.0, stiffness: 1.0, drag: 1.0, damping: 1.0, swelling: 1.0 }
    }
}

impl WorldFactors {
    /// The smallest and the largest factor.
    pub const RANGE: std::ops::RangeInclusive<f64> = 0.1..=10.0;
}

impl WorldNoise {
    /// The most that `start` may be, in voxels.
    pub const MOST_START: f64 = 10.0;
}

impl GroundProfile {
    /// The most columns before it repeats.
    pub const MOST_COLUMNS: usize = 32;
    /// The most voxels by which one place is higher than another.
    pub const MOST_HEIGHT: u8 = 10;

    /// The ground of these heights, of which there are at least one and at most [`Self::MOST_COLUMNS`], each at most
    /// [`Self::MOST_HEIGHT`]; `None` for others. Only differences matter.
    pub fn new(heights: &[u8]) -> Option<Self> {
        let least = *heights.iter().min()?;
        let is_possible = heights.len() <= Self::MOST_COLUMNS && heights.iter().all(|at| *at <= Self::MOST_HEIGHT);
        let mut profile = Self::default();
        if is_possible && heights.iter().any(|at| *at > least) {
            profile.columns = heights.len() as u8;
            profile.heights.iter_mut().zip(heights).for_each(|(own, at)| *own = at - least);
        }
        is_possible.then_some(profile)
    }

    /// Whether all places are of one height.
    pub fn is_flat(&self) -> bool {
        self.columns == 0
    }

    /// The heights of the columns before they repeat; none if it is flat.
    pub fn heights(&self) -> &[u8] {
        &self.heights[..usize::from(self.columns)]
    }

    /// The height of a column, counted from the left end of the ground.
    pub fn height(&self, column: usize) -> usize {
        if self.is_flat() { 0 } else { self.heights[column % usize::from(self.columns)].into() }
    }

    /// The greatest height of these columns.
    pub fn highest(&self, columns: std::ops::Range<usize>) -> usize {
        columns.map(|column| self.height(column)).max().unwrap_or(0)
    }
}

impl From<GroundProfile> for Vec<u8> {
    fn from(profile: GroundProfile) -> Self {
        profile.heights().to_vec()
    }
}

impl TryFrom<Vec<u8>> for GroundProfile {
    type Error = &'static str;

    fn try_from(heights: Vec<u8>) -> Result<Self, Self::Error> {
        if heights.is_empty() {
            return Ok(Self::default());
        }
        Self::new(&heights).ok_or("there are too many heights, or one is too large")
    }
}

impl PhysicsWorld {
    /// Whether it is the paper's world.
    pub fn is_paper(&self) -> bool {
        *self == Self::default()
    }

    /// Whether all its numbers are in their ranges.
    pub fn is_possible(&self) -> bool {
        let WorldFactors { friction, gravity, stiffness, drag, damping, swelling } = self.factors;
        let factors = [friction, gravity, stiffness, drag, damping, swelling];
        let WorldNoise { start, missed, weak, dead, .. } = self.noise;
        factors.iter().all(|factor| WorldFactors::RANGE.contains(factor))
            && [missed, weak, dead].iter().all(|share| (0.0..=1.0).contains(share))
            && (0.0..=WorldNoise::MOST_START).contains(&start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ground_repeats_and_begins_at_its_lowest_place() {
        let ground = GroundProfile::new(&[3, 2, 5]).unwrap();
        assert_eq!((0..7).map(|column| ground.height(column)).collect::<Vec<_>>(), [1, 0, 3, 1, 0, 3, 1]);
        assert_eq!((ground.highest(3..5), ground.highest(4..6), ground.highest(2..2)), (1, 3, 0));
        assert!(GroundProfile::new(&[4, 4]).unwrap().is_flat() && !ground.is_flat());
        assert_eq!([GroundProfile::new(&[]), GroundProfile::new(&[11]), GroundProfile::new(&[0; 33])], [None; 3]);
    }

    #[test]
    fn a_world_without_heights_reads_as_before() {
        let paper = serde_json::to_value(PhysicsWorld::default()).unwrap();
        assert!(paper.get("ground").is_none());
        assert_eq!(serde_json::from_value::<PhysicsWorld>(paper).unwrap(), PhysicsWorld::default());
        let stairs = PhysicsWorld { ground: GroundProfile::new(&[0, 1]).unwrap(), ..PhysicsWorld::default() };
        let text = serde_json::to_string(&stairs).unwrap();
        assert!(text.contains("\"ground\":[0,1]"), "{text}");
        assert_eq!(serde_json::from_str::<PhysicsWorld>(&text).unwrap(), stairs);
        assert!(serde_json::from_str::<PhysicsWorld>(&text.replace("[0,1]", "[0,99]")).is_err());
    }
}
