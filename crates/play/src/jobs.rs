//! Long requests: each runs on a thread of its own, reports its progress, and can be cancelled.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::message::RequestResult;
use crate::outbox::Outbox;
use crate::refusal::Refused;
use nbc_base::budget::Limit;
use nbc_circuit::CancelFlag;
use nbc_session::{CompileOptions, Observer};
use nbc_sim::{Monitor, Simulator};

/// The time after which a request is stopped.
const TIME: Duration = Duration::from_secs(Limit::PageSeconds.most());

/// The requests of a page that run.
pub(super) struct Jobs {
    running: Arc<Mutex<BTreeMap<u64, Running>>>,
    making: CompileOptions,
    outbox: Outbox,
}

/// The kinds of requests, each of which has room of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JobKind {
    /// A check of a text, which the page asks for while its user types.
    Check,
    /// All others.
    Work,
}

/// The handle to stop a request that runs.
struct Running {
    kind: JobKind,
    stop: CancelFlag,
    monitor: Arc<Monitor>,
    end: Instant,
}

impl Running {
    fn stop(&self) {
        self.stop.raise();
        self.monitor.stop();
    }
}

/// A request that runs, as its own thread sees it.
pub(super) struct Job {
    pub(super) id: u64,
    pub(super) outbox: Outbox,
    pub(super) stop: CancelFlag,
    making: CompileOptions,
    monitor: Arc<Monitor>,
    end: Instant,
    /// The percentage that was reported last.
    told: u64,
}

/// The answer of a request; `None` if another thread will answer.
pub(super) type JobEnd = Result<Option<RequestResult>, Refused>;

impl Jobs {
    /// No requests. Those that come make swarms with these options.
    pub(super) fn new(outbox: Outbox, making: CompileOptions) -> Self {
        Self { running: Arc::default(), making, outbox }
    }

    /// Starts a request; the flag that stops it, if it could be started.
    pub(super) fn start(
        &self,
        id: u64,
        kind: JobKind,
        work: impl FnOnce(&mut Job) -> JobEnd + Send + 'static,
    ) -> Option<CancelFlag> {
        let (stop, monitor, end) = (CancelFlag::default(), Arc::new(Monitor::default()), Instant::now() + TIME);
        {
            let mut running = lock(&self.running);
            let same = running.values().filter(|one| one.kind == kind).count() as u64;
            // Otherwise it could not be cancelled, and the end of one would count as that of the other.
            let refused = match running.contains_key(&id) {
                true => Some(Refused::NumberInUse { id }),
                false => Limit::PageJobs.permit(same + 1).err().map(|_| Refused::Busy { most: same as usize }),
            };
            if let Some(refused) = refused {
                self.outbox.answer(id, Err(refused));
                return None;
            }
            running.insert(id, Running { kind, stop: stop.clone(), monitor: monitor.clone(), end });
        }
        let (running, outbox) = (self.running.clone(), self.outbox.clone());
        let mut job = Job { id, outbox, stop: stop.clone(), making: self.making.clone(), monitor, end, told: 0 };
        thread::spawn(move || {
            let ended = catch_unwind(AssertUnwindSafe(|| work(&mut job)));
            lock(&running).remove(&id);
            match ended.unwrap_or(Err(Refused::Internal)) {
                Ok(None) => {}
                Ok(Some(answer)) => job.outbox.answer(id, Ok(answer)),
                Err(refused) => job.outbox.answer(id, Err(job.reason(refused))),
            }
        });
        Some(stop)
    }

    /// Stops a request.
    pub(super) fn cancel(&self, id: u64) {
        lock(&self.running).get(&id).into_iter().for_each(Running::stop);
    }

    /// Whether none runs.
    pub(super) fn are_done(&self) -> bool {
        lock(&self.running).is_empty()
    }

    /// Stops the requests that take too long.
    pub(super) fn end_late(&self) {
        let now = Instant::now();
        lock(&self.running).values().filter(|one| one.end < now).for_each(Running::stop);
    }
}

impl Drop for Jobs {
    /// Stops the requests, because the page has left.
    fn drop(&mut self) {
        lock(&self.running).values().for_each(Running::stop);
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Job {
    /// A simulator whose simulations end when it is stopped.
    pub(super) fn simulator(&self) -> Simulator {
        Simulator::monitored(self.monitor.clone())
    }

    /// How circuits are compiled; that ends early when the request is stopped.
    pub(super) fn options(&self) -> CompileOptions {
        CompileOptions { cancel: self.stop.clone(), ..self.making.clone() }
    }

    /// Must be called now and then, so that the request can be stopped.
    ///
    /// # Errors
    /// When the request must stop.
    pub(super) fn check(&self) -> Result<(), Refused> {
        if self.stop.is_raised() { Err(self.reason(Refused::Cancelled)) } else { Ok(()) }
    }

    /// The reason for a refusal; that of work which was stopped because it took too long is [`Refused::TimedOut`].
    fn reason(&self, refused: Refused) -> Refused {
        match refused {
            Refused::Cancelled if self.end < Instant::now() => Refused::TimedOut { seconds: TIME.as_secs() },
            other => other,
        }
    }
}

impl Observer for Job {
    fn progress(&mut self, done: u64, all: u64) {
        let percentage = done * 100 / all.max(1);
        if percentage > self.told {
            self.told = percentage;
            self.outbox.progress(self.id, [done, all]);
        }
    }

    fn is_cancelled(&self) -> bool {
        self.stop.is_raised()
    }
}
