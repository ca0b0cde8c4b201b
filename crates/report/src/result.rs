//! A run's results as data for programs: `result.json`.

use serde::Serialize;

use crate::SwarmTiming;
use nbc_swarm::{SimulationResult, SwarmTrace, TestVerdict};

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunResult<'a> {
    pub program: &'static str,
    pub version: &'static str,
    /// The source file as the user wrote it.
    pub source: &'a str,
    /// Whether every test passed, and no robot of a simulation failed.
    pub passed: bool,
    pub tests: Vec<SwarmResult<'a, TestVerdict>>,
    pub simulations: Vec<SwarmResult<'a, SimulationResult>>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SwarmResult<'a, T> {
    #[serde(flatten)]
    pub outcome: &'a T,
    pub robots: Vec<RobotResult<'a>>,
    pub timing: SwarmTiming,
    /// Pictures, waveforms and tables.
    pub files: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RobotResult<'a> {
    pub net: &'a str,
    /// The gate, such as `nand`.
    pub function: &'static str,
    pub robot: &'a str,
    /// The nets sensed as its stimuli.
    pub senses: &'a [String],
    /// Voxels between its start and the end of the last cycle; null if its simulation was given up.
    pub displacement: Option<f64>,
    /// The env step at which its simulation was given up.
    pub unstable_at: Option<u32>,
}

impl<'a> RunResult<'a> {
    pub fn new(
        source: &'a str,
        tests: Vec<SwarmResult<'a, TestVerdict>>,
        simulations: Vec<SwarmResult<'a, SimulationResult>>,
    ) -> Self {
        let passed = tests.iter().all(|test| test.outcome.passed)
            && simulations.iter().all(|simulation| simulation.outcome.fault.is_none());
        Self { program: nbc_base::PROGRAM, version: nbc_base::VERSION, source, passed, tests, simulations }
    }
}

impl<'a, T> SwarmResult<'a, T> {
    pub fn new(outcome: &'a T, trace: &'a SwarmTrace, timing: SwarmTiming, files: Vec<String>) -> Self {
        let walked = |(end, start): (&f64, &f64)| end - start;
        let robots = trace.robots.iter().map(|robot| RobotResult {
            net: &robot.net,
            function: robot.function.name(),
            robot: &robot.robot,
            senses: &robot.sensed_nets,
            displacement: robot.com_x.last().zip(robot.com_x.first()).filter(|_| robot.fault.is_none()).map(walked),
            unstable_at: robot.fault.map(|fault| fault.env_step),
        });
        Self { outcome, robots: robots.collect(), timing, files }
    }
}
