//! Long work: done by the threads of the package without the lock of the interpreter, while the caller's thread answers
//! Ctrl-C and shows progress.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use nbc::{CancelFlag, Monitor, Observer, Simulator};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

use crate::errors::{internal, interrupted};
use crate::threads::pool;

/// The time from look to look for Ctrl-C.
const POLL: Duration = Duration::from_millis(20);

/// What the caller's thread and the work know of each other.
#[derive(Default)]
pub struct Watch {
    /// Ends simulations, and counts env steps.
    monitor: Arc<Monitor>,
    /// Ends searches of mapping.
    pub cancel: CancelFlag,
    done: AtomicU64,
    all: AtomicU64,
    /// When a search ends that has not found everything.
    deadline: Option<Instant>,
    /// Whether work is measured in parts that are added, and not in env steps.
    has_parts: bool,
}

impl Watch {
    pub fn over(all: u64) -> Arc<Self> {
        Arc::new(Self { all: AtomicU64::new(all), ..Self::default() })
    }

    /// A watch over a search that ends after so many seconds with what it has found.
    pub fn until(seconds: f64) -> Arc<Self> {
        let time = Duration::try_from_secs_f64(seconds).ok();
        Arc::new(Self { deadline: time.and_then(|time| Instant::now().checked_add(time)), ..Self::default() })
    }

    /// A watch over work of that many parts, of which each is added when it is done.
    pub fn over_parts(all: u64) -> Arc<Self> {
        Arc::new(Self { all: AtomicU64::new(all), has_parts: true, ..Self::default() })
    }

    /// A simulator whose work is counted, and ends with an interrupt.
    pub fn simulator(&self) -> Simulator {
        Simulator::monitored(self.monitor.clone())
    }

    fn stop(&self) {
        self.monitor.stop();
        self.cancel.raise();
    }

    pub fn is_stopped(&self) -> bool {
        self.monitor.is_stopped()
    }

    pub fn observer(&self) -> impl Observer + '_ {
        Observing(self)
    }

    /// Sets the amount of work, of which none is done.
    pub fn expect(&self, all: u64) {
        self.done.store(0, Ordering::Relaxed);
        self.all.store(all, Ordering::Relaxed);
    }

    pub fn add(&self, more: u64) {
        self.done.fetch_add(more, Ordering::Relaxed);
    }

    /// An observer for one of several calls at the same time, whose progress is added up.
    pub fn part(&self) -> impl Observer + '_ {
        Part { watch: self, done: 0 }
    }

    fn progress(&self) -> (u64, u64) {
        let env_steps = if self.has_parts { 0 } else { self.monitor.env_steps() };
        (self.done.load(Ordering::Relaxed).max(env_steps), self.all.load(Ordering::Relaxed))
    }
}

struct Observing<'a>(&'a Watch);

impl Observer for Observing<'_> {
    fn progress(&mut self, done: u64, all: u64) {
        self.0.done.store(done, Ordering::Relaxed);
        self.0.all.store(all, Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        self.0.is_stopped()
    }
}

struct Part<'a> {
    watch: &'a Watch,
    done: u64,
}

impl Observer for Part<'_> {
    fn progress(&mut self, done: u64, _: u64) {
        self.watch.add(done - self.done);
        self.done = done;
    }

    fn is_cancelled(&self) -> bool {
        self.watch.is_stopped()
    }
}

pub enum Ended<T> {
    Done(T),
    /// It was interrupted. It stops soon, and then sends its partial result.
    Interrupted(PyErr, Receiver<thread::Result<T>>),
}

impl<T: Send> Ended<T> {
    pub fn finished(self) -> PyResult<T> {
        match self {
            Self::Done(value) => Ok(value),
            Self::Interrupted(reason, _) => Err(reason),
        }
    }

    /// The result as Python has it.
    pub fn or_partial<'py, R: IntoPyObject<'py>>(
        self,
        py: Python<'py>,
        show: impl FnOnce(T) -> PyResult<R>,
    ) -> PyResult<R> {
        let (reason, mut receiver) = match self {
            Self::Done(value) => return show(value),
            Self::Interrupted(reason, receiver) => (reason, receiver),
        };
        if !reason.is_instance_of::<PyKeyboardInterrupt>(py) {
            return Err(reason);
        }
        loop {
            let found;
            (receiver, found) = wait(py, receiver, POLL);
            match found {
                Ok(Ok(value)) => {
                    let partial = show(value).and_then(|shown| shown.into_bound_py_any(py));
                    return Err(partial.map_or(reason, |partial| interrupted(py, partial)));
                }
                Ok(Err(panic)) => return Err(internal(py, &*panic)),
                Err(RecvTimeoutError::Timeout) => py.check_signals()?,
                Err(RecvTimeoutError::Disconnected) => return Err(reason),
            }
        }
    }
}

/// Does short work on the caller's thread.
pub fn at_once<T>(py: Python<'_>, work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(internal(py, &*panic)))
}

/// Does the work. `progress`, if it is one, is called with parts done and all parts.
pub fn run<T: Send + 'static>(
    py: Python<'_>,
    watch: &Arc<Watch>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> PyResult<Ended<T>> {
    let (sender, mut receiver) = channel();
    let shared = watch.clone();
    pool()?.spawn(move || {
        // The receiver is gone if the caller could not wait.
        let _ = sender.send(catch_unwind(AssertUnwindSafe(|| work(&shared))));
    });
    let mut shown = (0, 0);
    loop {
        let found;
        (receiver, found) = wait(py, receiver, POLL);
        let reason = match found {
            Ok(Ok(value)) => return Ok(Ended::Done(value)),
            Ok(Err(panic)) => return Err(internal(py, &*panic)),
            Err(RecvTimeoutError::Disconnected) => return Err(internal(py, &"the work has no result")),
            Err(RecvTimeoutError::Timeout) => attend(py, watch, progress, &mut shown).err(),
        };
        if let Some(reason) = reason {
            watch.stop();
            return Ok(Ended::Interrupted(reason, receiver));
        }
    }
}

/// Waits for a value without the lock of the interpreter.
fn wait<T: Send>(py: Python<'_>, receiver: Receiver<T>, time: Duration) -> (Receiver<T>, Result<T, RecvTimeoutError>) {
    py.detach(move || {
        let found = receiver.recv_timeout(time);
        (receiver, found)
    })
}

/// Looks for Ctrl-C, and reports progress if there is any.
fn attend(py: Python<'_>, watch: &Watch, progress: Option<&Bound<'_, PyAny>>, shown: &mut (u64, u64)) -> PyResult<()> {
    py.check_signals()?;
    if watch.deadline.is_some_and(|end| Instant::now() >= end) {
        watch.cancel.raise();
    }
    let now = watch.progress();
    if let Some(progress) = progress.filter(|_| now != *shown) {
        *shown = now;
        progress.call1(now)?;
    }
    Ok(())
}
