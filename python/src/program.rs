//! Checked source files: circuits, tests, evolutions.

use std::path::Path;
use std::sync::Arc;

use nbc::{
    Checked, Choice, CompileOptions, DecidedClaim, Diagnostics, DiskWorld, Effort, GuardedWorld, Hardened, Hardening,
    ImageSize,
};
use nbc::{Level, MappingObjective, Room, RunReport, SearchBudget, Session, TestOptions, TestRun, TestVerdict, Yields};
use numpy::{IntoPyArray, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use serde::Serialize;

use crate::circuits::Compiled;
use crate::described::{Described, json};
use crate::errors::{bad_word, diagnosed, internal, without_place};
use crate::evolution::Evolution;
use crate::work::{self, Watch, at_once};
use crate::worlds::{self, Sampling};

#[pyclass(frozen)]
pub struct Program {
    session: Arc<Session>,
    checked: Arc<Checked>,
}

#[derive(Serialize)]
struct DecidedTexts {
    data: DecidedClaim,
    texts: Vec<String>,
}

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Compiling {
    library: Option<String>,
    swarm: Option<String>,
    objective: String,
    effort: String,
    runs: String,
}

impl Compiling {
    fn options(&self, py: Python<'_>, session: &Session, watch: &Watch) -> PyResult<CompileOptions> {
        let robots = match self.library.as_deref() {
            None => None,
            Some(folder) => Some(session.library(folder).map_err(|found| diagnosed(py, &found))?),
        };
        let (objective, effort) = (read_objective(&self.objective)?, read_effort(&self.effort)?);
        let cancel = watch.cancel.clone();
        let (swarm, runs) = (self.swarm.clone(), self.runs.clone());
        Ok(CompileOptions { swarm, robots, objective, effort, runs, cancel, ..CompileOptions::default() })
    }
}

#[pymethods]
impl Program {
    /// Reads and checks a file of the disk, or `text` in its place.
    #[new]
    fn new(py: Python<'_>, path: &str, text: Option<String>, poses: bool) -> PyResult<Self> {
        let watch = Watch::over(0);
        let mut session = Session::new(GuardedWorld::until(DiskWorld, watch.cancel.clone()));
        if poses {
            session = session.with_poses(Room::SWARM);
        }
        if let Some(text) = text {
            session.update(path, 1, text);
        }
        let opened = work::run(py, &watch, None, {
            let path = path.to_owned();
            move |_| {
                let opened = session.open(&path);
                (session, opened)
            }
        })?;
        let (session, opened) = opened.finished()?;
        let checked = opened.map_err(|found| diagnosed(py, &found))?;
        Ok(Self { session: Arc::new(session), checked })
    }

    fn diagnostics(&self, py: Python<'_>) -> PyResult<String> {
        at_once(py, || json(py, &self.checked.findings()))
    }

    /// The circuits of the file itself.
    fn circuits(&self) -> Vec<String> {
        let own = self.checked.program.circuits.iter().filter(|circuit| Some(circuit.span.file) == self.checked.file);
        own.map(|circuit| circuit.name.clone()).collect()
    }

    fn tests(&self, py: Python<'_>) -> PyResult<String> {
        json(py, &self.checked.program.tests)
    }

    fn claims(&self, py: Python<'_>) -> PyResult<String> {
        json(py, &self.checked.program.claims)
    }

    fn evolutions(&self, py: Python<'_>) -> PyResult<Vec<(String, Evolution)>> {
        let started = |evolution: &nbc::Evolution| {
            let started = self.checked.started(evolution, &CompileOptions::default().runs);
            Ok((evolution.name.clone(), Evolution(started.map_err(|found| diagnosed(py, &found))?)))
        };
        self.checked.program.evolutions.iter().map(started).collect()
    }

    /// Its sets of images by name: arrays of images, rows and columns.
    fn images<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyArray3<f64>>)>> {
        let sets = self.checked.program.images.iter().map(|set| {
            let ImageSize { rows, columns } = set.images.first().expect("a set has images").size();
            let pixels: Vec<f64> = set.images.iter().flat_map(|image| image.pixels().iter().copied()).collect();
            Ok((set.name.clone(), pixels.into_pyarray(py).reshape([set.images.len(), rows, columns])?))
        });
        sets.collect()
    }

    fn compile(&self, py: Python<'_>, circuit: Option<String>, compiling: Compiling) -> PyResult<Compiled> {
        let watch = Watch::over(0);
        let options = compiling.options(py, &self.session, &watch)?;
        let choice = Choice { circuit, swarm: options.swarm.clone() };
        let instance = self.checked.circuit(&choice).map_err(|found| diagnosed(py, &found))?;
        let checked = self.checked.clone();
        let compiled = work::run(py, &watch, None, move |_| checked.compile(&instance, &options))?;
        let compiled = compiled.finished()?.map_err(|found| diagnosed(py, &found))?;
        Ok(Compiled::new(self.session.clone(), self.checked.clone(), compiled))
    }

    /// Runs a test: its results as JSON, each with its text.
    fn test(
        &self,
        py: Python<'_>,
        test: usize,
        level: Option<&str>,
        compiling: Compiling,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let watch = Watch::over(0);
        let compile = compiling.options(py, &self.session, &watch)?;
        let options = TestOptions { level: level.map(read_level).transpose()?, compile };
        let (session, checked) = (self.session.clone(), self.checked.clone());
        let ran = work::run(py, &watch, progress.as_ref(), move |watch| {
            session.test(&checked, &checked.program.tests[test], &options, &mut watch.observer())
        })?;
        let runs = ran.finished()?.map_err(|found| diagnosed(py, &found))?;
        at_once(py, || json(py, &self.described(&runs)))
    }

    /// Decides a claim: the report as JSON, and the text of each property. In physics, the tests that refute properties
    /// are run with robots, too.
    fn prove(
        &self,
        py: Python<'_>,
        claim: usize,
        limits: (usize, u64, f64),
        physics: bool,
        compiling: Compiling,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let (steps, work, seconds) = limits;
        let watch = Watch::until(seconds);
        let checked = self.checked.clone();
        let found = work::run(py, &watch, progress.as_ref(), move |watch| {
            let budget = SearchBudget { steps, work };
            let claim = &checked.program.claims[claim];
            let mut search = checked.prove(claim, budget, watch.cancel.clone())?;
            while search.advance(&mut watch.observer()) {}
            Ok(search.finish())
        })?;
        let mut decided = found.finished()?.map_err(|found: Diagnostics| diagnosed(py, &found))?;
        let tests: Vec<_> = decided.refuted().map(|(property, test)| (property, test.clone())).collect();
        for (property, test) in tests.into_iter().filter(|_| physics) {
            let watch = Watch::over(0);
            let compile = compiling.options(py, &self.session, &watch)?;
            let options = TestOptions { level: Some(Level::Physics), compile };
            let (session, checked) = (self.session.clone(), self.checked.clone());
            let ran = work::run(py, &watch, progress.as_ref(), move |watch| {
                session.test(&checked, &test, &options, &mut watch.observer())
            })?;
            decided.note_runs(property, &ran.finished()?.map_err(|found| diagnosed(py, &found))?);
        }
        let texts = decided.properties.iter().map(nbc::DecidedProperty::text).collect();
        json(py, &DecidedTexts { data: decided, texts })
    }

    /// Runs tests in samples of worlds: their yields as JSON, each with its text.
    fn yields(
        &self,
        py: Python<'_>,
        tests: Vec<usize>,
        sampling: Sampling,
        compiling: Compiling,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let (watch, vary) = (Watch::over(0), sampling.vary()?);
        let compile = compiling.options(py, &self.session, &watch)?;
        let options = TestOptions { level: Some(Level::Physics), compile };
        let (session, checked) = (self.session.clone(), self.checked.clone());
        let ran = work::run(py, &watch, progress.as_ref(), move |watch| {
            worlds::yields(&session, &checked, &tests, &options, &sampling, &vary, watch)
        })?;
        ran.or_partial(py, |found| {
            let found = found.map_err(|found| diagnosed(py, &found))?;
            let described = |one| Described::new(one, nbc::describe_robustness(one));
            json(py, &found.iter().map(described).collect::<Vec<_>>())
        })
    }

    /// Finds the robots to leave out of a circuit's swarm: the choice as JSON, with its text.
    fn harden(
        &self,
        py: Python<'_>,
        circuit: Option<String>,
        sampling: Sampling,
        least_yield: f64,
        compiling: Compiling,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let (watch, vary) = (Watch::over(0), sampling.vary()?);
        let options = compiling.options(py, &self.session, &watch)?;
        let choice = Choice { circuit, swarm: options.swarm.clone() };
        let circuit = self.checked.circuit(&choice).map_err(|found| diagnosed(py, &found))?;
        let hardening = Hardening { variation: vary[0], worlds: sampling.worlds, seed: sampling.seed, least_yield };
        let (session, checked) = (self.session.clone(), self.checked.clone());
        let ran = work::run(py, &watch, progress.as_ref(), move |watch| {
            let mut run = |yields: &Yields<'_>| Ok(worlds::runs(&session, yields, watch));
            session.harden(&checked, &circuit, &options, hardening, &mut run, &mut |_| ())
        })?;
        let found: Result<Option<Hardened>, Diagnostics> = ran.finished()?;
        let found = found.map_err(|found| diagnosed(py, &found))?;
        let hardened = found.ok_or_else(|| internal(py, &"the work was stopped"))?;
        json(py, &Described::new(&hardened, hardened.to_string()))
    }

    /// Runs every test and simulation in physics: the page, the results as JSON, and whether all passed.
    fn run(
        &self,
        py: Python<'_>,
        compiling: Compiling,
        safe_colors: bool,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<(String, String, bool)> {
        let watch = Watch::over(0);
        let options = compiling.options(py, &self.session, &watch)?;
        let (session, checked) = (self.session.clone(), self.checked.clone());
        let ran = work::run(py, &watch, progress.as_ref(), move |watch| {
            let list = nbc::RunList::all(&checked.program);
            let options = TestOptions { level: Some(Level::Physics), compile: options };
            let report = session.run_list(&checked, &list, &options, &mut watch.observer());
            report.map(|report| (report.page(&checked.path, crate::bodies::scheme(safe_colors)), report))
        })?;
        let records = |(page, report): (String, RunReport)| {
            let tests = at_once(py, || json(py, &self.described(&report.tests)))?;
            Ok((page, tests, report.passed()))
        };
        ran.or_partial(py, |ran| records(ran.map_err(|found| diagnosed(py, &found))?))
    }
}

impl Program {
    fn described<'r>(&self, runs: &'r [TestRun]) -> Vec<Described<&'r TestVerdict>> {
        let described = |run: &'r TestRun| {
            let warnings = Diagnostics { list: run.warnings.clone(), sources: self.checked.sources.clone() };
            Described::warned(&run.verdict, run.to_string(), &warnings)
        };
        runs.iter().map(described).collect()
    }
}

pub fn read_objective(word: &str) -> PyResult<MappingObjective> {
    use MappingObjective::{Area, Delay, Margin, Sturdy};
    read_word("objective", word, &[("area", Area), ("delay", Delay), ("margin", Margin), ("sturdy", Sturdy)])
}

pub fn read_effort(word: &str) -> PyResult<Effort> {
    read_word("effort", word, &[("fast", Effort::Fast), ("normal", Effort::Normal)])
}

fn read_level(word: &str) -> PyResult<Level> {
    read_word("level", word, &[Level::Logic, Level::Physics].map(|level| (level.word(), level)))
}

fn read_word<T: Copy>(what: &str, word: &str, known: &[(&str, T)]) -> PyResult<T> {
    let found = known.iter().find(|(name, _)| *name == word);
    let words: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
    found.map(|(_, value)| *value).ok_or_else(|| bad_word(what, word, &words))
}

#[pyfunction]
pub fn write_file(py: Python<'_>, path: &str, text: &str) -> PyResult<()> {
    at_once(py, || nbc::write_file(Path::new(path), text.as_bytes()).map_err(|found| without_place(py, found)))
}
