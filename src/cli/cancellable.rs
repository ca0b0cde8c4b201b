//! Tests and simulations that a request to stop ends. What was not completed then has no result.

use nbc_base::diag::Diagnostics;
use nbc_base::model::{CircuitTest, Simulation};
use nbc_circuit::CancelFlag;
use nbc_session::{Checked, CompileOptions, Observer, RunEnd, Session, SimulationRun, TestCase, TestOptions, TestRun};

/// An observer that hands on the progress, and stops the work when the flag is raised.
pub(super) struct Cancellable<F> {
    pub(super) cancel: CancelFlag,
    pub(super) progress: F,
}

impl<F: FnMut(u64, u64)> Observer for Cancellable<F> {
    fn progress(&mut self, done: u64, all: u64) {
        (self.progress)(done, all);
    }

    fn is_cancelled(&self) -> bool {
        self.cancel.is_raised()
    }
}

/// Follows one of several parts of some work.
struct PartObserver<'a> {
    whole: &'a mut dyn Observer,
    before: u64,
    all: u64,
}

impl Observer for PartObserver<'_> {
    fn progress(&mut self, done: u64, _: u64) {
        self.whole.progress(self.before + done, self.all);
    }

    fn is_cancelled(&self) -> bool {
        self.whole.is_cancelled()
    }
}

/// Runs a test, once for each swarm of its circuit, or only as the swarm that is chosen. Runs that were cancelled are
/// left out.
///
/// # Errors
/// As [`Session::cases`].
pub(super) fn complete_test(
    session: &Session,
    checked: &Checked,
    test: &CircuitTest,
    options: &TestOptions,
    observer: &mut dyn Observer,
) -> Result<Vec<TestRun>, Diagnostics> {
    if observer.is_cancelled() {
        return Ok(Vec::new());
    }
    let cases = session.cases(checked, test, options)?;
    let all = cases.iter().map(TestCase::work).sum();
    let (mut runs, mut before) = (Vec::new(), 0);
    for case in cases {
        // A circuit that was compiled meanwhile may have more robots than needed.
        if observer.is_cancelled() {
            break;
        }
        let work = case.work();
        runs.push(session.run_case(case, &mut PartObserver { whole: observer, before, all }));
        before += work;
    }
    runs.retain(|run| run.end == RunEnd::Complete);
    Ok(runs)
}

/// Runs a simulation; `None` if it was cancelled.
///
/// # Errors
/// As [`Session::simulate`].
pub(super) fn complete_simulation(
    session: &Session,
    checked: &Checked,
    simulation: &Simulation,
    options: &CompileOptions,
    observer: &mut dyn Observer,
) -> Result<Option<SimulationRun>, Diagnostics> {
    if observer.is_cancelled() {
        return Ok(None);
    }
    let run = session.simulate(checked, simulation, options, observer)?;
    Ok(Some(run).filter(|run| run.end == RunEnd::Complete))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::MemoryWorld;

    const TEXT: &str = "circuit f(a) -> (q) { q = not a }\nswarm one { circuit: f }\nswarm two { circuit: f }\n\
                        test f {\n a | q\n 0 | 1 for 3 cycles\n}\nsimulate one with schedule (a) { 0 for 3 cycles }\n";

    /// What was told of a test and a simulation, and how many runs they have, if a flag is raised after so many steps.
    fn check(most: usize) -> (Vec<(u64, u64)>, usize, bool) {
        let mut world = MemoryWorld::default();
        world.insert("a.nb", TEXT);
        let mut session = Session::new(world);
        let checked = session.checked("a.nb");
        let cancel = CancelFlag::default();
        let mut told = Vec::new();
        let progress = |done, all| {
            told.push((done, all));
            if told.len() == most {
                cancel.raise();
            }
        };
        let mut observer = Cancellable { cancel: cancel.clone(), progress };
        let (test, simulation) = (&checked.program.tests[0], &checked.program.simulations[0]);
        let options = TestOptions::default();
        let runs = complete_test(&session, &checked, test, &options, &mut observer).unwrap();
        let options = CompileOptions::default();
        let run = complete_simulation(&session, &checked, simulation, &options, &mut observer).unwrap();
        (told, runs.len(), run.is_some())
    }

    #[test]
    fn cancelled_runs_have_no_result_and_progress_is_of_the_whole() {
        let (told, runs, simulated) = check(100);
        assert_eq!(
            (told, runs, simulated),
            (vec![(1, 6), (2, 6), (3, 6), (4, 6), (5, 6), (6, 6), (1, 3), (2, 3), (3, 3)], 2, true)
        );
        assert_eq!(check(4), (vec![(1, 6), (2, 6), (3, 6), (4, 6)], 1, false));
        assert_eq!(check(3), (vec![(1, 6), (2, 6), (3, 6)], 1, false), "the second does not begin");
    }
}
