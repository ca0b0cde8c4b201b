//! Where a command does its tasks: on this machine or its device, or by workers at a NATS server.

use std::sync::Arc;

use crate::cli::device::DeviceArguments;
use crate::cli::distant::DistantLaboratory;
use crate::cli::gpu::OpenDevice;
use crate::cli::nats_access::QueueArguments;
use crate::cli::{Context, Failure, Interrupt, Progress, cluster};
use nbc_sim::{LaneBackend, Simulator};
use nbc_swarm::Laboratory;

/// The most tasks of other machines that are waited for at once: each has a thread here that waits.
const MOST_WAITING: usize = 500;

/// The laboratory of a command.
pub struct OpenLaboratory {
    device: OpenDevice,
    simulator: Simulator,
    distant: Option<Box<dyn DistantLaboratory>>,
    interrupt: Interrupt,
}

impl OpenLaboratory {
    /// Opens the chosen one, with notes on its progress shown by `bar`.
    ///
    /// # Errors
    /// When the device or the server cannot be used.
    pub fn open(
        device: DeviceArguments,
        queue: &QueueArguments,
        bar: &Arc<Progress>,
        context: &Context,
    ) -> Result<Self, Failure> {
        let device = OpenDevice::open(device.choice(), LaneBackend::default(), context)?;
        // Without workers, a signal ends the program.
        let interrupt = if queue.nats.is_some() { Interrupt::watch()? } else { Interrupt::default() };
        let distant = open_distant(queue, &interrupt, bar)?;
        Ok(Self { simulator: device.simulator(), device, distant, interrupt })
    }

    /// Where tasks are done.
    pub fn place(&self) -> &dyn Laboratory {
        match &self.distant {
            Some(distant) => distant.as_ref(),
            None => &self.simulator,
        }
    }

    /// The number of threads that can have work done at once.
    pub fn threads(&self) -> usize {
        threads(self.distant.as_deref())
    }

    /// Whether a signal has stopped the work.
    pub fn is_stopped(&self) -> bool {
        self.interrupt.is_raised()
    }

    /// Ends it.
    ///
    /// # Errors
    /// When it has failed.
    pub fn end(self, context: &Context) -> Result<(), Failure> {
        if let Some(distant) = self.distant {
            distant.end()?;
        }
        self.device.end(context)
    }
}

/// The workers, if they do the work; a signal stops them.
///
/// # Errors
/// When the server cannot be used.
pub fn open_distant(
    queue: &QueueArguments,
    interrupt: &Interrupt,
    bar: &Arc<Progress>,
) -> Result<Option<Box<dyn DistantLaboratory>>, Failure> {
    let Some(server) = &queue.nats else { return Ok(None) };
    let bar = Arc::clone(bar);
    cluster::open_laboratory(server, queue, interrupt, move |note| bar.note(note)).map(Some)
}

/// The number of threads that can have work done at once: here, or by workers.
pub fn threads(distant: Option<&dyn DistantLaboratory>) -> usize {
    if distant.is_some() { MOST_WAITING } else { rayon::current_num_threads() }
}
