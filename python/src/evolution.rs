//! Declarations of evolutions.

use nbc::{Axis, MemoryWorld, Palette, Session};
use pyo3::prelude::*;

use crate::errors::{bad_value, diagnosed, without_place};
use crate::work::at_once;

#[pyclass(frozen)]
pub struct Evolution(pub nbc::Evolution);

#[pymethods]
impl Evolution {
    /// The last evolution declared in a text, or the paper's; `file` is what the text is called in messages.
    #[new]
    fn new(py: Python<'_>, text: &str, file: &str) -> PyResult<Self> {
        at_once(py, || {
            let mut session = Session::new(MemoryWorld::default());
            session.update(file, 1, text);
            let checked = session.open(file).map_err(|found| diagnosed(py, &found))?;
            let last = checked.program.evolutions.last().cloned();
            last.map(Self).ok_or_else(|| bad_value("the text declares no evolution"))
        })
    }

    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        let read: Result<nbc::Evolution, _> = serde_json::from_str(text);
        read.map(Self).map_err(|error| bad_value(format!("the text is not a declaration: {error}")))
    }

    fn to_json(&self) -> String {
        serde_json::to_string(&self.0).expect("an evolution can be written as JSON")
    }

    fn axes(&self) -> Vec<(&'static str, usize)> {
        axes(&self.0.descriptors, &self.0.palette)
    }
}

/// Name and bins of each axis of an archive with bodies of these materials.
pub fn axes(axes: &[Axis], palette: &Palette) -> Vec<(&'static str, usize)> {
    axes.iter().map(|axis| (axis.word(), axis.bins(palette.inputs()))).collect()
}

pub fn no_checkpoint(py: Python<'_>, path: &std::path::Path) -> PyErr {
    match nbc::Checkpoint::open(path) {
        Err(found) => without_place(py, found),
        Ok(_) => pyo3::exceptions::PyFileNotFoundError::new_err(format!("there is no checkpoint `{}`", path.display())),
    }
}
