//! The arguments of `nbc evolve`.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::options::device::DeviceArguments;
use crate::cli::options::new_path::new_path;
use crate::cli::options::number::number;
use crate::cli::options::queue::QueueArguments;
use crate::cli::options::timings::Timings;
use crate::cli::source_path::source_path;
use nbc_base::diag::Diagnostic;
use nbc_session::RUNS;
use nbc_session::store::ResultPlace;

/// Evolve robots by the evolution declarations of a file
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc evolve                                the evolution `gates` of the prelude, into out/gates
  nbc evolve library/evolve.nb --run gates5 one run of a file
  nbc evolve library/evolve.nb --resume     continue after an interruption

Ctrl-C, SIGTERM and SIGUSR1 write a checkpoint and end with status 4.
Exit status: 0 done, 1 if no run found a robot, 2 bad input, 4 interrupted.")]
pub struct EvolveArguments {
    /// The file with the declarations; without it, `gates` of the prelude
    pub(super) file: Option<PathBuf>,
    /// Run only the declaration with this name, which may be in a file that the file uses
    #[arg(long, value_name = "NAME")]
    pub(super) run: Option<String>,
    /// Use this seed instead of the declared ones
    #[arg(long, value_parser = number::<u64>)]
    pub(super) seed: Option<u64>,
    /// Use this number of generations instead of the declared one
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) generations: Option<u32>,
    /// The folder for results [default: out]
    #[arg(long, value_name = "DIR", value_parser = new_path())]
    pub(super) out: Option<PathBuf>,
    /// Continue from the checkpoints in the folder; start runs without one
    #[arg(long)]
    pub(super) resume: bool,
    /// Run a small version of the first declaration: three seeds, 200 generations
    #[arg(long, conflicts_with_all = ["seed", "generations"])]
    pub(super) quick: bool,
    /// Seconds between checkpoints; 0 writes one each generation
    #[arg(long, value_name = "SECONDS", default_value_t = 10, value_parser = number::<u64>)]
    pub(super) checkpoint_every: u64,
    /// Write a page with plots, on which the archive's elites walk
    #[arg(long)]
    pub(super) report: bool,
    #[command(flatten)]
    pub(super) queue: QueueArguments,
    #[command(flatten)]
    pub(super) device: DeviceArguments,
    #[command(flatten)]
    pub(super) timings: Timings,
}

impl EvolveArguments {
    /// The folder of runs, in which the robots of other evolutions are.
    pub(super) fn runs(&self) -> Result<&str, Diagnostic> {
        source_path(self.out.as_deref().unwrap_or(Path::new(RUNS)))
    }

    /// `part` is the name of a declaration, or a folder below it.
    pub(super) fn folder(&self, part: impl AsRef<Path>) -> ResultPlace {
        ResultPlace::new(self.out.as_deref(), Path::new(RUNS), part)
    }
}
