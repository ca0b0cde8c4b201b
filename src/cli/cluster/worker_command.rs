//! `nbc worker`: makes evaluations for searches on other machines.

use std::fs;
use std::sync::atomic::Ordering;
use std::thread;

use async_nats::jetstream::consumer::PullConsumer;
use clap::Args;
use rayon::ThreadPoolBuilder;

use crate::cli::cluster::connection::{Connection, NatsArguments, random_name};
use crate::cli::cluster::message::is_name;
use crate::cli::cluster::physics::{PROGRAM, PhysicsId};
use crate::cli::cluster::worker::Worker;
use crate::cli::cluster::worker_thread::WorkerThread;
use crate::cli::wording::ClusterError;
use crate::cli::{Context, Failure, Interrupt, Status};
use nbc_base::diag::counted;
use nbc_sim::Simulator;

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
    /// Works until a signal arrives.
    ///
    /// # Errors
    /// When the server cannot be used, or a search rejects the results.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let interrupt = Interrupt::watch()?;
        let name = self.name.clone().unwrap_or_else(default_name);
        if !is_name(&name) || name.contains('.') {
            return Err(ClusterError::Name { name }.into());
        }
        let connection = Connection::open(&self.server, &format!("nbc worker {name}"))?;
        let _entered = connection.enter();
        let threads = self.threads.map_or_else(|| thread::available_parallelism().map_or(1, usize::from), usize::from);
        let physics = PhysicsId::compute(&Simulator::default());
        let queue = connection.open_queue(&physics.token())?;
        let shown = counted(threads, "thread");
        context.log(&format!("worker `{name}`: {shown}, version {PROGRAM}, physics {:016x}\n", physics.0));
        let worker = Worker::new(name, connection, physics, interrupt);
        worker.report(threads as u32);
        worker.listen();
        let worked = work(&worker, &queue, threads);
        let done = worker.tally.evaluations.load(Ordering::Relaxed);
        context.log(&format!("worker `{}`: {}\n", worker.name, counted(done as usize, "evaluation")));
        worked.map(|()| Status::Done)
    }
}

/// Evaluates on some threads, each for itself, until a signal arrives.
fn work(worker: &Worker, queue: &PullConsumer, threads: usize) -> Result<(), Failure> {
    thread::scope(|scope| {
        let work = || {
            let _entered = worker.connection.enter();
            // The simulations of this thread's tasks stay on it.
            let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
            let _alone = alone.map_err(|error| ClusterError::Start { reason: error.to_string() })?;
            WorkerThread::new(worker, queue.clone()).work()
        };
        let started: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let ended = started.into_iter().map(|thread| thread.join().expect("evaluations do not panic"));
        ended.collect::<Vec<_>>().into_iter().collect()
    })
}

/// The name of the machine and a random number.
fn default_name() -> String {
    let host = fs::read_to_string("/proc/sys/kernel/hostname").or_else(|_| std::env::var("HOSTNAME"));
    let host = host.unwrap_or_else(|_| "worker".to_owned());
    let sound = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    let host: String = host.trim().chars().map(sound).take(64).collect();
    format!("{host}-{}", random_name())
}
