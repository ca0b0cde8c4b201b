//! A run's results as data for programs: `result.json`.

use serde::Serialize;

use crate::SwarmTiming;
use nbc_swarm::{SimulationResult, SwarmTrace, TestVerdict};

/// The results of a run.
#[derive(Clone, Debug, Serialize)]
pub struct RunResult<'a> {
    /// The name of the program that made the result.
    pub program: &'static str,
    /// The version of the program that made the result.
    pub version: &'static str,
    /// The source file's path as the user wrote it.
    pub source: &'a str,
    /// Whether every test passed, and no robot of a simulation failed.
    pub passed: bool,
    /// The tests in order, each once for each swarm of its circuit.
    pub tests: Vec<SwarmResult<'a, TestVerdict>>,
    /// The simulations in order.
    pub simulations: Vec<SwarmResult<'a, SimulationResult>>,
}

/// The results of one test or simulation.
#[derive(Clone, Debug, Serialize)]
pub struct SwarmResult<'a, T> {
    /// The verdict, row by row.
    #[serde(flatten)]
    pub outcome: &'a T,
    /// The robots in order: net, function, robot, and the nets that the robot senses.
    pub robots: Vec<RobotResult<'a>>,
    /// The timing of each robot.
    pub timing: SwarmTiming,
    /// The paths of pictures, waveforms and tables.
    pub files: Vec<String>,
}

/// One robot of a swarm.
#[derive(Clone, Debug, Serialize)]
pub struct RobotResult<'a> {
    /// The net it drives.
    pub net: &'a str,
    /// The function of its cell.
    pub function: &'static str,
    /// Its name in the library.
    pub robot: &'a str,
    /// The nets it senses as stimulus 1, stimulus 2 and perhaps stimulus 3.
    pub senses: &'a [String],
    /// Voxels between its start and the end of the last cycle; null if its simulation was given up.
    pub displacement: Option<f64>,
    /// The env step at which its simulation was given up.
    pub unstable_at: Option<u32>,
}

impl<'a> RunResult<'a> {
    /// The results of the tests and simulations of a source file.
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
    /// The results of one test or simulation, with the paths of its files.
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
