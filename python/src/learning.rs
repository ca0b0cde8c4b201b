//! Circuits that are learned from rows of values.

use std::path::PathBuf;
use std::time::Instant;

use nbc::{
    CircuitFormat, Diagnostics, LearnOptions, Learning, LearningReport, LearningRequest, Observer, Sources,
    encode_circuit, read_rows, with_comment,
};
use pyo3::prelude::*;
use serde::Serialize;

use crate::described::json;
use crate::errors::{bad_value, diagnosed};
use crate::work::{self, Watch};

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct LearningArguments {
    name: String,
    /// A file of rows, or the name for the text.
    file: String,
    text: Option<String>,
    output: Option<String>,
    target: Vec<String>,
    gates: usize,
    hold_out: f64,
    group: usize,
    seed: u64,
}

#[derive(Serialize)]
struct LearningResult {
    data: LearningReport,
    text: String,
    source: Option<String>,
    picture: Option<String>,
}

impl LearningArguments {
    fn run(self, format: Option<CircuitFormat>, watch: &Watch) -> Result<Option<LearningResult>, Diagnostics> {
        let started = Instant::now();
        let Self { name, file, text, output, target, gates, hold_out, group, seed } = self;
        let (sources, file) = match text {
            Some(text) => {
                let mut sources = Sources::default();
                let file = sources.add(file, text);
                (sources, file)
            }
            None => read_rows(&PathBuf::from(file))?,
        };
        let options = LearnOptions { gates, hold_out, seed, group };
        let request = LearningRequest { circuit: &name, rows: sources.file(file), outputs: &target, options };
        let command = request.command();
        let found = |list| Diagnostics { list, sources: sources.clone() };
        let mut learning = Learning::new(&request).map_err(found)?;
        if let Some(format) = format {
            encode_circuit(&learning.outline(), format)?;
        }
        let mut observer = watch.observer();
        while learning.advance() {
            if observer.is_cancelled() {
                return Ok(None);
            }
            let (done, all) = learning.progress();
            observer.progress(done, all);
        }
        let learned = learning.finish();
        let report = LearningReport::of(&learned, started.elapsed().as_secs_f64());
        let comment = report.provenance(&command);
        let written = |format| -> Result<Vec<u8>, Diagnostics> {
            Ok(with_comment(encode_circuit(&learned.design, format)?, format, &comment))
        };
        if let (Some(path), Some(format)) = (output, format) {
            nbc::write_file(&PathBuf::from(path), &written(format)?)?;
        }
        // A circuit may be too large for a program, and still fit the file that is wanted.
        let source = written(CircuitFormat::Nb).ok().and_then(|bytes| String::from_utf8(bytes).ok());
        let picture = report.draw_confusion().ok().map(|svg| svg.finish());
        let text = report.text();
        Ok(Some(LearningResult { data: report, text, source, picture }))
    }
}

/// Learns a circuit from rows, and writes it if a file is named: the report as JSON, with its text, the circuit as a
/// program, and the confusions as a picture.
#[pyfunction]
pub fn learn(py: Python<'_>, arguments: LearningArguments, progress: Option<Bound<'_, PyAny>>) -> PyResult<String> {
    let watch = Watch::over(0);
    let format = |path: &String| CircuitFormat::of_path(path).map_err(|fault| bad_value(fault.message));
    let format = arguments.output.as_ref().map(format).transpose()?;
    let learned = work::run(py, &watch, progress.as_ref(), move |watch| arguments.run(format, watch))?.finished()?;
    let learned = learned.map_err(|found| diagnosed(py, &found))?;
    json(py, &learned)
}
