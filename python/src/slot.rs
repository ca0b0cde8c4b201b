//! A value that one call at a time works on: others wait, and a closed one is refused.

use std::process;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::errors::{bad_value, forked};
use crate::work::{self, Ended, Watch, at_once};

/// The time from look to look for Ctrl-C.
const POLL: Duration = Duration::from_millis(20);

enum Place<T> {
    /// Nobody uses it.
    Here(T),
    /// A call works on it.
    Away,
    Closed,
    /// The call that worked on it failed.
    Lost,
}

struct Shared<T> {
    place: Mutex<Place<T>>,
    returned: Condvar,
}

impl<T> Shared<T> {
    fn place(&self) -> MutexGuard<'_, Place<T>> {
        self.place.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn set(&self, place: Place<T>) {
        *self.place() = place;
        self.returned.notify_one();
    }
}

/// A value with its name in messages.
pub struct Slot<T> {
    shared: Arc<Shared<T>>,
    what: &'static str,
    process: u32,
}

/// Puts a value back, or records that it is lost.
struct Lease<T> {
    shared: Arc<Shared<T>>,
    value: Option<T>,
}

impl<T> Drop for Lease<T> {
    fn drop(&mut self) {
        let place = match self.value.take() {
            Some(value) if !std::thread::panicking() => Place::Here(value),
            _ => Place::Lost,
        };
        self.shared.set(place);
    }
}

impl<T: Send + 'static> Slot<T> {
    pub fn new(what: &'static str, value: T) -> Self {
        let shared = Shared { place: Mutex::new(Place::Here(value)), returned: Condvar::new() };
        Self { shared: Arc::new(shared), what, process: process::id() }
    }

    /// Does long work on the value; see [`work::run`]. Work that could not be waited for puts it back later.
    pub fn run<R: Send + 'static>(
        &self,
        py: Python<'_>,
        watch: &Arc<Watch>,
        progress: Option<&Bound<'_, PyAny>>,
        work: impl FnOnce(&mut T, &Watch) -> R + Send + 'static,
    ) -> PyResult<Ended<R>> {
        let mut lease = self.take(py)?;
        work::run(py, watch, progress, move |watch| work(lease.value.as_mut().expect("a lease has its value"), watch))
    }

    /// Reads or changes the value at once.
    pub fn with<R>(&self, py: Python<'_>, work: impl FnOnce(&mut T) -> PyResult<R>) -> PyResult<R> {
        let mut lease = self.take(py)?;
        at_once(py, move || work(lease.value.as_mut().expect("a lease has its value")))
    }

    /// Drops the value. A closed one stays closed.
    pub fn close(&self, py: Python<'_>) -> PyResult<()> {
        if self.is_closed() {
            return Ok(());
        }
        let mut lease = self.take(py)?;
        lease.value = None;
        let shared = lease.shared.clone();
        drop(lease);
        shared.set(Place::Closed);
        Ok(())
    }

    pub fn is_closed(&self) -> bool {
        matches!(*self.shared.place(), Place::Closed | Place::Lost)
    }

    fn take(&self, py: Python<'_>) -> PyResult<Lease<T>> {
        loop {
            if let Some(lease) = self.try_take()? {
                return Ok(lease);
            }
            py.detach(|| drop(self.shared.returned.wait_timeout(self.shared.place(), POLL)));
            py.check_signals()?;
        }
    }

    fn try_take(&self) -> PyResult<Option<Lease<T>>> {
        let mut place = self.shared.place();
        match &*place {
            Place::Closed => return Err(bad_value(format!("the {} is closed", self.what))),
            Place::Lost => {
                return Err(PyRuntimeError::new_err(format!("the {} was lost in an earlier fault", self.what)));
            }
            Place::Away if self.process != process::id() => return Err(forked(self.what)),
            Place::Away => return Ok(None),
            Place::Here(_) => {}
        }
        let Place::Here(value) = std::mem::replace(&mut *place, Place::Away) else { return Ok(None) };
        Ok(Some(Lease { shared: self.shared.clone(), value: Some(value) }))
    }
}
