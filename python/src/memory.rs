//! Memory that a call will need, asked for before it begins: an allocation that fails later would end the process.

use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// The memory of a voxel during its simulation, in bytes: its points and springs, and their places in a batch. Sixteen
/// bodies of 100 x 100 needed 890 at most.
pub const VOXEL_BYTES: u64 = 1024;

pub fn too_large(bytes: u64, what: &str, hint: &str) -> PyErr {
    let size = match bytes >> 30 {
        0 => format!("{} MiB", (bytes >> 20).max(1)),
        size => format!("{size} GiB"),
    };
    PyMemoryError::new_err(format!("{what} would need {size}; {hint}"))
}

/// Checks that there is room for that many bytes at this moment.
pub fn check(bytes: u64, what: &str, hint: &str) -> PyResult<()> {
    let room = usize::try_from(bytes).ok().and_then(|size| Vec::<u8>::new().try_reserve_exact(size).ok());
    room.ok_or_else(|| too_large(bytes, what, hint))
}

pub fn reserved<T>(count: usize) -> PyResult<Vec<T>> {
    let mut list = Vec::new();
    let bytes = (count as u64).saturating_mul(size_of::<T>() as u64);
    list.try_reserve_exact(count).map_err(|_| too_large(bytes, "the bodies", "simulate fewer bodies at once"))?;
    Ok(list)
}
