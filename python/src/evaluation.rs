//! Evaluation of bodies by the protocol of an evolution.

use nbc::{Behavior, Body, CandidateOutcome, Descriptor, Displacements, FaultKind, Scores, Simulator};
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::bodies::Batch;
use crate::errors::bad_value;
use crate::evolution::Evolution;
use crate::memory;
use crate::physics::{Ending, STOPPED, check_place, set_endings};
use crate::work::{self, Watch, at_once};

/// Bodies that are evaluated in one go, so that an interrupt keeps the results of those before.
const GROUP: usize = 256;

fn word(outcome: &CandidateOutcome) -> &'static str {
    match outcome {
        CandidateOutcome::Measured(_) => "measured",
        CandidateOutcome::Surpassed => "surpassed",
        CandidateOutcome::Inconsistent => "inconsistent",
        CandidateOutcome::Faulty(fault) if fault.kind == FaultKind::Stopped => "stopped",
        CandidateOutcome::Faulty(_) => "faulty",
    }
}

/// The patterns of the stimuli of an evolution's bodies: 4 or 8.
pub fn patterns(evolution: &nbc::Evolution) -> usize {
    1 << evolution.palette.inputs()
}

/// Outcomes, row after row, with the niches of the measured bodies.
pub struct Rows {
    descriptor: Descriptor,
    axes: usize,
    patterns: usize,
    words: Vec<&'static str>,
    fitness: Vec<f64>,
    displacement: Vec<f64>,
    behavior: Vec<String>,
    niche: Vec<i32>,
    endings: Vec<Ending>,
    errors: Vec<(usize, String)>,
}

impl Rows {
    pub fn new(evolution: &nbc::Evolution) -> Self {
        Self {
            descriptor: Descriptor::new(evolution),
            axes: evolution.descriptors.len(),
            patterns: patterns(evolution),
            words: vec![],
            fitness: vec![],
            displacement: vec![],
            behavior: vec![],
            niche: vec![],
            endings: vec![],
            errors: vec![],
        }
    }

    pub fn push(&mut self, body: &Body, outcome: &CandidateOutcome) {
        self.words.push(word(outcome));
        match outcome {
            CandidateOutcome::Measured(scores) => {
                self.fitness.extend(scores.fitness);
                self.displacement.extend(scores.displacement.iter());
                self.behavior.push(scores.behavior.to_string());
                self.niche.extend(self.descriptor.niche(body, scores.behavior).0.into_iter().map(i32::from));
                self.endings.push(Ending::Done);
            }
            CandidateOutcome::Faulty(fault) => self.push_nothing(Ending::Fault(*fault)),
            CandidateOutcome::Surpassed | CandidateOutcome::Inconsistent => self.push_nothing(Ending::Done),
        }
    }

    fn push_invalid(&mut self, reason: String) {
        self.errors.push((self.words.len(), reason));
        self.words.push("invalid");
        self.push_nothing(Ending::Invalid);
    }

    fn push_nothing(&mut self, ending: Ending) {
        self.fitness.extend([f64::NAN; 2]);
        self.displacement.extend(std::iter::repeat_n(f64::NAN, self.patterns));
        self.behavior.push(String::new());
        self.niche.extend(std::iter::repeat_n(-1, self.axes));
        self.endings.push(ending);
    }

    pub fn into_python(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let (count, results) = (self.words.len(), PyDict::new(py));
        results.set_item("outcome", self.words)?;
        results.set_item("fitness", self.fitness.into_pyarray(py).reshape([count, 2])?)?;
        results.set_item("displacement", self.displacement.into_pyarray(py).reshape([count, self.patterns])?)?;
        results.set_item("behavior", self.behavior)?;
        results.set_item("niche", self.niche.into_pyarray(py).reshape([count, self.axes])?)?;
        results.set_item("errors", self.errors)?;
        set_endings(&results, &self.endings)?;
        Ok(results)
    }
}

/// Reads outcomes that Python computed for an evolution.
pub fn outcomes(
    evolution: &nbc::Evolution,
    words: &[String],
    fitness: &PyReadonlyArray2<'_, f64>,
    displacement: &PyReadonlyArray2<'_, f64>,
    behavior: &[String],
) -> PyResult<Vec<CandidateOutcome>> {
    let (fitness, displacement) = (fitness.as_array(), displacement.as_array());
    let outcome = |(i, word): (usize, &String)| match word.as_str() {
        "surpassed" => Ok(CandidateOutcome::Surpassed),
        "inconsistent" => Ok(CandidateOutcome::Inconsistent),
        "faulty" => Ok(CandidateOutcome::Faulty(nbc::Fault { env_step: 1, kind: FaultKind::NonFinite })),
        "measured" => {
            let (fitness, displacement) = (fitness.row(i), displacement.row(i));
            if !fitness.iter().chain(displacement).all(|number| number.is_finite()) {
                return Err(bad_value(format!("row {i}: the scores of a measured body must be finite numbers")));
            }
            let wrong = |error: String| bad_value(format!("row {i}: {error}"));
            let behavior = behavior[i].parse::<Behavior>().map_err(|error| wrong(error.to_string()))?;
            let displacement =
                Displacements::try_from(displacement.to_vec()).map_err(|error| wrong(error.to_string()))?;
            let expected = patterns(evolution);
            if displacement.len() != expected || behavior.patterns().count() != expected {
                return Err(wrong(format!("expected a letter and a displacement for each of {expected} patterns")));
            }
            let fitness = [0, 1].map(|column| fitness[column]);
            Ok(CandidateOutcome::Measured(Scores { fitness, behavior, displacement }))
        }
        word => Err(bad_value(format!(
            "row {i}: invalid outcome `{word}`; expected measured, surpassed, inconsistent or faulty"
        ))),
    };
    words.iter().enumerate().map(outcome).collect()
}

struct Examination {
    batch: Batch,
    evolution: nbc::Evolution,
}

impl Examination {
    /// A body of the evolution's box that can stand in its world.
    fn body(&self, i: usize) -> Result<Body, String> {
        let body = self.batch.body(i)?;
        let (found, expected) = ((body.height(), body.width()), (self.evolution.height, self.evolution.width));
        if found != expected {
            return Err(format!("the body has the shape {found:?}, expected {expected:?}, the shape of the evolution"));
        }
        check_place(&nbc::Setting::default(), &body).map(|()| body)
    }

    /// Evaluates the bodies, some at a time, until the end or an interrupt.
    fn evaluate(&self, watch: &Watch) -> Rows {
        let (simulator, mut rows) = (watch.simulator(), Rows::new(&self.evolution));
        for group in self.batch.groups(GROUP) {
            let bodies: Vec<Result<Body, String>> = group.map(|i| self.body(i)).collect();
            let valid: Vec<Body> = bodies.iter().flatten().cloned().collect();
            let mut outcomes = self.outcomes(&simulator, watch, valid).into_iter();
            for body in bodies {
                match body {
                    Err(reason) => rows.push_invalid(reason),
                    Ok(body) => rows.push(&body, &outcomes.next().expect("each valid body is evaluated")),
                }
            }
        }
        rows
    }

    fn outcomes(&self, simulator: &Simulator, watch: &Watch, bodies: Vec<Body>) -> Vec<CandidateOutcome> {
        match watch.is_stopped() {
            true => vec![CandidateOutcome::Faulty(STOPPED); bodies.len()],
            false => nbc::evaluate_bodies(simulator, &self.evolution, bodies),
        }
    }
}

/// Evaluates bodies as an evolution does, for an empty archive.
#[pyfunction]
pub fn evaluate<'py>(
    py: Python<'py>,
    codes: PyReadonlyArray1<'py, u8>,
    shapes: PyReadonlyArray2<'py, u64>,
    evolution: &Evolution,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let evolution = evolution.0.clone();
    let examination = at_once(py, || {
        let batch = Batch::read(&codes, &shapes, &evolution.palette)?;
        // Each body is simulated under all patterns at once.
        let patterns = patterns(&evolution) as u64;
        let largest = batch.groups(GROUP).into_iter().map(|group| patterns * batch.bytes(group)).max().unwrap_or(0);
        memory::check(largest, "the evaluation", "evaluate fewer bodies at once")?;
        Ok(Examination { batch, evolution })
    })?;
    let ended = work::run(py, &Watch::over(0), progress.as_ref(), move |watch| examination.evaluate(watch))?;
    ended.or_partial(py, |rows| rows.into_python(py))
}
