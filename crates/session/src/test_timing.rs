//! How the rows of a test pass in physics: each held until the robots have settled, or as the steps of a wave machine.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::compiled::Compiled;
use crate::hold;
use crate::swarm_run::RunEnd;
use nbc_base::model::{CircuitTest, NamedWorld, TestRow};
use nbc_swarm::{Level, RowHold, SwarmTrace, TestVerdict, WaveTest};

/// Only wave machines have more than thread 0.
#[derive(Clone, Copy, Debug)]
pub struct ThreadRow {
    row: usize,
    thread: usize,
}

/// Rows by the number of cycles after which they end.
pub type RowEnds = BTreeMap<usize, Vec<ThreadRow>>;

#[derive(Clone, Debug)]
pub(super) enum TestTiming {
    /// Rows one after the other.
    Holds(Vec<RowHold>),
    /// Steps of a wave machine.
    Waves,
}

impl TestTiming {
    pub fn row_holds(&self) -> &[RowHold] {
        if let Self::Holds(row_holds) = self { row_holds } else { &[] }
    }
}

/// A test in physics.
#[derive(Clone, Debug)]
pub(super) struct TimedTest {
    pub test: Arc<CircuitTest>,
    pub rows: Arc<[TestRow]>,
    pub compiled: Compiled,
    pub timing: TestTiming,
    /// Whether it ends with the first row that fails.
    pub ends_at_failure: bool,
    /// The environment's text while the rows pass.
    pub printed: String,
}

impl TimedTest {
    fn waves<'a>(&'a self, rows: &'a [TestRow]) -> WaveTest<'a> {
        let machine = self.compiled.mapping.waves.as_ref().expect("only wave machines run in waves");
        WaveTest { test: &self.test, rows, machine }
    }

    /// The same test in another world, with rows held for as long as its robots need there.
    pub fn in_world(&self, world: NamedWorld) -> Self {
        let mut moved = Self { compiled: self.compiled.in_world(world), ..self.clone() };
        if let TestTiming::Holds(row_holds) = &mut moved.timing
            && moved.compiled.pace() != self.compiled.pace()
        {
            *row_holds = hold::again(&moved.rows, row_holds, &moved.compiled);
        }
        moved
    }

    /// The cycles through the first `rows` rows.
    pub fn cycles(&self, rows: usize) -> usize {
        match &self.timing {
            TestTiming::Holds(row_holds) => row_holds.iter().take(rows).map(|row_hold| row_hold.hold).sum(),
            TestTiming::Waves => self.waves(&self.rows).machine.cycles(rows),
        }
    }

    /// The cycles after which each of the first `rows` rows has passed.
    pub fn ends(&self, rows: usize) -> Vec<usize> {
        match &self.timing {
            TestTiming::Holds(row_holds) => {
                let mut end = 0;
                let pass = |row_hold: &RowHold| {
                    end += row_hold.hold;
                    end
                };
                row_holds.iter().take(rows).map(pass).collect()
            }
            TestTiming::Waves => (1..=rows.min(self.rows.len())).map(|rows| self.cycles(rows)).collect(),
        }
    }

    /// Input bits of each cycle through the first `rows` rows.
    pub fn inputs(&self, rows: usize) -> Vec<Vec<bool>> {
        match &self.timing {
            TestTiming::Holds(row_holds) => {
                let held = self.rows.iter().zip(row_holds).take(rows);
                held.flat_map(|(row, row_hold)| std::iter::repeat_n(row.inputs.clone(), row_hold.hold)).collect()
            }
            TestTiming::Waves => {
                let WaveTest { rows: steps, machine, .. } = self.waves(&self.rows[..rows]);
                let bit = |input, cycle| steps[machine.row_at(input, cycle, steps.len())].inputs[input];
                let bits = |cycle| (0..machine.inputs.len()).map(|input| bit(input, cycle)).collect();
                (0..machine.cycles(steps.len())).map(bits).collect()
            }
        }
    }

    /// A hold that suffices for every row without one of its own; for a wave machine, the length of a step.
    pub fn sufficient_hold(&self) -> usize {
        match self.timing {
            TestTiming::Holds(_) => hold::sufficient(&self.rows, &self.compiled),
            TestTiming::Waves => self.compiled.timing.hold as usize,
        }
    }

    pub fn verdict(&self, trace: &SwarmTrace, end: RunEnd) -> TestVerdict {
        let is_complete = end == RunEnd::Complete;
        let Compiled { plan, weak_robots, .. } = &self.compiled;
        let mut rows = match &self.timing {
            TestTiming::Holds(row_holds) => {
                nbc_swarm::judge_swarm(&self.test, &self.rows, row_holds, trace, &self.compiled.clocks())
            }
            TestTiming::Waves => self.waves(&self.rows).judge(trace),
        };
        // Rows that show start values need no cycle, but a swarm in which a robot failed passes no test.
        if let (Some(last), Some(fault)) = (rows.last_mut(), trace.fault()) {
            (last.passed, last.fault) = (false, Some(fault));
        }
        let mut verdict = TestVerdict::of(&self.test, Level::Physics, rows);
        (verdict.swarm, verdict.world) = (plan.swarm.clone(), Some(plan.world.name.clone()));
        verdict.weak_robots = weak_robots.clone();
        verdict.printed = Some(self.printed.clone()).filter(|printed| !printed.is_empty() && is_complete);
        verdict.passed &= is_complete;
        verdict
    }

    /// For each number of cycles, the rows whose last result is that of its last cycle.
    pub fn row_ends(&self) -> RowEnds {
        let mut ends = RowEnds::new();
        match &self.timing {
            TestTiming::Holds(row_holds) => {
                for (row, end) in self.ends(row_holds.len()).into_iter().enumerate() {
                    ends.insert(end, vec![ThreadRow { row, thread: 0 }]);
                }
            }
            TestTiming::Waves => {
                let waves = self.waves(&self.rows);
                for thread in 0..waves.machine.period as usize {
                    for row in 0..self.rows.len() {
                        if let Some(last) = waves.last_cycle(row, thread) {
                            ends.entry(last + 1).or_default().push(ThreadRow { row, thread });
                        }
                    }
                }
            }
        }
        ends
    }

    /// Whether a row passes whose last result is that of the trace's last cycle.
    pub fn passes(&self, trace: &SwarmTrace, ThreadRow { row, thread }: ThreadRow) -> bool {
        match &self.timing {
            TestTiming::Holds(row_holds) => nbc_swarm::passes(&self.test, &self.rows[row], &row_holds[row], trace),
            TestTiming::Waves => self.waves(&self.rows).row(trace, row, thread).is_none_or(|verdict| verdict.passed),
        }
    }
}
