//! Does the tasks of a command on this machine's processor or device, or by workers at a NATS server.

use std::sync::Arc;

use crate::cli::options::device::DeviceArguments;
use crate::cli::options::queue::{self, QueueArguments, QueueExecutor};
use crate::cli::{Context, Failure, Interrupt, OpenDevice, Progress};
use nbc_sim::LaneBackend;
use nbc_swarm::{Executor, LocalExecutor};

/// Each call for workers has a thread here that waits, and a run also keeps a file open.
const MOST_WAITING: usize = 500;

/// The most runs whose robots are simulated together: 22 of the paper kept the card of docs/gpu.md busy.
const MOST_TOGETHER: usize = 32;

/// Does the tasks of a command: workers do all of them if they are chosen, else the device.
pub struct TaskExecutor {
    device: OpenDevice,
    local: LocalExecutor,
    queue: Option<QueueExecutor>,
    interrupt: Interrupt,
}

impl TaskExecutor {
    /// Connects to the workers, if `queue` names a server. A signal stops them, and a device that was opened with
    /// [`Interrupt::ending`]. `note` receives notes on the progress.
    pub fn open(
        device: OpenDevice,
        queue: &QueueArguments,
        interrupt: &Interrupt,
        note: impl Fn(String) + Send + 'static,
    ) -> Result<Self, Failure> {
        let queue = queue.open(interrupt, note)?;
        let local = LocalExecutor::new(device.simulator()).until(interrupt.cancel());
        Ok(Self { local, device, queue, interrupt: interrupt.clone() })
    }

    pub fn choose(
        device: DeviceArguments,
        queue: &QueueArguments,
        interrupt: &Interrupt,
        bar: &Arc<Progress>,
        context: &Context,
    ) -> Result<Self, Failure> {
        let device = OpenDevice::open(device, interrupt.ending(LaneBackend::default()), context)?;
        let bar = Arc::clone(bar);
        Self::open(device, queue, interrupt, move |note| bar.note(note))
    }

    pub fn executor(&self) -> &dyn Executor {
        match &self.queue {
            Some(queue) => queue,
            None => &self.local,
        }
    }

    pub fn is_elsewhere(&self) -> bool {
        self.queue.is_some()
    }

    /// How many threads can have work done at once.
    pub fn threads(&self) -> usize {
        threads(self.queue.as_ref())
    }

    /// The most runs of searches whose tasks should be handed over together. Workers take those of a run at a time;
    /// here the robots of several runs fill the lanes of the processor or the device.
    pub fn most_together(&self) -> usize {
        if self.is_elsewhere() { 1 } else { MOST_TOGETHER }
    }

    /// The number of threads for sets of at most so many runs. The processor makes them one after the other, each on
    /// all cores. A device has room for the robots of several, and each takes as long as its simulations one after
    /// another.
    pub fn threads_for_sets(&self, runs: usize) -> usize {
        match self.queue {
            Some(_) => MOST_WAITING,
            None if self.device.is_device() => (MOST_TOGETHER / runs.max(1)).max(1),
            None => 1,
        }
    }

    pub fn is_stopped(&self) -> bool {
        self.interrupt.is_raised()
    }

    pub fn check(&self) -> Result<(), Failure> {
        self.device.check()
    }

    /// Waits until the workers have stopped, and reports a failure of the device.
    pub fn end(self, context: &Context) -> Result<(), Failure> {
        queue::end(self.queue)?;
        self.device.end(context)
    }
}

pub fn threads(queue: Option<&QueueExecutor>) -> usize {
    if queue.is_some() { MOST_WAITING } else { rayon::current_num_threads() }
}
