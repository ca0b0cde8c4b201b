//! Circuits of other tools, mapped onto cells and proved.

use std::path::PathBuf;
use std::time::Instant;

use nbc::{
    CircuitFile, CircuitFormat, CircuitRead, Diagnostics, Session, Synthesis, SynthesisOptions, SynthesisReport,
};
use nbc::{TopModule, cell_library, encode_circuit, named_functions, read_circuit, robot_cells};
use pyo3::prelude::*;

use crate::described::{Described, json};
use crate::errors::{bad_value, diagnosed};
use crate::program::{read_effort, read_objective};
use crate::work::{self, Watch};

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Synthesizing {
    cells: Vec<String>,
    library: Option<String>,
    objective: String,
    effort: String,
    top: Option<String>,
    parameters: Vec<(String, String)>,
    clock: Option<String>,
    expand: bool,
    what_if: Vec<String>,
}

struct Job {
    files: Vec<PathBuf>,
    output: Option<(PathBuf, CircuitFormat)>,
    top: TopModule,
    clock: Option<String>,
    options: SynthesisOptions,
}

impl Synthesizing {
    fn options(&self, py: Python<'_>, watch: &Watch) -> PyResult<SynthesisOptions> {
        let (objective, effort) = (read_objective(&self.objective)?, read_effort(&self.effort)?);
        let plain = |found| diagnosed(py, &Diagnostics::from(found));
        let cells = if self.cells.is_empty() {
            let folder = self.library.as_deref().unwrap_or("shipped");
            let robots = Session::new(nbc::DiskWorld).library(folder).map_err(|found| diagnosed(py, &found))?;
            robot_cells(robots, objective)
        } else {
            cell_library(&self.cells).map_err(plain)?
        };
        let mut options = SynthesisOptions::onto(cells);
        (options.map.objective, options.map.effort) = (objective, effort);
        options.map.cancel = watch.cancel.clone();
        options.expand = self.expand;
        options.what_if = named_functions(&self.what_if).map_err(plain)?;
        Ok(options)
    }

    fn top(&self) -> PyResult<TopModule> {
        let read = |(name, value): &(String, String)| {
            let value = value.parse().map_err(|expected| bad_value(format!("the parameter `{name}`: {expected}")))?;
            Ok((name.clone(), value))
        };
        Ok(TopModule { name: self.top.clone(), parameters: self.parameters.iter().map(read).collect::<PyResult<_>>()? })
    }
}

impl Job {
    fn run(self) -> Result<(SynthesisReport, Diagnostics), Diagnostics> {
        let started = Instant::now();
        let (path, others) = self.files.split_first().expect("there is a file");
        let file = CircuitFile { path, others, clock: self.clock.as_deref(), top: &self.top };
        let CircuitRead { design, warnings, origin } = read_circuit(&file)?;
        let made = Synthesis::of(&design, &self.options)?;
        if let Some((path, format)) = self.output {
            nbc::write_file(&path, &encode_circuit(&made.result, format)?)?;
        }
        Ok((SynthesisReport::of(&made, origin, started.elapsed().as_secs_f64()), warnings))
    }
}

/// Maps a circuit file, and writes the result if a file is named: the report as JSON, with its text and warnings.
#[pyfunction]
pub fn synthesize(
    py: Python<'_>,
    files: Vec<String>,
    output: Option<String>,
    synthesizing: Synthesizing,
) -> PyResult<String> {
    let watch = Watch::over(0);
    let format = |path: String| {
        let format = CircuitFormat::of_path(&path).map_err(|fault| bad_value(fault.message))?;
        Ok::<_, PyErr>((PathBuf::from(path), format))
    };
    let job = Job {
        files: files.into_iter().map(PathBuf::from).collect(),
        output: output.map(format).transpose()?,
        top: synthesizing.top()?,
        clock: synthesizing.clock.clone(),
        options: synthesizing.options(py, &watch)?,
    };
    let made = work::run(py, &watch, None, move |_| job.run())?.finished()?;
    let (report, warnings) = made.map_err(|found| diagnosed(py, &found))?;
    json(py, &Described::warned(&report, report.text(), &warnings))
}
