//! Tests and simulations, run one after the other: the loop of every door.

use nbc_base::diag::Diagnostics;
use nbc_base::model::CircuitTest;

use crate::checked::Checked;
use crate::observer::Observer;
use crate::run_report::{RunList, RunReport};
use crate::running_test::{RunningCase, RunningTest};
use crate::session::Session;
use crate::swarm_run::RunEnd;
use crate::test::{TestCase, TestOptions, TestRun};

impl Session {
    /// Tests run at the level of the options, simulations always in physics.
    pub fn run_list(
        &self,
        checked: &Checked,
        list: &RunList<'_>,
        options: &TestOptions,
        observer: &mut dyn Observer,
    ) -> Result<RunReport, Diagnostics> {
        let mut report = RunReport { left: list.len(), ..RunReport::default() };
        for (part, test) in list.tests.iter().enumerate() {
            // After a request to stop, circuits are compiled with little effort, so that nothing more is begun.
            if observer.is_cancelled() {
                return Ok(report);
            }
            observer.begin(part, list.len());
            let mut running = self.begin_test(checked, test, options)?;
            while running.advance(observer) {}
            report.left -= usize::from(running.is_complete());
            report.tests.extend(running.into_runs());
        }
        for (part, simulation) in (list.tests.len()..).zip(&list.simulations) {
            if observer.is_cancelled() {
                break;
            }
            observer.begin(part, list.len());
            let run = self.simulate(checked, simulation, &options.compile, observer)?;
            report.left -= usize::from(run.end == RunEnd::Complete);
            report.simulations.push(run);
        }
        Ok(report)
    }

    pub fn test(
        &self,
        checked: &Checked,
        test: &CircuitTest,
        options: &TestOptions,
        observer: &mut dyn Observer,
    ) -> Result<Vec<TestRun>, Diagnostics> {
        let mut running = self.begin_test(checked, test, options)?;
        while running.advance(observer) {}
        Ok(running.into_runs())
    }

    pub fn begin_test(
        &self,
        checked: &Checked,
        test: &CircuitTest,
        options: &TestOptions,
    ) -> Result<RunningTest, Diagnostics> {
        Ok(RunningTest::new(self.physics.clone(), checked.cases(test, options)?))
    }

    pub fn run_case(&self, case: TestCase, observer: &mut dyn Observer) -> TestRun {
        let mut running = RunningCase::new(case, &self.physics, observer);
        loop {
            if let Some(end) = running.advance(observer, &mut ()) {
                return running.finish(end);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nbc_base::source::MemoryWorld;
    use nbc_circuit::CancelFlag;

    use super::*;

    const TEXT: &str = "circuit f(a) -> (q) { q = not a }\nswarm one { circuit: f }\nswarm two { circuit: f }\n\
                        test f {\n a | q\n 0 | 1 for 3 cycles\n}\nsimulate one with schedule (a) { 0 for 3 cycles }\n";

    struct RecordingObserver {
        told: Vec<(u64, u64)>,
        parts: Vec<(usize, usize)>,
        most: usize,
        cancel: CancelFlag,
    }

    impl Observer for RecordingObserver {
        fn begin(&mut self, part: usize, parts: usize) {
            self.parts.push((part, parts));
        }

        fn progress(&mut self, done: u64, all: u64) {
            self.told.push((done, all));
            if self.told.len() == self.most {
                self.cancel.raise();
            }
        }

        fn is_cancelled(&self) -> bool {
            self.cancel.is_raised()
        }
    }

    fn check(most: usize) -> (RecordingObserver, RunReport) {
        let mut world = MemoryWorld::default();
        world.insert("a.nb", TEXT);
        let mut session = Session::new(world);
        let checked = session.checked("a.nb");
        let mut notes = RecordingObserver { told: Vec::new(), parts: Vec::new(), most, cancel: CancelFlag::default() };
        let list = RunList::all(&checked.program);
        let report = session.run_list(&checked, &list, &TestOptions::default(), &mut notes).unwrap();
        (notes, report)
    }

    #[test]
    fn progress_is_of_the_whole_test_and_of_each_simulation() {
        let (notes, report) = check(100);
        assert_eq!(notes.told, [(1, 6), (2, 6), (3, 6), (4, 6), (5, 6), (6, 6), (1, 3), (2, 3), (3, 3)]);
        assert_eq!(notes.parts, [(0, 2), (1, 2)]);
        assert_eq!((report.tests.len(), report.simulations.len(), report.left), (2, 1, 0));
    }

    #[test]
    fn nothing_begins_after_a_request_to_stop() {
        let (notes, report) = check(4);
        assert_eq!(notes.told, [(1, 6), (2, 6), (3, 6), (4, 6)]);
        assert_eq!((report.tests.len(), report.simulations.len(), report.left), (2, 0, 2));
        assert_eq!([0, 1].map(|run| report.tests[run].end), [RunEnd::Complete, RunEnd::Cancelled]);
        let (notes, report) = check(3);
        assert_eq!((notes.told.len(), report.tests.len()), (3, 1), "the second case does not begin");
    }
}
