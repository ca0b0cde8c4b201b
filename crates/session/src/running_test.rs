//! Tests that run: each is a value that does its work in portions.

use std::vec::IntoIter;

use crate::hold;
use crate::observer::{CaseObserver, CycleRunner, Observer};
use crate::script::PerformedRow;
use crate::swarm_run::{DrivenSwarm, Physics, RunEnd, SwarmRun};
use crate::test::{TestCase, TestRun, TestSubject, judged, verdict};
use crate::test_timing::{RowEnds, TestTiming};
use nbc_base::diag::Diagnostic;
use nbc_circuit::Settled;
use nbc_circuit::properties::PropertySearch;
use nbc_swarm::{Level, RowVerdict, SwarmTrace};

/// A test that runs: its cases one after the other. It can be dropped between any two portions.
pub struct RunningTest {
    physics: Physics,
    cases: IntoIter<TestCase>,
    running: Option<RunningCase>,
    runs: Vec<TestRun>,
    /// The work of the cases that have run, and of all.
    before: u64,
    all: u64,
}

impl RunningTest {
    /// A test before its first case.
    pub(super) fn new(physics: Physics, cases: Vec<TestCase>) -> Self {
        let all = cases.iter().map(TestCase::work).sum();
        Self { physics, cases: cases.into_iter(), running: None, runs: Vec::new(), before: 0, all }
    }

    /// Does a portion of the work: a cycle of a swarm, or some rows at the level of logic. Whether it did anything:
    /// there is nothing to do after the last case, and after a request to stop.
    pub fn advance(&mut self, observer: &mut dyn Observer) -> bool {
        self.advance_with(observer, &mut ())
    }

    /// The same, with the cycles of swarms simulated by a runner.
    pub fn advance_with(&mut self, observer: &mut dyn Observer, runner: &mut dyn CycleRunner) -> bool {
        let Some(case) = &mut self.running else {
            // A circuit that was compiled after a request to stop may have more robots than needed.
            let next = if observer.is_cancelled() { None } else { self.cases.next() };
            self.running = next.map(|case| RunningCase::new(case, &self.physics, observer));
            return self.running.is_some();
        };
        let work = case.case.work();
        let mut observer = CaseObserver { whole: observer, before: self.before, all: self.all };
        if let Some(end) = case.advance(&mut observer, runner) {
            self.before += work;
            self.runs.extend(self.running.take().map(|case| case.finish(end)));
        }
        true
    }

    /// Whether all cases were completed.
    pub fn is_complete(&self) -> bool {
        let is_over = self.running.is_none() && self.cases.len() == 0;
        is_over && self.runs.iter().all(|run| run.end == RunEnd::Complete)
    }

    /// The results of the cases that have run.
    pub fn into_runs(self) -> Vec<TestRun> {
        self.runs
    }
}

/// A case of a test that runs.
pub(super) struct RunningCase {
    case: TestCase,
    subject: Running,
    /// The verdicts on the rows at the level of logic.
    rows: Vec<RowVerdict>,
    warnings: Vec<Diagnostic>,
}

enum Running {
    Gates(Box<Settled>),
    /// The script of the case.
    Script,
    /// A search that decides a test for ever.
    Search(Box<PropertySearch>),
    /// A swarm. If the test ends with the first row that fails, the rows that end with each cycle.
    Robots(Box<DrivenSwarm>, RowEnds),
}

impl RunningCase {
    /// A case at its start, or with the swarm that the observer has kept of it.
    pub(super) fn new(case: TestCase, physics: &Physics, observer: &mut dyn Observer) -> Self {
        let subject = match (case.timed(), &case.subject) {
            (Some(timed), _) => {
                let inputs = timed.inputs(case.rows.len());
                let mut swarm = DrivenSwarm::new(physics.swarm(timed.compiled, inputs.len()), inputs);
                swarm.resume(timed.compiled, observer);
                let ends = if case.ends_at_failure { timed.row_ends() } else { RowEnds::new() };
                Running::Robots(Box::new(swarm), ends)
            }
            (None, TestSubject::Gates(netlist)) => Running::Gates(Box::new(Settled::new(netlist))),
            (None, TestSubject::Ever(equivalence)) => Running::Search(Box::new(equivalence.search())),
            (None, _) => Running::Script,
        };
        Self { case, subject, rows: Vec::new(), warnings: Vec::new() }
    }

    /// Does a portion of the work. How the run ended, if it did.
    pub(super) fn advance(&mut self, observer: &mut dyn Observer, runner: &mut dyn CycleRunner) -> Option<RunEnd> {
        let (done, all) = match &mut self.subject {
            Running::Robots(swarm, ends) => {
                let timed = self.case.timed().expect("a test in physics");
                let fails = |trace: &SwarmTrace| {
                    ends.get(&trace.cycles.len()).is_some_and(|rows| rows.iter().any(|&row| !timed.passes(trace, row)))
                };
                return swarm.advance(&timed.compiled.assembly, fails, observer, runner);
            }
            Running::Gates(circuit) => {
                let rows = self.case.rows.chunks(Settled::ROWS).nth(self.rows.len() / Settled::ROWS).unwrap_or(&[]);
                self.rows.extend(nbc_swarm::judge_logic(&self.case.test, rows, circuit));
                (self.rows.len(), self.case.rows.len())
            }
            Running::Script => self.perform(),
            Running::Search(search) => {
                search.advance();
                let TestSubject::Ever(equivalence) = &self.case.subject else { unreachable!("the subject is a pair") };
                if equivalence.is_stopped() {
                    return Some(RunEnd::Cancelled);
                }
                (usize::from(search.is_done()), 1)
            }
        };
        observer.progress(done as u64, all as u64);
        match done < all && self.warnings.is_empty() {
            true => observer.is_cancelled().then_some(RunEnd::Cancelled),
            false => Some(RunEnd::Complete),
        }
    }

    /// Performs some steps of a script. The verdicts have the last row of each step. The steps that are done, and all.
    fn perform(&mut self) -> (usize, usize) {
        let TestSubject::Script(performance) = &mut self.case.subject else { unreachable!("the subject is a script") };
        for _ in 0..Settled::ROWS {
            match performance.step() {
                Ok(None) => break,
                Ok(Some(performed)) => {
                    for PerformedRow { row, outputs, .. } in performed.into_iter().filter(|row| row.is_last) {
                        let steady = vec![true; outputs.len()];
                        self.rows.push(nbc_swarm::judge_row(&self.case.test, &row, &outputs, &steady));
                    }
                }
                Err(fault) => {
                    self.warnings.push(fault);
                    break;
                }
            }
        }
        performance.progress()
    }

    /// The result of a run that ended so.
    pub(super) fn finish(self, end: RunEnd) -> TestRun {
        let Self { case, subject, mut rows, warnings } = self;
        let mut decided = None;
        if let (Running::Search(search), TestSubject::Ever(equivalence)) = (&subject, &case.subject) {
            let (proof, is_equal, found) = equivalence.judge(&case.test, search);
            (decided, rows) = (Some((proof, is_equal)), found);
        }
        if let Running::Robots(swarm, _) = subject {
            let timed = case.timed().expect("a test in physics");
            let trace = swarm.into_trace();
            let (verdict, warnings) = judged(timed, &case.printed, &trace, end);
            let hold = match timed.timing {
                TestTiming::Holds(_) => hold::sufficient(&case.rows, timed.compiled),
                TestTiming::Waves => timed.compiled.timing.hold as usize,
            };
            let TestSubject::Robots(compiled, _) = case.subject else { unreachable!("a test in physics has robots") };
            let swarm = Some(SwarmRun { compiled: *compiled, trace });
            return TestRun { verdict, end, swarm, hold: Some(hold), warnings };
        }
        let mut verdict = verdict(&case.test, Level::Logic, None, rows);
        if let Some((proof, is_equal)) = decided {
            (verdict.proof, verdict.passed) = (Some(proof), is_equal);
        }
        verdict.passed &= end == RunEnd::Complete && warnings.is_empty();
        if let TestSubject::Script(performance) = case.subject {
            verdict.printed = Some(performance.printed).filter(|printed| !printed.is_empty());
        }
        TestRun { verdict, end, swarm: None, hold: None, warnings }
    }
}
