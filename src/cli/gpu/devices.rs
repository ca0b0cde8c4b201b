//! `nbc devices`: lists the OpenCL devices of this machine, and compares their results with those of the processor.

use clap::Args;
use serde::Serialize;

use crate::cli::gpu::wording::device_failure;
use crate::cli::{Context, Failure, Progress, Status};
use nbc_session::report::{Align, Schema, TextTable};
use nbc_sim::{BoxComparison, LaneBackend, OpenClBackend, OpenClDevice, SelfTest};

/// List the OpenCL devices that can simulate
#[derive(Args)]
#[command(after_help = "Examples:
  nbc devices
  nbc devices --self-test

Every device is compared with this processor in a few simulations, to the last bit. `--self-test` compares bodies of \
every box of the paper. A device whose results differ is never used.
Exit status: 0 done, 1 a device's results differ or it failed, 2 there is no driver.")]
pub struct DevicesArguments {
    /// Compare bodies of every box of the paper
    #[arg(long)]
    self_test: bool,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(in crate::cli) struct DeviceList {
    devices: Vec<DeviceReport>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct DeviceReport {
    /// As in `--device gpu:NUMBER`.
    number: usize,
    name: String,
    kind: &'static str,
    platform: String,
    driver: String,
    /// In bytes.
    memory: u64,
    usable: bool,
    /// Why it cannot be used.
    problem: Option<String>,
    /// The comparisons with this processor.
    boxes: Vec<BoxReport>,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct BoxReport {
    #[serde(rename = "box")]
    bounds: String,
    /// Simulations compared to the last bit.
    trials: usize,
    /// Those that differ.
    different: usize,
}

impl DevicesArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let devices = OpenClDevice::all().map_err(|error| device_failure(&error))?;
        let test = if self.self_test { SelfTest::FULL } else { SelfTest::QUICK };
        let bar = Progress::new("testing", devices.len() as u64);
        let report = |device: &OpenClDevice| {
            let report = DeviceReport::of(device, test);
            bar.add(1);
            report
        };
        let list = DeviceList { devices: devices.iter().map(report).collect() };
        drop(bar);
        context.print_result(Schema::Devices, &list, || describe(&list.devices))?;
        Ok(if list.devices.iter().all(|report| report.usable) { Status::Done } else { Status::TestFailed })
    }
}

impl DeviceReport {
    fn of(device: &OpenClDevice, test: SelfTest) -> Self {
        let opened = OpenClBackend::unchecked(device, LaneBackend::default(), None);
        let (comparisons, problem) = match opened.and_then(|backend| backend.test(test)) {
            Ok((comparisons, problem)) => (comparisons, problem),
            Err(error) => (Vec::new(), Some(error)),
        };
        let problem = problem.map(|error| device_failure(&error).message);
        Self {
            number: device.number,
            name: device.name.clone(),
            kind: device.kind.word(),
            platform: device.platform.clone(),
            driver: device.driver.clone(),
            memory: device.global_bytes,
            usable: problem.is_none(),
            problem,
            boxes: comparisons.iter().map(BoxReport::of).collect(),
        }
    }
}

impl BoxReport {
    fn of(comparison: &BoxComparison) -> Self {
        let BoxComparison { side, trials, different } = *comparison;
        Self { bounds: format!("{side}x{side}"), trials, different }
    }
}

fn describe(reports: &[DeviceReport]) -> String {
    use Align::{Left, Right};
    let columns = [("", Left), ("device", Left), ("kind", Left), ("memory", Right), ("driver", Left), ("result", Left)];
    let mut table = TextTable::new(&columns);
    for report in reports {
        let compared: usize = report.boxes.iter().map(|found| found.trials).sum();
        let result = match &report.problem {
            Some(problem) => problem.clone(),
            None => format!("{compared} simulations with the bits of this processor"),
        };
        let memory = format!("{:.1} GiB", report.memory as f64 / f64::from(1 << 30));
        let driver = format!("{} {}", report.platform, report.driver);
        let name = report.name.clone();
        table.push(vec![format!("gpu:{}", report.number), name, report.kind.to_owned(), memory, driver, result]);
    }
    table.to_string()
}
