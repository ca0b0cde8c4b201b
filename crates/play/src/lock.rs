//! Access to what several threads share.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// What is behind a mutex, also after a panic of a thread that had it.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
