//! The threads that simulate.

use std::process;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors::bad_value;

/// The pool of a process.
struct Pool {
    process: u32,
    pool: Arc<ThreadPool>,
}

/// The pool of this process. A forked process inherits the value without its threads, and makes a pool of its own.
static POOL: Mutex<Option<Pool>> = Mutex::new(None);

fn make(threads: usize) -> PyResult<Arc<ThreadPool>> {
    let made = ThreadPoolBuilder::new().num_threads(threads).thread_name(|i| format!("nbc-{i}")).build();
    made.map(Arc::new).map_err(|error| PyRuntimeError::new_err(format!("cannot start threads: {error}")))
}

/// The pool of this process, made at its first use.
pub fn pool() -> PyResult<Arc<ThreadPool>> {
    let mut known = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = known.as_ref().filter(|known| known.process == process::id()) {
        return Ok(known.pool.clone());
    }
    replace(&mut known, 0)
}

fn replace(known: &mut Option<Pool>, threads: usize) -> PyResult<Arc<ThreadPool>> {
    let pool = make(threads)?;
    let old = known.replace(Pool { process: process::id(), pool: pool.clone() });
    // The threads of another process cannot be ended from here.
    if let Some(old) = old.filter(|old| old.process != process::id()) {
        std::mem::forget(old);
    }
    Ok(pool)
}

/// Threads for each core at most: more would not be faster, and many more would take the machine down.
const FOR_EACH_CORE: usize = 16;

/// The most threads that can be set, and the cores of the machine.
#[pyfunction]
pub fn most_threads() -> (usize, usize) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    (FOR_EACH_CORE * cores, cores)
}

/// Uses that many threads from now on; 0 stands for all cores.
#[pyfunction]
pub fn set_threads(threads: usize) -> PyResult<()> {
    let (most, cores) = most_threads();
    if threads > most {
        let message = format!(
            "threads is {threads}, expected 0 to {most}: at most {FOR_EACH_CORE} for each core, and {cores} can be used"
        );
        return Err(bad_value(message));
    }
    replace(&mut POOL.lock().unwrap_or_else(PoisonError::into_inner), threads).map(|_| ())
}
