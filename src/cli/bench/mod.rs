//! `nbc bench`: how fast this machine simulates.

mod speed;
mod swarm;

use std::collections::BTreeMap;

use clap::Args;
use serde::Serialize;

#[cfg(feature = "gpu")]
use crate::cli::gpu::DeviceFigures;
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::timings::{meter, part_seconds};
use crate::cli::{Context, Failure, OpenDevice, Progress, Status};
use nbc_session::report::{Align, Schema, TextTable};
use nbc_sim::{Kernel, LaneBackend, Part};

use speed::{cycle_substeps, race};
use swarm::SwarmFigures;

/// The boxes of the paper.
const SIDES: [usize; 3] = [5, 7, 10];
/// Cycles of the paper's evaluation of one robot.
const EVALUATION: f64 = 80.0;

/// Measure how fast this machine simulates, on one core and on a device
#[derive(Args)]
#[command(after_help = "Example:\n  nbc bench --format json")]
pub struct BenchArguments {
    /// Also show the share of time of each stage of a substep, with one body in all lanes
    #[arg(long)]
    timings: bool,
    /// Also measure a swarm of 28 robots, on one core and on all threads
    #[arg(long)]
    swarm: bool,
    #[command(flatten)]
    device: DeviceArguments,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Case {
    #[serde(rename = "box")]
    bounds: String,
    /// Substeps per second of one simulation alone.
    scalar: f64,
    /// Lane-substeps per second with one body in all lanes.
    lanes: f64,
    /// Lane-substeps per second with a different body in each lane.
    different: f64,
    /// Full evaluations per second by the paper's protocol.
    evaluations: f64,
    /// Share of the time by stage.
    #[serde(skip_serializing_if = "Option::is_none")]
    timings: Option<BTreeMap<&'static str, f64>>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct BenchFigures {
    /// Processor and instructions.
    machine: String,
    /// Lanes.
    width: usize,
    cases: Vec<Case>,
    #[serde(skip_serializing_if = "Option::is_none")]
    swarm: Option<SwarmFigures>,
    #[cfg(feature = "gpu")]
    #[serde(skip_serializing_if = "Option::is_none")]
    device: Option<DeviceFigures>,
}

impl BenchArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let kernel = Kernel::default();
        let device = OpenDevice::open(self.device, LaneBackend::default(), context)?;
        let bar = Progress::new("measuring", SIDES.len() as u64);
        let case = |&side: &usize| {
            let case = measure(side, kernel, self.timings);
            bar.add(1);
            case
        };
        let cases = SIDES.iter().map(case).collect();
        drop(bar);
        let swarm = self.swarm.then(|| SwarmFigures::measure(kernel)).transpose()?;
        let (machine, width) = (machine(kernel), kernel.lanes());
        let figures = BenchFigures {
            machine,
            width,
            cases,
            swarm,
            #[cfg(feature = "gpu")]
            device: device.figures(),
        };
        device.end(context)?;
        context.print_result(Schema::Bench, &figures, || describe(&figures))?;
        Ok(Status::Done)
    }
}

fn measure(side: usize, kernel: Kernel, timings: bool) -> Case {
    let lanes = race(side, kernel, 0, None);
    Case {
        bounds: format!("{side}x{side}"),
        scalar: race(side, Kernel::SCALAR, 0, None),
        lanes,
        different: race(side, kernel, 1, None),
        evaluations: lanes / (EVALUATION * cycle_substeps()),
        timings: timings.then(|| shares(side, kernel)),
    }
}

/// Shares of the time by stage of a substep, with one body in all lanes.
fn shares(side: usize, kernel: Kernel) -> BTreeMap<&'static str, f64> {
    let meter = meter();
    race(side, kernel, 0, Some(&meter));
    let spent = part_seconds(&meter.times());
    let all: f64 = spent.iter().sum();
    Part::OF_LANES.iter().zip(spent).map(|(part, spent)| (part.name(), spent / all)).collect()
}

fn machine(kernel: Kernel) -> String {
    format!("{}, {}", processor(), kernel.set().name())
}

/// Its name, if the system knows it, or else its architecture.
pub(super) fn processor() -> String {
    let information = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = information.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    model.map_or(std::env::consts::ARCH, |(_, name)| name.trim()).to_owned()
}

fn describe(figures: &BenchFigures) -> String {
    use Align::{Left, Right};
    let columns = [("box", Left), ("scalar", Right), ("one body", Right), ("different", Right), ("evaluations", Right)];
    let mut table = TextTable::new(&columns);
    for case in &figures.cases {
        let thousands = |speed: f64| format!("{:.0}k", speed / 1e3);
        let speeds = [case.scalar, case.lanes, case.different].map(thousands);
        let [scalar, lanes, different] = speeds;
        table.push(vec![case.bounds.clone(), scalar, lanes, different, format!("{:.2}", case.evaluations)]);
    }
    let BenchFigures { machine, width, .. } = figures;
    let mut parts = describe_timings(figures);
    parts.extend(figures.swarm.as_ref().map(SwarmFigures::describe));
    #[cfg(feature = "gpu")]
    parts.extend(figures.device.as_ref().map(DeviceFigures::describe));
    format!("{machine}, {width} lanes, one core; substeps and the paper's evaluations per second\n{table}{parts}")
}

/// Empty if they were not measured.
fn describe_timings(figures: &BenchFigures) -> String {
    let columns = Part::OF_LANES.map(|part| (part.name(), Align::Right));
    let columns: Vec<_> = [("box", Align::Left)].into_iter().chain(columns).collect();
    let mut table = TextTable::new(&columns);
    for case in &figures.cases {
        let Some(timings) = &case.timings else { return String::new() };
        let shares = Part::OF_LANES.iter().map(|part| format!("{:.0} %", 100.0 * timings[part.name()]));
        table.push([case.bounds.clone()].into_iter().chain(shares).collect());
    }
    format!("\nshare of the time with one body in all lanes\n{table}")
}
