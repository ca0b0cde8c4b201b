//! `nbc worker`: does the tasks of searches on other machines.

use std::thread;

use clap::Args;
use nbc_cluster::{Worker, WorkerOptions};

use crate::cli::cluster::NatsArguments;
use crate::cli::context::log;
use crate::cli::{Context, Failure, Interrupt, Status};
use nbc_base::diag::counted;

/// Evaluate robots for searches on other machines
#[derive(Args)]
#[command(after_help = "\
Examples:
  nbc worker --nats nats://localhost:4222   evaluate until Ctrl-C
  nbc evolve FILE --nats nats://localhost:4222

Ctrl-C and SIGTERM finish the evaluations at hand. A second one ends at once; other workers take over.")]
pub struct WorkerArguments {
    #[command(flatten)]
    server: NatsArguments,
    /// The number of threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// The name of this worker [default: that of the machine, and a random number]
    #[arg(long)]
    name: Option<String>,
}

impl WorkerArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let cancel = Interrupt::watch()?.cancel();
        let options = WorkerOptions { server: self.server.server(), name: self.name, cancel, log };
        let worker = Worker::open(options)?;
        let threads = self.threads.map_or_else(|| thread::available_parallelism().map_or(1, usize::from), usize::from);
        let (name, version, physics) = (worker.name(), nbc_base::VERSION, worker.physics());
        let shown = counted(threads, "thread");
        context.log(&format!("worker `{name}`: {shown}, version {version}, physics {physics:016x}\n"));
        let worked = worker.work(threads);
        context.log(&format!("worker `{name}`: {}\n", counted(worker.done() as usize, "evaluation")));
        worked?;
        Ok(Status::Done)
    }
}
