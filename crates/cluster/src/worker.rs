//! A worker: does tasks for searches on other machines.

use std::fs;
use std::sync::atomic::Ordering;
use std::thread;

use async_nats::jetstream::consumer::PullConsumer;
use rayon::ThreadPoolBuilder;
use tokio::runtime::EnterGuard;

use crate::Log;
use crate::connection::{Connection, NatsServer, random_name};
use crate::message::is_name;
use crate::physics::PhysicsId;
use crate::wording;
use crate::worker_state::WorkerState;
use crate::worker_thread::WorkerThread;
use nbc_base::diag::Diagnostic;
use nbc_circuit::CancelFlag;
use nbc_sim::Simulator;

#[derive(Clone, Debug)]
pub struct WorkerOptions {
    pub server: NatsServer,
    /// The name of the worker; without it, that of the machine and a random number.
    pub name: Option<String>,
    pub cancel: CancelFlag,
    pub log: Log,
}

/// It must stay on the thread that opened it.
pub struct Worker {
    queue: PullConsumer,
    state: WorkerState,
    // Dropped last, because the others need it.
    _entered: EnterGuard<'static>,
}

impl Worker {
    pub fn open(options: WorkerOptions) -> Result<Self, Diagnostic> {
        let WorkerOptions { server, name, cancel, log } = options;
        let name = name.unwrap_or_else(default_name);
        if !is_name(&name) || name.contains('.') {
            return Err(wording::bad_worker_name(&name));
        }
        let connection = Connection::open(&server, &format!("nbc worker {name}"), log)?;
        let entered = connection.enter();
        let physics = PhysicsId::compute(&Simulator::default());
        let queue = connection.open_queue(&physics.token())?;
        Ok(Self { queue, state: WorkerState::new(name, connection, physics, cancel, log), _entered: entered })
    }

    pub fn name(&self) -> &str {
        &self.state.name
    }

    /// The hash of its physics. Searches have work for it only if theirs is the same.
    pub fn physics(&self) -> u64 {
        self.state.physics.0
    }

    pub fn done(&self) -> u64 {
        self.state.tally.evaluations.load(Ordering::Relaxed)
    }

    pub fn work(&self, threads: usize) -> Result<(), Diagnostic> {
        self.state.report(threads as u32);
        self.state.listen();
        thread::scope(|scope| {
            let work = || {
                let _entered = self.state.connection.enter();
                // The simulations of this thread's tasks stay on it.
                let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
                let _alone = alone.map_err(|error| wording::no_client(&error.to_string()))?;
                WorkerThread::new(&self.state, self.queue.clone()).work()
            };
            let started: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            let ended = started.into_iter().map(|thread| thread.join().expect("evaluations do not panic"));
            ended.collect::<Vec<_>>().into_iter().collect()
        })
    }
}

fn default_name() -> String {
    let host = fs::read_to_string("/proc/sys/kernel/hostname").or_else(|_| std::env::var("HOSTNAME"));
    let host = host.unwrap_or_else(|_| "worker".to_owned());
    let sound = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    let host: String = host.trim().chars().map(sound).take(64).collect();
    format!("{host}-{}", random_name())
}
