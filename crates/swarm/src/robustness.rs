//! A test in many worlds: in how many it passes, which robots fail first, and how far the others are from it.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use serde::Serialize;

use crate::judge::settled_margins;
use crate::{Proportion, RobotFault, SwarmTrace, TestVerdict};
use nbc_base::model::{PhysicsWorld, Variation};

/// A robot's displacement in the correct direction over a cycle in which its output should be correct; negative if
/// the output was wrong.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotMargin {
    pub net: String,
    pub robot: String,
    pub cycle: usize,
    pub margin: f64,
}

#[derive(Clone, Debug, PartialEq)]
pub struct WorldTrial {
    pub world: PhysicsWorld,
    /// The row that failed first, and its line in the source; `None` if the test passed.
    pub failed: Option<(usize, usize)>,
    pub fault: Option<RobotFault>,
    /// The robot that was wrong first; `None` if the test passed or a robot failed, or if each robot did what its
    /// stimuli require, but some had missed theirs or had no time.
    pub first_failing: Option<RobotMargin>,
    pub least: Option<RobotMargin>,
}

impl WorldTrial {
    pub fn new(world: PhysicsWorld, verdict: &TestVerdict, trace: &SwarmTrace, clocks: &[u32], window: usize) -> Self {
        let margins = settled_margins(trace, clocks, window);
        let named = |&(cycle, k, margin): &(usize, usize, f64)| RobotMargin {
            net: trace.robots[k].net.clone(),
            robot: trace.robots[k].robot.clone(),
            cycle,
            margin,
        };
        let least = margins.iter().min_by(|a, b| a.2.total_cmp(&b.2)).map(named);
        let mut end = 0;
        let failed = verdict.rows.iter().find(|row| {
            end += row.cycles.unwrap_or(0);
            !row.passed
        });
        let start = end - failed.and_then(|row| row.cycles).unwrap_or(0);
        let wrong = || margins.iter().filter(|(cycle, _, margin)| *margin <= 0.0 && *cycle < end);
        // An error in an earlier row may show up late, as a wrong bit that was stored.
        let first = wrong().find(|(cycle, ..)| *cycle >= start).or_else(|| wrong().next_back());
        let fault = failed.and_then(|row| row.fault.clone());
        let first_failing = failed.filter(|row| row.fault.is_none()).and(first).map(named);
        Self { world, failed: failed.map(|row| (row.row, row.line)), fault, first_failing, least }
    }
}

/// A test in a sample of worlds.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Robustness {
    pub file: String,
    pub line: usize,
    /// The tested circuit, with the values of its parameters.
    pub circuit: String,
    pub title: String,
    pub swarm: Option<String>,
    /// The world around which the worlds vary.
    pub world: String,
    pub robots: usize,
    pub variation: Variation,
    /// The factor of the requested variation.
    pub scale: f64,
    /// The share of worlds in which the test passes.
    #[serde(rename = "yield")]
    pub passed: Proportion,
    /// The robots that fail first, those of most worlds first.
    pub fails_first: Vec<FailingRobot>,
    /// The smallest margin in the worlds in which the test passes, with the number of its world.
    pub least: Option<WorldMargin>,
    pub failures: Vec<WorldFailure>,
}

/// A robot that fails first in some worlds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FailingRobot {
    pub net: String,
    pub robot: String,
    pub worlds: usize,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WorldMargin {
    /// The number of the world in the sample, from 0.
    pub world: usize,
    #[serde(flatten)]
    pub margin: RobotMargin,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WorldFailure {
    /// The number of the world in the sample, from 0.
    pub world: usize,
    pub physics: PhysicsWorld,
    /// The row that failed first.
    pub row: usize,
    pub line: usize,
    /// The robot that was wrong first, if one was.
    pub first: Option<RobotMargin>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<RobotFault>,
}

impl WorldFailure {
    /// The net and the name of the robot that failed or was wrong first, if one did.
    fn robot(&self) -> Option<(&str, &str)> {
        match (&self.fault, &self.first) {
            (Some(RobotFault { net, robot, .. }), _) | (None, Some(RobotMargin { net, robot, .. })) => {
                Some((net, robot))
            }
            (None, None) => None,
        }
    }
}

impl Robustness {
    /// Sums up the results in the worlds of a sample, in order; `verdict` is that of any of them.
    pub fn of(
        verdict: &TestVerdict,
        robots: usize,
        (variation, scale): (Variation, f64),
        trials: &[WorldTrial],
    ) -> Self {
        let numbered = || trials.iter().enumerate();
        let failure = |(world, trial): (usize, &WorldTrial)| {
            let (row, line) = trial.failed?;
            let (first, fault) = (trial.first_failing.clone(), trial.fault.clone());
            Some(WorldFailure { world, physics: trial.world, row, line, first, fault })
        };
        let margin = |(world, trial): (usize, &WorldTrial)| {
            let margin = trial.least.clone().filter(|_| trial.failed.is_none())?;
            Some(WorldMargin { world, margin })
        };
        let failures: Vec<WorldFailure> = numbered().filter_map(failure).collect();
        Self {
            file: verdict.file.clone(),
            line: verdict.line,
            circuit: verdict.circuit.clone(),
            title: verdict.title.clone(),
            swarm: verdict.swarm.clone(),
            world: verdict.world.clone().unwrap_or_default(),
            robots,
            variation,
            scale,
            passed: Proportion { successes: trials.len() - failures.len(), attempts: trials.len() },
            fails_first: failing_robots(&failures),
            least: numbered().filter_map(margin).min_by(|a, b| a.margin.margin.total_cmp(&b.margin.margin)),
            failures,
        }
    }
}

fn failing_robots(failures: &[WorldFailure]) -> Vec<FailingRobot> {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for failing in failures.iter().filter_map(WorldFailure::robot) {
        *counts.entry(failing).or_default() += 1;
    }
    let failing = |((net, robot), worlds): ((&str, &str), usize)| FailingRobot {
        net: net.to_owned(),
        robot: robot.to_owned(),
        worlds,
    };
    let mut failing_robots: Vec<FailingRobot> = counts.into_iter().map(failing).collect();
    failing_robots.sort_by_key(|robot| Reverse(robot.worlds));
    failing_robots
}
