//! Exceptions: diagnostics of the library become `nbc.NbcError`, other bad values `ValueError`.

use std::any::Any;

use nbc::{Diagnostic, Diagnostics};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

/// The exception `name` of `nbc.errors`, made of these arguments.
fn exception<'py>(py: Python<'py>, name: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made = py.import("nbc.errors").and_then(|module| module.getattr(name)?.call1(arguments));
    made.map_or_else(|error| error, PyErr::from_value)
}

pub fn diagnosed(py: Python<'_>, found: &Diagnostics) -> PyErr {
    let data = serde_json::to_string(&found.findings()).expect("diagnostics are data");
    exception(py, "_diagnosed", (found.to_string(), data))
}

pub fn without_place(py: Python<'_>, found: Diagnostic) -> PyErr {
    diagnosed(py, &Diagnostics::from(found))
}

/// The exception for a panic, which is a fault of the library.
pub fn internal(py: Python<'_>, panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    exception(py, "InternalError", (format!("a fault of nbc itself: {text}"),))
}

pub fn robot_fault(py: Python<'_>, fault: &nbc::RobotFault) -> PyErr {
    exception(py, "RobotFault", (fault.to_string(),))
}

pub fn interrupted(py: Python<'_>, partial: Bound<'_, PyAny>) -> PyErr {
    exception(py, "Interrupted", (partial,))
}

pub fn bad_value(message: impl Into<String>) -> PyErr {
    PyValueError::new_err(message.into())
}

/// The exception for a value that another thread has at this moment and this process never will.
pub fn forked(what: &str) -> PyErr {
    PyRuntimeError::new_err(format!("the {what} was in use when this process was forked; make a new one here"))
}

/// A message of the form "unknown field `a`, expected `b` or `c`" that also offers the expected word most like the
/// first.
pub fn offering(message: &str) -> String {
    let mut quoted = message.split('`').skip(1).step_by(2);
    let nearest = quoted.next().and_then(|found| nbc::nearest(found, quoted));
    match nearest.filter(|_| message.starts_with("unknown ")) {
        Some(near) => format!("{message}; did you mean `{near}`?"),
        None => message.to_owned(),
    }
}

/// `ValueError` for a word that is none of the expected ones, with the one most like it.
pub fn bad_word(what: &str, word: &str, expected: &[&str]) -> PyErr {
    let near = nbc::nearest(word, expected.iter().copied());
    let offer = near.map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
    let words = match expected {
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
        [] => String::new(),
    };
    bad_value(format!("invalid {what} `{word}`; expected {words}{offer}"))
}

/// Of the known names, the one most like `word`. Python's own look-ups offer it.
#[pyfunction]
pub fn nearest(word: &str, known: Vec<String>) -> Option<String> {
    nbc::nearest(word, known.iter().map(String::as_str)).map(str::to_owned)
}
