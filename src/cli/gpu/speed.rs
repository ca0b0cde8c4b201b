//! `nbc bench --device`: lane-substeps per second of a device, by the number of robots in flight.

use std::time::{Duration, Instant};

use serde::Serialize;

use nbc_base::model::{Body, CYCLE_STEPS, Pattern, Schedule, Setting, Trial};
use nbc_session::report::{Align, TextTable};
use nbc_sim::{Constants, OpenClBackend, Simulator};

const SIDES: [usize; 3] = [5, 7, 10];
/// Robots that are simulated at once.
const ROBOTS: [usize; 5] = [64, 512, 2048, 8192, 32_768];
/// If a number of robots takes longer than this, larger ones are not measured.
const PATIENCE: Duration = Duration::from_secs(4);

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct DeviceFigures {
    name: String,
    driver: String,
    cases: Vec<DeviceCase>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct DeviceCase {
    #[serde(rename = "box")]
    bounds: String,
    robots: usize,
    /// Lane-substeps per second, in wall-clock time.
    substeps: f64,
}

/// Different bodies, one cycle from a fresh start.
pub(super) fn measure(backend: &OpenClBackend) -> DeviceFigures {
    let device = backend.device();
    let cases = SIDES.iter().flat_map(|&side| cases(backend, side)).collect();
    DeviceFigures { name: device.name.clone(), driver: device.driver.clone(), cases }
}

fn cases(backend: &OpenClBackend, side: usize) -> Vec<DeviceCase> {
    let simulator = Simulator::new(backend.clone());
    // The kernel is compiled before anything is measured.
    race(&simulator, side, ROBOTS[0], 1);
    let mut cases = Vec::new();
    for robots in ROBOTS {
        let spent = race(&simulator, side, robots, CYCLE_STEPS);
        let work = robots as f64 * f64::from(CYCLE_STEPS * Constants::default().substeps);
        cases.push(DeviceCase { bounds: format!("{side}x{side}"), robots, substeps: work / spent.as_secs_f64() });
        if spent > PATIENCE {
            break;
        }
    }
    cases
}

fn race(simulator: &Simulator, side: usize, robots: usize, steps: u32) -> Duration {
    let schedule = Schedule::constant(Pattern::PAIRS[1], steps);
    let trial = |robot| Trial { body: Body::patchwork(side, robot), schedule: schedule.clone() };
    let trials: Vec<Trial> = (0..robots).map(trial).collect();
    let started = Instant::now();
    simulator.run_trials(&Setting::default(), &trials);
    started.elapsed()
}

impl DeviceFigures {
    pub fn describe(&self) -> String {
        use Align::{Left, Right};
        let mut table = TextTable::new(&[("box", Left), ("robots", Right), ("substeps", Right)]);
        for DeviceCase { bounds, robots, substeps } in &self.cases {
            table.push(vec![bounds.clone(), robots.to_string(), format!("{:.0}k", substeps / 1e3)]);
        }
        format!("\n{}, driver {}; lane-substeps per second by robots in flight\n{table}", self.name, self.driver)
    }
}
