//! Tests in samples of worlds, and hardening.

use nbc::{Checked, Diagnostics, Robustness, Session, TestCase, TestOptions, Variation, WorldResult, Yields};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::errors::bad_value;
use crate::work::Watch;

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Sampling {
    vary: Vec<String>,
    times: Vec<f64>,
    pub worlds: usize,
    pub seed: u64,
}

impl Sampling {
    /// How much the worlds vary; each is a sample of its own.
    pub fn vary(&self) -> PyResult<Vec<Variation>> {
        self.vary.iter().map(|text| text.parse().map_err(|error: String| bad_value(error))).collect()
    }
}

/// The yields of these tests of a program. After an interrupt, those that are complete.
pub fn yields(
    session: &Session,
    checked: &Checked,
    tests: &[usize],
    options: &TestOptions,
    sampling: &Sampling,
    vary: &[Variation],
    watch: &Watch,
) -> Result<Vec<Robustness>, Diagnostics> {
    let mut cases: Vec<TestCase> = Vec::new();
    for &test in tests {
        cases.extend(checked.cases(&checked.program.tests[test], options)?);
    }
    let Sampling { times, worlds, seed, .. } = sampling;
    Ok(runs(session, &Yields::of(&cases, vary, times, *worlds, *seed), watch))
}

/// Makes the runs on the threads of the package. After an interrupt, only results that are complete are there.
pub fn runs(session: &Session, yields: &Yields<'_>, watch: &Watch) -> Vec<Robustness> {
    watch.expect(yields.work());
    let run = |run| if watch.is_stopped() { None } else { session.run_in_world(yields, run, &mut watch.part()) };
    let results: Vec<Option<WorldResult>> = yields.runs().into_par_iter().map(run).collect();
    let mut tally = yields.tally();
    results.into_iter().map_while(|result| result).filter_map(|result| tally.tell(result)).collect()
}
