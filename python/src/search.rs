//! Searches: ask, evaluate, tell; archives and checkpoints.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use nbc::{Answer, Behavior, Candidate, CandidateOutcome, Checkpoint, Elite, EvolutionRun, Executor, LocalExecutor};
use nbc::{NicheKey, Palette, Robot, RobotRequest, Selected, Selection};
use numpy::{IntoPyArray, PyArray1, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use rayon::prelude::*;
use serde_json::json;

use crate::bodies::robot_record;
use crate::errors::{bad_value, without_place};
use crate::evaluation;
use crate::evolution::{Evolution, axes, no_checkpoint};
use crate::slot::Slot;
use crate::work::{self, Watch, at_once};

/// The number of the next search, so that its candidates are known as its own.
static NEXT: AtomicU64 = AtomicU64::new(0);

#[pyclass(frozen)]
pub struct Search {
    run: Slot<EvolutionRun>,
    evolution: nbc::Evolution,
    number: u64,
}

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Choosing {
    tries: usize,
    finalists: usize,
    max_error: f64,
    wide_margin: f64,
}

fn read_behavior(word: &str) -> PyResult<Behavior> {
    nbc::behavior(word).map_err(|expected| bad_value(format!("invalid behavior `{word}`; {expected}")))
}

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

    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (width, height) = self.list.first().map_or((0, 0), |one| (one.body.width(), one.body.height()));
        let codes: Vec<u8> = self.list.iter().flat_map(|one| one.body.codes().to_vec()).collect();
        codes.into_pyarray(py).reshape([self.list.len(), height, width])
    }

    #[getter]
    fn generation(&self) -> u32 {
        self.generation
    }
}

impl Search {
    fn of(run: EvolutionRun) -> Self {
        let evolution = run.search().evolution().clone();
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        Self { run: Slot::new("search", run), evolution, number }
    }

    /// The search of the checkpoint that is called `name`.
    fn continued(py: Python<'_>, checkpoint: Checkpoint, name: &str, evolution: &Evolution) -> PyResult<Self> {
        let seed = checkpoint.state.seed;
        let run = EvolutionRun::resume(checkpoint, name, &evolution.0, seed);
        Ok(Self::of(run.map_err(|found| without_place(py, found))?))
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
        at_once(py, || Ok(Self::of(EvolutionRun::new(&evolution.0, seed))))
    }

    #[staticmethod]
    fn resume(py: Python<'_>, path: PathBuf, evolution: &Evolution) -> PyResult<Self> {
        at_once(py, || {
            let read = Checkpoint::open(&path).map_err(|found| without_place(py, found))?;
            let checkpoint = read.ok_or_else(|| no_checkpoint(py, &path))?;
            Self::continued(py, checkpoint, &path.display().to_string(), evolution)
        })
    }

    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.run.with(py, |run| nbc::write_file(&path, &run.checkpoint()).map_err(|found| without_place(py, found)))
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.run.with(py, |run| Ok(PyBytes::new(py, &run.checkpoint())))
    }

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

    fn ask(&self, py: Python<'_>) -> PyResult<Candidates> {
        let watch = Watch::over(0);
        let asked = self.run.run(py, &watch, None, |run, _| (run.search().ask(), run.search().generation()))?;
        let (list, generation) = asked.finished()?;
        Ok(Candidates { list: Arc::new(list), generation, search: self.number })
    }

    /// Evaluates candidates for the archive as it is.
    fn evaluate<'py>(&self, py: Python<'py>, candidates: &Candidates) -> PyResult<Bound<'py, PyDict>> {
        self.run.with(py, |run| self.check(candidates, run.search()))?;
        let (watch, list) = (Watch::over(0), candidates.list.clone());
        let evaluated = self.run.run(py, &watch, None, move |run, watch| {
            let (outcomes, work) = nbc::evaluate(&watch.simulator(), run.search(), &list);
            if !watch.is_stopped() {
                run.add_work(work);
            }
            outcomes
        })?;
        let mut rows = evaluation::Rows::new(&self.evolution);
        for (candidate, outcome) in candidates.list.iter().zip(&evaluated.finished()?) {
            rows.push(&candidate.body, outcome);
        }
        rows.into_python(py)
    }

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
        self.run.with(py, |run| {
            self.check(candidates, run.search())?;
            run.tell_outcomes(&candidates.list, &outcomes);
            Ok(())
        })
    }

    /// Makes a generation; one that is interrupted has not happened.
    fn step(&self, py: Python<'_>) -> PyResult<()> {
        let made = self.run.run(py, &Watch::over(0), None, |run, watch| {
            let candidates = run.search().ask();
            let executor = LocalExecutor::new(watch.simulator());
            let results = executor.perform(0, &run.tasks(&candidates), &|| ());
            if let Some(results) = results.filter(|_| !watch.is_stopped()) {
                run.tell(&candidates, results);
            }
        })?;
        made.finished()
    }

    /// Seed, generation, counts, and the archive at one glance, as JSON.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        self.run.with(py, |run| {
            let (search, work) = (run.search(), run.work());
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

    fn archive<'py>(&self, py: Python<'py>) -> PyResult<ArchiveOnAxes<'py>> {
        self.run.with(py, |run| {
            let niches = run.search().archive().niches();
            let elites = niches.flat_map(|(key, elites)| elites.iter().map(move |elite| (key, elite)));
            let nbc::Evolution { descriptors, palette, .. } = &self.evolution;
            let arrays = archive(py, elites, descriptors.len(), palette)?;
            Ok((arrays, axes(descriptors, palette), materials(palette)))
        })
    }

    /// The best robots of these behaviors in the archive, measured, of all behaviors if none is named, and for each
    /// behavior without one the reason, as JSON.
    fn robots(
        &self,
        py: Python<'_>,
        behaviors: Vec<String>,
        choosing: Choosing,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let behaviors: Vec<Behavior> = behaviors.iter().map(|word| read_behavior(word)).collect::<PyResult<_>>()?;
        let Choosing { tries, finalists, max_error, wide_margin } = choosing;
        let selection = Selection { tries, finalists, max_error, wide_margin };
        let name = "the search";
        let checkpoint = self
            .run
            .with(py, |run| Checkpoint::read(name, &run.checkpoint()).map_err(|found| without_place(py, found)))?;
        let requests = RobotRequest::of_runs([&checkpoint], &behaviors, &selection);
        let watch = Watch::over_parts(requests.iter().map(|request| request.cost(&selection)).sum());
        let found = work::run(py, &watch, progress.as_ref(), move |watch| {
            let executor = LocalExecutor::new(watch.simulator());
            let select = |(place, request): (usize, &RobotRequest)| {
                if watch.is_stopped() {
                    return None;
                }
                let selected = request.select(&selection, &executor, place, &|more| watch.add(more))?;
                let behavior = request.behavior(&selected).expect("a behavior is asked for");
                Some(match selected {
                    Selected::Robot(robot) => Ok(robot),
                    none => Err(Answer::of(behavior, &none, max_error).to_string()),
                })
            };
            requests.par_iter().enumerate().map(select).collect::<Vec<Option<Result<Box<Robot>, String>>>>()
        })?;
        let (mut robots, mut reasons) = (Vec::new(), Vec::new());
        for selected in found.finished()?.into_iter().flatten() {
            match selected {
                Ok(robot) => robots.push(robot_record(&robot)),
                Err(reason) => reasons.push(reason),
            }
        }
        Ok(json!({ "robots": robots, "reasons": reasons }).to_string())
    }

    fn close(&self, py: Python<'_>) -> PyResult<()> {
        self.run.close(py)
    }
}

/// The arrays of an archive, the word and bins of each axis, and the materials of the codes as JSON.
type ArchiveOnAxes<'py> = (Bound<'py, PyDict>, Vec<(&'static str, usize)>, String);

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
        let axes = axes(&checkpoint.declared.descriptors, palette);
        let depth = checkpoint.state.niches.first().map_or(axes.len(), |(key, _)| key.0.len());
        Ok((archive(py, elites, depth, palette)?, axes, materials(palette)))
    })
}

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
