//! Tests that run: each is a value that does its work in portions.

use std::sync::Arc;
use std::vec::IntoIter;

use crate::equivalence::Equivalence;
use crate::observer::{CaseObserver, CycleRunner, Observer};
use crate::script::{Performance, PerformedRow};
use crate::swarm_run::{DrivenSwarm, Physics, RunEnd, SwarmRun};
use crate::test::{TestCase, TestRun, TestSubject};
use crate::test_timing::{RowEnds, TimedTest};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{CircuitTest, TestRow};
use nbc_circuit::Settled;
use nbc_circuit::properties::PropertySearch;
use nbc_swarm::{Level, RowVerdict, SwarmTrace, TestVerdict};

/// A test that runs. It can be dropped between any two portions.
pub struct RunningTest {
    physics: Physics,
    cases: IntoIter<TestCase>,
    running: Option<RunningCase>,
    runs: Vec<TestRun>,
    /// Work of the finished cases, and of all.
    before: u64,
    all: u64,
}

impl RunningTest {
    pub(super) fn new(physics: Physics, cases: Vec<TestCase>) -> Self {
        let all = cases.iter().map(TestCase::work).sum();
        Self { physics, cases: cases.into_iter(), running: None, runs: Vec::new(), before: 0, all }
    }

    /// A cycle of a swarm, or some rows of logic. Returns false after the last case and after a request to stop.
    pub fn advance(&mut self, observer: &mut dyn Observer) -> bool {
        self.advance_with(observer, &mut ())
    }

    pub fn advance_with(&mut self, observer: &mut dyn Observer, runner: &mut dyn CycleRunner) -> bool {
        let Some(case) = &mut self.running else {
            // A circuit that was compiled after a request to stop may have more robots than needed.
            let next = if observer.is_cancelled() { None } else { self.cases.next() };
            self.running = next.map(|case| RunningCase::new(case, &self.physics, observer));
            return self.running.is_some();
        };
        let work = case.work;
        let mut observer = CaseObserver { whole: observer, before: self.before, all: self.all };
        if let Some(end) = case.advance(&mut observer, runner) {
            self.before += work;
            self.runs.extend(self.running.take().map(|case| case.finish(end)));
        }
        true
    }

    /// The verdicts over the rows that are judged so far.
    pub fn found(&self) -> Vec<TestVerdict> {
        let finished = self.runs.iter().map(|run| run.verdict.clone());
        finished.chain(self.running.as_ref().and_then(RunningCase::found)).collect()
    }

    pub fn is_complete(&self) -> bool {
        let is_over = self.running.is_none() && self.cases.len() == 0;
        is_over && self.runs.iter().all(|run| run.end == RunEnd::Complete)
    }

    pub fn into_runs(self) -> Vec<TestRun> {
        self.runs
    }
}

pub(super) struct RunningCase {
    test: Arc<CircuitTest>,
    work: u64,
    subject: Running,
    verdicts: Vec<RowVerdict>,
    fault: Option<Diagnostic>,
}

enum Running {
    Gates(Box<Settled>, Arc<[TestRow]>),
    Script(Box<Performance>),
    Search(Box<Equivalence>, Box<PropertySearch>),
    /// With the ends of rows, if the test ends with the first row that fails.
    Robots(Box<TimedTest>, Box<DrivenSwarm>, RowEnds),
}

impl RunningCase {
    pub(super) fn new(case: TestCase, physics: &Physics, observer: &mut dyn Observer) -> Self {
        let work = case.work();
        let subject = match case.subject {
            TestSubject::Gates(netlist, rows) => Running::Gates(Box::new(Settled::new(&netlist)), rows),
            TestSubject::Script(performance) => Running::Script(performance),
            TestSubject::Ever(equivalence) => {
                let search = equivalence.search();
                Running::Search(equivalence, Box::new(search))
            }
            TestSubject::Robots(timed) => {
                let inputs = timed.inputs(timed.rows.len());
                let mut swarm = DrivenSwarm::new(physics.swarm(&timed.compiled, inputs.len()), inputs);
                swarm.resume(&timed.compiled, observer);
                let ends = if timed.ends_at_failure { timed.row_ends() } else { RowEnds::new() };
                Running::Robots(timed, Box::new(swarm), ends)
            }
        };
        Self { test: case.test, work, subject, verdicts: Vec::new(), fault: None }
    }

    pub(super) fn advance(&mut self, observer: &mut dyn Observer, runner: &mut dyn CycleRunner) -> Option<RunEnd> {
        let (done, all) = match &mut self.subject {
            Running::Robots(timed, swarm, ends) => {
                let fails = |trace: &SwarmTrace| {
                    ends.get(&trace.cycles.len()).is_some_and(|rows| rows.iter().any(|&row| !timed.passes(trace, row)))
                };
                return swarm.advance(&timed.compiled.assembly, fails, observer, runner);
            }
            Running::Gates(circuit, rows) => {
                let next = rows.chunks(Settled::ROWS).nth(self.verdicts.len() / Settled::ROWS).unwrap_or(&[]);
                self.verdicts.extend(nbc_swarm::judge_logic(&self.test, next, circuit));
                (self.verdicts.len(), rows.len())
            }
            Running::Script(performance) => {
                let performed = perform(performance, &self.test, &mut self.verdicts);
                self.fault = performed.err();
                performance.progress()
            }
            Running::Search(equivalence, search) => {
                search.advance();
                if equivalence.is_stopped() {
                    return Some(RunEnd::Cancelled);
                }
                (usize::from(search.is_done()), 1)
            }
        };
        observer.progress(done as u64, all as u64);
        if done < all && self.fault.is_none() {
            observer.is_cancelled().then_some(RunEnd::Cancelled)
        } else {
            Some(RunEnd::Complete)
        }
    }

    fn found(&self) -> Option<TestVerdict> {
        match &self.subject {
            Running::Robots(timed, swarm, _) => Some(timed.verdict(swarm.trace(), RunEnd::Cancelled)),
            Running::Gates(..) | Running::Script(_) => {
                Some(TestVerdict::of(&self.test, Level::Logic, self.verdicts.clone()))
            }
            Running::Search(..) => None,
        }
    }

    pub(super) fn finish(self, end: RunEnd) -> TestRun {
        let Self { test, subject, verdicts, fault, .. } = self;
        let mut verdict = match subject {
            Running::Robots(timed, swarm, _) => {
                let trace = swarm.into_trace();
                let (verdict, hold) = (timed.verdict(&trace, end), timed.sufficient_hold());
                let compiled = timed.compiled;
                let warnings = compiled.warnings.clone();
                let swarm = Some(SwarmRun { compiled, trace });
                return TestRun { verdict, end, swarm, hold: Some(hold), warnings };
            }
            Running::Gates(..) => TestVerdict::of(&test, Level::Logic, verdicts),
            Running::Script(performance) => {
                let printed = Some(performance.printed).filter(|printed| !printed.is_empty());
                TestVerdict { printed, ..TestVerdict::of(&test, Level::Logic, verdicts) }
            }
            Running::Search(equivalence, search) => {
                let (proof, passed, rows) = equivalence.judge(&test, &search);
                TestVerdict { proof: Some(proof), passed, ..TestVerdict::of(&test, Level::Logic, rows) }
            }
        };
        verdict.passed &= end == RunEnd::Complete && fault.is_none();
        TestRun { verdict, end, swarm: None, hold: None, warnings: fault.into_iter().collect() }
    }
}

fn perform(script: &mut Performance, test: &CircuitTest, verdicts: &mut Vec<RowVerdict>) -> Result<(), Diagnostic> {
    for _ in 0..Settled::ROWS {
        let Some(performed) = script.step()? else { break };
        for PerformedRow { row, outputs, .. } in performed.into_iter().filter(|row| row.is_last) {
            verdicts.push(nbc_swarm::judge_row(test, &row, &outputs, &vec![true; outputs.len()]));
        }
    }
    Ok(())
}
