//! Searches: ask, evaluate, tell; archives and checkpoints.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use nbc::{Candidate, CandidateOutcome, Checkpoint, Elite, NicheKey, Palette, Work};
use numpy::{IntoPyArray, PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::errors::{bad_value, without_place};
use crate::evaluation;
use crate::evolution::{Evolution, axes, no_checkpoint};
use crate::slot::Slot;
use crate::work::{Watch, at_once};

/// The number of the next search, so that its candidates are known as its own.
static NEXT: AtomicU64 = AtomicU64::new(0);

/// A search with the work it has done.
struct Course {
    search: nbc::Search,
    work: Work,
}

/// A MAP-Elites search in progress.
#[pyclass(frozen)]
pub struct Search {
    course: Slot<Course>,
    evolution: nbc::Evolution,
    number: u64,
}

/// The candidates of a generation.
#[pyclass(frozen)]
pub struct Candidates {
    list: Arc<Vec<Candidate>>,
    generation: u32,
    search: u64,
}

#[pymethods]
impl Candidates {
    fn __len__(&self) -> usize {
        self.list.len()
    }

    /// Their bodies.
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (width, height) = self.list.first().map_or((0, 0), |one| (one.body.width(), one.body.height()));
        let codes: Vec<u8> = self.list.iter().flat_map(|one| one.body.codes().to_vec()).collect();
        codes.into_pyarray(py).reshape([self.list.len(), height, width])
    }

    /// The generation that they are of.
    #[getter]
    fn generation(&self) -> u32 {
        self.generation
    }
}

impl Search {
    fn of(search: nbc::Search, work: Work) -> Self {
        let evolution = search.evolution().clone();
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        Self { course: Slot::new("search", Course { search, work }), evolution, number }
    }

    /// The search of the checkpoint that is called `name`.
    fn continued(py: Python<'_>, checkpoint: Checkpoint, name: &str, evolution: &Evolution) -> PyResult<Self> {
        let work = Work { env_steps: checkpoint.env_steps, left_out: checkpoint.left_out };
        let seed = checkpoint.state.seed;
        let search = checkpoint.resume(name, &evolution.0, seed).map_err(|found| without_place(py, found))?;
        Ok(Self::of(search, work))
    }

    fn check(&self, candidates: &Candidates, search: &nbc::Search) -> PyResult<()> {
        let (found, expected) = (candidates.generation, search.generation());
        if candidates.search != self.number {
            return Err(bad_value("the candidates are of another search"));
        }
        if found != expected {
            return Err(bad_value(format!("the candidates are of generation {found}, expected {expected}: ask again")));
        }
        Ok(())
    }
}

#[pymethods]
impl Search {
    #[new]
    fn new(py: Python<'_>, evolution: &Evolution, seed: u64) -> PyResult<Self> {
        at_once(py, || Ok(Self::of(nbc::Search::new(&evolution.0, seed), Work::default())))
    }

    /// The search of a checkpoint.
    #[staticmethod]
    fn resume(py: Python<'_>, path: PathBuf, evolution: &Evolution) -> PyResult<Self> {
        at_once(py, || {
            let read = Checkpoint::open(&path).map_err(|found| without_place(py, found))?;
            let checkpoint = read.ok_or_else(|| no_checkpoint(py, &path))?;
            Self::continued(py, checkpoint, &path.display().to_string(), evolution)
        })
    }

    /// Writes a checkpoint.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.course.with(py, |Course { search, work }| {
            let saved = Checkpoint::save(&path, search, work.env_steps, work.left_out);
            saved.map_err(|found| without_place(py, found))
        })
    }

    /// The bytes of a checkpoint.
    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.course.with(py, |Course { search, work }| {
            Ok(PyBytes::new(py, &Checkpoint::print(search, work.env_steps, work.left_out)))
        })
    }

    /// The search of a checkpoint's bytes.
    #[staticmethod]
    fn from_bytes(py: Python<'_>, bytes: &[u8], evolution: &Evolution) -> PyResult<Self> {
        const NAME: &str = "the copy of a search";
        at_once(py, || {
            let checkpoint = Checkpoint::read(NAME, bytes).map_err(|found| without_place(py, found))?;
            Self::continued(py, checkpoint, NAME, evolution)
        })
    }

    /// The patterns of the stimuli of its bodies: 4 or 8.
    #[getter]
    fn patterns(&self) -> usize {
        evaluation::patterns(&self.evolution)
    }

    /// The candidates of the next generation.
    fn ask(&self, py: Python<'_>) -> PyResult<Candidates> {
        let watch = Watch::over(0);
        let asked = self.course.run(py, &watch, None, |course, _| (course.search.ask(), course.search.generation()))?;
        let (list, generation) = asked.finished()?;
        Ok(Candidates { list: Arc::new(list), generation, search: self.number })
    }

    /// Evaluates candidates for the archive as it is.
    fn evaluate<'py>(&self, py: Python<'py>, candidates: &Candidates) -> PyResult<Bound<'py, PyDict>> {
        self.course.with(py, |course| self.check(candidates, &course.search))?;
        let (watch, list) = (Watch::over(0), candidates.list.clone());
        let evaluated = self.course.run(py, &watch, None, move |course, watch| {
            let (outcomes, work) = nbc::evaluate(&watch.simulator(), &course.search, &list);
            if !watch.is_stopped() {
                course.work = course.work.plus(work);
            }
            outcomes
        })?;
        let mut rows = evaluation::Rows::new(&self.evolution);
        for (candidate, outcome) in candidates.list.iter().zip(&evaluated.finished()?) {
            rows.push(&candidate.body, outcome);
        }
        rows.into_python(py)
    }

    /// Takes the outcomes of candidates.
    fn tell(
        &self,
        py: Python<'_>,
        candidates: &Candidates,
        words: Vec<String>,
        fitness: PyReadonlyArray2<'_, f64>,
        displacement: PyReadonlyArray2<'_, f64>,
        behavior: Vec<String>,
    ) -> PyResult<()> {
        let outcomes: Vec<CandidateOutcome> =
            evaluation::outcomes(&self.evolution, &words, &fitness, &displacement, &behavior)?;
        if outcomes.len() != candidates.list.len() {
            let (found, expected) = (outcomes.len(), candidates.list.len());
            return Err(bad_value(format!("{found} outcomes, expected {expected}: one for each candidate")));
        }
        self.course.with(py, |course| {
            self.check(candidates, &course.search)?;
            course.search.tell(&candidates.list, &outcomes);
            Ok(())
        })
    }

    /// Makes a generation; one that is interrupted has not happened.
    fn step(&self, py: Python<'_>) -> PyResult<()> {
        let made = self.course.run(py, &Watch::over(0), None, |course, watch| {
            let candidates = course.search.ask();
            let (outcomes, work) = nbc::evaluate(&watch.simulator(), &course.search, &candidates);
            if !watch.is_stopped() {
                course.search.tell(&candidates, &outcomes);
                course.work = course.work.plus(work);
            }
        })?;
        made.finished()
    }

    /// Seed, generation, counts, and the archive at one glance, as JSON.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        self.course.with(py, |Course { search, work }| {
            let summary = serde_json::json!({
                "seed": search.seed(),
                "generation": search.generation(),
                "generations": search.evolution().generations,
                "is_done": search.is_done(),
                "counts": search.counts(),
                "archive": search.archive().stats(),
                "env_steps": work.env_steps,
                "left_out": work.left_out,
            });
            Ok(summary.to_string())
        })
    }

    /// The archive.
    fn archive<'py>(&self, py: Python<'py>) -> PyResult<ArchiveOnAxes<'py>> {
        self.course.with(py, |course| {
            let niches = course.search.archive().niches();
            let elites = niches.flat_map(|(key, elites)| elites.iter().map(move |elite| (key, elite)));
            let nbc::Evolution { descriptors, palette, .. } = &self.evolution;
            let arrays = archive(py, elites, descriptors.len(), palette)?;
            Ok((arrays, axes(descriptors, palette), materials(palette)))
        })
    }

    /// Ends the search.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.course.close(py)
    }
}

/// The arrays of an archive, the word and bins of each axis, and the materials of the codes as JSON.
type ArchiveOnAxes<'py> = (Bound<'py, PyDict>, Vec<(&'static str, usize)>, String);

/// Materials as JSON.
fn materials(palette: &Palette) -> String {
    serde_json::to_string(palette).expect("materials can be written as JSON")
}

/// The archive of a checkpoint: its arrays and its axes.
#[pyfunction]
pub fn read_checkpoint(py: Python<'_>, path: PathBuf) -> PyResult<ArchiveOnAxes<'_>> {
    at_once(py, || {
        let read = Checkpoint::open(&path).map_err(|found| without_place(py, found))?;
        let checkpoint = read.ok_or_else(|| no_checkpoint(py, &path))?;
        let niches = checkpoint.state.niches.iter();
        let elites = niches.flat_map(|(key, elites)| elites.iter().map(move |elite| (key, elite)));
        let palette = &checkpoint.declared.palette;
        let axes = axes(&checkpoint.declared.axes, palette);
        let depth = checkpoint.state.niches.first().map_or(axes.len(), |(key, _)| key.0.len());
        Ok((archive(py, elites, depth, palette)?, axes, materials(palette)))
    })
}

/// Elites as arrays, a row for each.
fn archive<'py, 'a>(
    py: Python<'py>,
    elites: impl Iterator<Item = (&'a NicheKey, &'a Elite)>,
    axes: usize,
    palette: &Palette,
) -> PyResult<Bound<'py, PyDict>> {
    let elites: Vec<(&NicheKey, &Elite)> = elites.collect();
    let (count, arrays) = (elites.len(), PyDict::new(py));
    let (width, height) = elites.first().map_or((0, 0), |(_, elite)| (elite.body.width(), elite.body.height()));
    let niches: Vec<u16> = elites.iter().flat_map(|(key, _)| key.0.clone()).collect();
    arrays.set_item("niche", niches.into_pyarray(py).reshape([count, axes])?)?;
    let fitness: Vec<f64> = elites.iter().flat_map(|(_, elite)| elite.fitness).collect();
    arrays.set_item("fitness", fitness.into_pyarray(py).reshape([count, 2])?)?;
    let displacement: Vec<f64> = elites.iter().flat_map(|(_, elite)| elite.displacement.to_vec()).collect();
    arrays.set_item("displacement", displacement.into_pyarray(py).reshape([count, 1 << palette.inputs()])?)?;
    let codes: Vec<u8> = elites.iter().flat_map(|(_, elite)| elite.body.codes().to_vec()).collect();
    arrays.set_item("body", codes.into_pyarray(py).reshape([count, height, width])?)?;
    arrays.set_item("behavior", elites.iter().map(|(_, elite)| elite.behavior.to_string()).collect::<Vec<_>>())?;
    arrays
        .set_item("function", elites.iter().map(|(_, elite)| elite.behavior.function().name()).collect::<Vec<_>>())?;
    arrays.set_item("generation", column(py, elites.iter().map(|(_, elite)| u64::from(elite.generation))))?;
    arrays.set_item("evaluations", column(py, elites.iter().map(|(_, elite)| elite.evaluations)))?;
    Ok(arrays)
}

fn column<'py>(py: Python<'py>, numbers: impl Iterator<Item = u64>) -> Bound<'py, PyArray1<u64>> {
    numbers.collect::<Vec<_>>().into_pyarray(py)
}
