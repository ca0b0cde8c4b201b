//! `nbc bench`: how fast this machine simulates.

use std::time::{Duration, Instant};

use clap::Args;
use serde::Serialize;

use crate::cli::{Context, Failure, Format, Progress, Status};
use crate::model::{Body, CYCLE_STEPS, Pattern, Schedule, Setting, Trial};
use crate::report::{Align, Table};
use crate::sim::{Constants, Kernel, Simulator};

/// Boxes measured: the paper's.
const SIDES: [usize; 3] = [5, 7, 10];
/// Substeps of the paper's evaluation of one robot: eighty cycles.
const EVALUATION: f64 = 80.0 * CYCLE_STEPS as f64 * SUBSTEPS;
/// Substeps of an env step (docs/physics.md 1).
const SUBSTEPS: f64 = 30.0;
/// How long each figure is measured at least.
const PATIENCE: Duration = Duration::from_millis(500);

/// Measure how fast this machine simulates, on one core
#[derive(Args)]
#[command(after_help = "Example:\n  nbc bench --format json")]
pub struct Arguments {}

/// What one box gave.
#[derive(Serialize)]
struct Case {
    #[serde(rename = "box")]
    bounds: String,
    /// Substeps a second of one simulation alone.
    scalar: f64,
    /// Lane-substeps a second with one body in all lanes.
    lanes: f64,
    /// Lane-substeps a second with a different body in each lane.
    different: f64,
    /// Evaluations a second by the paper's protocol, nothing left out.
    evaluations: f64,
}

#[derive(Serialize)]
struct Figures {
    machine: String,
    width: usize,
    cases: Vec<Case>,
}

impl Arguments {
    /// Measures and prints.
    ///
    /// # Errors
    /// When the output cannot be written.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let kernel = Kernel::default();
        let bar = Progress::new("measuring", SIDES.len() as u64);
        let case = |&side: &usize| {
            let case = measure(side, kernel);
            bar.add(1);
            case
        };
        let cases = SIDES.iter().map(case).collect();
        drop(bar);
        let figures = Figures { machine: machine(kernel), width: kernel.lanes(), cases };
        match context.format {
            Format::Json => context.print_json(&figures)?,
            Format::Text => context.print(describe(&figures))?,
        }
        Ok(Status::Done)
    }
}

fn measure(side: usize, kernel: Kernel) -> Case {
    let lanes = speed(side, kernel, 0);
    Case {
        bounds: format!("{side}x{side}"),
        scalar: speed(side, Kernel::SCALAR, 0),
        lanes,
        different: speed(side, kernel, 1),
        evaluations: lanes / EVALUATION,
    }
}

/// Lane-substeps a second, the lanes' bodies `shift` apart.
fn speed(side: usize, kernel: Kernel, shift: usize) -> f64 {
    let schedule = Schedule::constant(Pattern::PAIRS[1], CYCLE_STEPS);
    let trial = |lane| Trial { body: Body::patchwork(side, lane * shift), schedule: schedule.clone() };
    let trials: Vec<Trial> = (0..kernel.lanes()).map(trial).collect();
    let simulator = Simulator { constants: Constants::default(), kernel };
    let setting = Setting::paper();
    let (start, mut rounds) = (Instant::now(), 0);
    // As many trials as a kernel has lanes are one batch, so one core does them all.
    while start.elapsed() < PATIENCE {
        simulator.run_trials(&setting, &trials);
        rounds += 1;
    }
    let substeps = f64::from(rounds) * trials.len() as f64 * f64::from(CYCLE_STEPS) * SUBSTEPS;
    substeps / start.elapsed().as_secs_f64()
}

/// The processor, as far as the system tells, and its instructions.
fn machine(kernel: Kernel) -> String {
    let information = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = information.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    let name = model.map_or(std::env::consts::ARCH, |(_, name)| name.trim());
    format!("{name}, {}", kernel.set().name())
}

fn describe(figures: &Figures) -> String {
    use Align::{Left, Right};
    let columns = [("box", Left), ("scalar", Right), ("one body", Right), ("different", Right), ("evaluations", Right)];
    let mut table = Table::new(&columns);
    for case in &figures.cases {
        let thousands = |speed: f64| format!("{:.0}k", speed / 1e3);
        let speeds = [case.scalar, case.lanes, case.different].map(thousands);
        let [scalar, lanes, different] = speeds;
        table.push(vec![case.bounds.clone(), scalar, lanes, different, format!("{:.2}", case.evaluations)]);
    }
    let Figures { machine, width, .. } = figures;
    format!("{machine}, {width} lanes, one core; substeps a second, and the paper's evaluations a second\n{table}")
}
