//! Robots of a swarm that are likely to give wrong outputs.

use serde::Serialize;

use crate::Assembly;

/// A margin below this, in voxels a cycle, is thin: small differences of the ground or the materials may turn the
/// output.
pub const THIN_MARGIN: f64 = 0.02;

/// A robot of a swarm with errors or a thin margin.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WeakRobot {
    pub robot: String,
    pub nets: Vec<String>,
    /// Wrong outputs as a share of the switches.
    pub error_rate: f64,
    /// Its margin in voxels a cycle.
    pub margin: f64,
}

impl WeakRobot {
    /// The weakness in words: `wrong in 4.2 % of its measured switches`.
    pub fn complaint(&self) -> String {
        match self.error_rate {
            rate if rate > 0.0 => format!("wrong in {:.1} % of its measured switches", rate * 100.0),
            _ => format!("with a thin margin of {:.3} voxels a cycle", self.margin),
        }
    }
}

/// The weak robots of a swarm, each once, in order of its members.
pub fn weak_robots(assembly: &Assembly) -> Vec<WeakRobot> {
    let mut weak: Vec<WeakRobot> = Vec::new();
    for member in &assembly.members {
        let (robot, character) = (&member.robot, &member.robot.character);
        if character.error_rate <= 0.0 && character.margin >= THIN_MARGIN {
            continue;
        }
        match weak.iter_mut().find(|known| known.robot == robot.name) {
            Some(known) => known.nets.push(member.net.clone()),
            None => weak.push(WeakRobot {
                robot: robot.name.clone(),
                nets: vec![member.net.clone()],
                error_rate: character.error_rate,
                margin: character.margin,
            }),
        }
    }
    weak
}
