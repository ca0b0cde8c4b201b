//! Results as JSON, with what Python shows of them.

use nbc::{Diagnostics, Finding};
use pyo3::prelude::*;
use serde::Serialize;

use crate::errors::internal;

#[derive(Serialize)]
pub struct Described<T> {
    pub data: T,
    pub text: String,
    pub warnings: Vec<Finding>,
}

impl<T> Described<T> {
    pub fn new(data: T, text: String) -> Self {
        Self { data, text, warnings: Vec::new() }
    }

    pub fn warned(data: T, text: String, warnings: &Diagnostics) -> Self {
        Self { data, text, warnings: warnings.findings() }
    }
}

pub fn json(py: Python<'_>, value: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| internal(py, &error.to_string()))
}
