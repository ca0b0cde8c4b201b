//! Robots compared with their files: simulated again in the paper's world, and tried in other worlds.

use serde::Serialize;

use nbc_base::model::{Character, Fault, Robot, SafeRadius, Variation};
use nbc_sim::Simulator;
use nbc_swarm::{Executor, Measurement, Task, WorldSample, safe_radius};

/// A robot compared with its file.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Verified<'a> {
    pub name: &'a str,
    pub verified: bool,
    /// The fields that differ from its file.
    pub differs: Vec<String>,
}

/// How far worlds may differ before a robot makes errors.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Reach<'a> {
    pub name: &'a str,
    #[serde(flatten)]
    pub found: SafeRadius,
    /// Whether its file has no such radius, or the same one.
    pub verified: bool,
}

impl<'a> Verified<'a> {
    /// Measures a robot again; `None` if the work was stopped. `run` is passed to the executor.
    pub fn of(executor: &dyn Executor, run: usize, robot: &'a Robot) -> Option<Self> {
        let task = Task::Measurement(robot.body.clone());
        let measured = executor.perform(run, &[task], &|| ())?.remove(0).measured();
        let differs = match measured {
            Err(Fault { env_step, kind }) => vec![format!("the robot {kind} in env step {env_step}")],
            Ok(Measurement { displacement, behavior, character }) => [
                ("displacement", displacement == robot.displacement),
                ("behavior", behavior == robot.behavior),
                ("character", character == Character { radius: None, ..robot.character.clone() }),
            ]
            .into_iter()
            .filter(|(_, same)| !same)
            .map(|(name, _)| name.to_owned())
            .collect(),
        };
        Some(Self { name: &robot.name, verified: differs.is_empty(), differs })
    }
}

impl<'a> Reach<'a> {
    /// `variation` has the changes at radius 1.
    pub fn of(simulator: &Simulator, robot: &'a Robot, variation: Variation, worlds: u32, seed: u64) -> Self {
        let found = safe_radius(simulator, robot, &WorldSample { variation, seed }, worlds);
        let sample = |of: &SafeRadius| (of.vary.clone(), of.worlds, of.seed);
        let is_same = |known: &SafeRadius| {
            let is_same_rate = known.error_rate.is_none() || known.error_rate == found.error_rate;
            sample(known) != sample(&found) || (known.radius == found.radius && is_same_rate)
        };
        let verified = robot.character.radius.as_ref().is_none_or(is_same);
        Self { name: &robot.name, found, verified }
    }
}
