//! The world that robots live in: how much it differs from the paper's, and what goes wrong in it.

use serde::{Deserialize, Serialize};

use super::GroundProfile;

/// A world to simulate in: its physics, and what goes wrong there. The default is the paper's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PhysicsWorld {
    pub factors: WorldFactors,
    pub noise: WorldNoise,
    #[serde(default, skip_serializing_if = "GroundProfile::is_flat")]
    pub ground: GroundProfile,
    #[serde(default, skip_serializing_if = "Hears::is_usual")]
    pub hears: Hears,
}

/// When the output of a robot is read: its motion over its last cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Hears {
    /// At the end of each of its cycles.
    #[default]
    Cycle,
    /// At the end of every env step. A motion of less than [`Hears::DEAD_ZONE`] leaves the output as it was.
    Always,
}

impl Hears {
    /// In voxels.
    pub const DEAD_ZONE: f64 = 0.02;

    fn is_usual(&self) -> bool {
        *self == Self::default()
    }
}

/// The numbers of the physics as factors of the paper's, so 1 is the paper's world (docs/physics.md 15).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WorldFactors {
    /// Friction on the ground, on the plane below it and between voxels.
    pub friction: f64,
    /// Downward acceleration.
    pub gravity: f64,
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// The largest share of a cycle by which the cycles of a robot are ahead.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub phase: f64,
    /// The largest share by which the cycles of a robot are shorter or longer.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub drift: f64,
    pub seed: u64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(amount: &f64) -> bool {
    *amount == 0.0
}

impl Default for WorldFactors {
    fn default() -> Self {
        Self { friction: 1.0, gravity: 1.0, stiffness: 1.0, drag: 1.0, damping: 1.0, swelling: 1.0 }
    }
}

impl WorldFactors {
    pub const RANGE: std::ops::RangeInclusive<f64> = 0.1..=10.0;
}

impl WorldNoise {
    /// The most that `start` may be, in voxels.
    pub const MOST_START: f64 = 10.0;

    pub const MOST_DRIFT: f64 = 0.1;

    /// Whether the cycles of the robots begin at different times.
    pub fn has_own_clocks(&self) -> bool {
        self.phase > 0.0 || self.drift > 0.0
    }
}

impl PhysicsWorld {
    pub fn is_paper(&self) -> bool {
        *self == Self::default()
    }

    /// Cycles by which a robot may answer later than its clock, where its stimuli change within its cycles
    /// (docs/own-clocks.md).
    pub fn lateness(&self) -> u32 {
        match self.hears {
            Hears::Always => 1,
            Hears::Cycle if self.noise.has_own_clocks() => 2,
            Hears::Cycle => 0,
        }
    }

    pub fn is_possible(&self) -> bool {
        let WorldFactors { friction, gravity, stiffness, drag, damping, swelling } = self.factors;
        let factors = [friction, gravity, stiffness, drag, damping, swelling];
        let WorldNoise { start, missed, weak, dead, phase, drift, .. } = self.noise;
        factors.iter().all(|factor| WorldFactors::RANGE.contains(factor))
            && [missed, weak, dead, phase].iter().all(|share| (0.0..=1.0).contains(share))
            && (0.0..=WorldNoise::MOST_START).contains(&start)
            && (0.0..=WorldNoise::MOST_DRIFT).contains(&drift)
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct NamedWorld {
    pub name: String,
    pub world: PhysicsWorld,
}

impl NamedWorld {
    /// The name of the world of everything that names none.
    pub const DEFAULT: &str = "paper";
}

impl Default for NamedWorld {
    fn default() -> Self {
        Self { name: Self::DEFAULT.to_owned(), world: PhysicsWorld::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
