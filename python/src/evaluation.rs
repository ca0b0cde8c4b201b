//! Evaluation of bodies by the protocol of an evolution.

use nbc::{CandidateOutcome, Descriptor, FaultKind, Scores};
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::bodies::bodies;
use crate::errors::bad_value;
use crate::evolution::Evolution;
use crate::physics::{STOPPED, set_faults, setting};
use crate::work::{self, Watch, at_once};

/// Bodies that are evaluated in one go, so that an interrupt keeps the results of those before.
const GROUP: usize = 256;

/// The word for an outcome.
fn word(outcome: &CandidateOutcome) -> &'static str {
    match outcome {
        CandidateOutcome::Measured(_) => "measured",
        CandidateOutcome::Surpassed => "surpassed",
        CandidateOutcome::Inconsistent => "inconsistent",
        CandidateOutcome::Faulty(fault) if fault.kind == FaultKind::Stopped => "stopped",
        CandidateOutcome::Faulty(_) => "faulty",
    }
}

/// Outcomes as arrays, with the niches of the measured bodies.
pub fn into_python<'py>(
    py: Python<'py>,
    evolution: &nbc::Evolution,
    bodies: &[nbc::Body],
    outcomes: &[CandidateOutcome],
) -> PyResult<Bound<'py, PyDict>> {
    let descriptor = Descriptor::new(evolution);
    let (count, axes) = (outcomes.len(), evolution.descriptors.len());
    let (mut fitness, mut displacement, mut niche, mut behavior) = (vec![], vec![], vec![], vec![]);
    for (body, outcome) in bodies.iter().zip(outcomes) {
        match outcome {
            CandidateOutcome::Measured(scores) => {
                fitness.extend(scores.fitness);
                displacement.extend(scores.displacement);
                behavior.push(scores.behavior.to_string());
                niche.extend(descriptor.niche(body, scores.behavior).0.into_iter().map(i32::from));
            }
            _ => {
                fitness.extend([f64::NAN; 2]);
                displacement.extend([f64::NAN; 4]);
                behavior.push(String::new());
                niche.extend(std::iter::repeat_n(-1, axes));
            }
        }
    }
    let results = PyDict::new(py);
    results.set_item("outcome", outcomes.iter().map(word).collect::<Vec<_>>())?;
    results.set_item("fitness", fitness.into_pyarray(py).reshape([count, 2])?)?;
    results.set_item("displacement", displacement.into_pyarray(py).reshape([count, 4])?)?;
    results.set_item("behavior", behavior)?;
    results.set_item("niche", niche.into_pyarray(py).reshape([count, axes])?)?;
    let fault = |outcome: &CandidateOutcome| match outcome {
        CandidateOutcome::Faulty(fault) => Some(*fault),
        _ => None,
    };
    set_faults(&results, outcomes.iter().map(fault))?;
    Ok(results)
}

/// Reads outcomes that Python computed.
pub fn outcomes(
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
            let behavior = behavior[i].parse().map_err(|error| bad_value(format!("row {i}: {error}")))?;
            let displacement = [0, 1, 2, 3].map(|column| displacement[column]);
            let fitness = [0, 1].map(|column| fitness[column]);
            Ok(CandidateOutcome::Measured(Scores { fitness, behavior, displacement }))
        }
        word => Err(bad_value(format!(
            "row {i}: invalid outcome `{word}`; expected measured, surpassed, inconsistent or faulty"
        ))),
    };
    words.iter().enumerate().map(outcome).collect()
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
    let bodies = at_once(py, || bodies(&codes, &shapes, &evolution.palette))?;
    let (width, height) = (evolution.width, evolution.height);
    if let Some(i) = bodies.iter().position(|body| (body.width(), body.height()) != (width, height)) {
        return Err(bad_value(format!("bodies[{i}] must be {height} rows of {width} codes, the box of the evolution")));
    }
    setting(nbc::Setting::default().world_width, None, &bodies)?;
    let watch = Watch::over(0);
    let (kept, declared) = (bodies.clone(), evolution.clone());
    let ended = work::run(py, &watch, progress.as_ref(), move |watch| {
        let simulator = watch.simulator();
        let evaluated = bodies.chunks(GROUP).map(|group| match watch.is_stopped() {
            true => vec![CandidateOutcome::Faulty(STOPPED); group.len()],
            false => nbc::evaluate_bodies(&simulator, &evolution, group.to_vec()),
        });
        evaluated.flatten().collect::<Vec<_>>()
    })?;
    ended.or_partial(py, |outcomes| into_python(py, &declared, &kept, &outcomes))
}
