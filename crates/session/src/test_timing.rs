//! How the rows of a test pass in physics: each held until the robots have settled, or as the steps of a wave machine.

use std::collections::BTreeMap;

use crate::compile::Compiled;
use nbc_base::model::{CircuitTest, TestRow};
use nbc_swarm::{RowHold, RowVerdict, SwarmTrace, WaveTest};

/// A row of a test in a thread of its swarm; only wave machines have more than thread 0.
#[derive(Clone, Copy, Debug)]
pub struct ThreadRow {
    row: usize,
    thread: usize,
}

/// The rows that end with a cycle, by the number of cycles until then.
pub type RowEnds = BTreeMap<usize, Vec<ThreadRow>>;

/// When the rows of a test begin and end.
#[derive(Clone, Debug)]
pub(super) enum TestTiming {
    /// Rows one after the other, each with its hold.
    Holds(Vec<RowHold>),
    /// Steps of a wave machine.
    Waves,
}

/// A test with its swarm and its timing.
#[derive(Clone, Copy)]
pub(super) struct TimedTest<'a> {
    pub test: &'a CircuitTest,
    pub rows: &'a [TestRow],
    pub compiled: &'a Compiled,
    pub timing: &'a TestTiming,
}

impl<'a> TimedTest<'a> {
    fn waves(self, rows: &'a [TestRow]) -> WaveTest<'a> {
        let machine = self.compiled.mapping.waves.as_ref().expect("only wave machines run in waves");
        WaveTest { test: self.test, rows, machine }
    }

    /// The cycles through the first `rows` rows.
    pub fn cycles(self, rows: usize) -> usize {
        match self.timing {
            TestTiming::Holds(row_holds) => row_holds.iter().take(rows).map(|row_hold| row_hold.hold).sum(),
            TestTiming::Waves => self.waves(self.rows).machine.cycles(rows),
        }
    }

    /// For each of the first `rows` rows, the cycles after which it has passed.
    pub fn ends(self, rows: usize) -> Vec<usize> {
        match self.timing {
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

    /// The input bits of each cycle through the first `rows` rows.
    pub fn inputs(self, rows: usize) -> Vec<Vec<bool>> {
        match self.timing {
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

    /// The verdict on each row of which a trace has the results.
    pub fn judge(self, trace: &SwarmTrace) -> Vec<RowVerdict> {
        let mut verdicts = match self.timing {
            TestTiming::Holds(row_holds) => {
                nbc_swarm::judge_swarm(self.test, self.rows, row_holds, trace, &self.compiled.clocks())
            }
            TestTiming::Waves => self.waves(self.rows).judge(trace),
        };
        // Rows that show start values need no cycle, but a swarm in which a robot failed passes no test.
        if let (Some(last), Some(fault)) = (verdicts.last_mut(), trace.fault()) {
            (last.passed, last.fault) = (false, Some(fault));
        }
        verdicts
    }

    /// For each number of cycles, the rows whose last result is that of the last of them.
    pub fn row_ends(self) -> RowEnds {
        let mut ends = RowEnds::new();
        match self.timing {
            TestTiming::Holds(row_holds) => {
                let mut end = 0;
                for (row, row_hold) in row_holds.iter().enumerate() {
                    end += row_hold.hold;
                    ends.insert(end, vec![ThreadRow { row, thread: 0 }]);
                }
            }
            TestTiming::Waves => {
                let waves = self.waves(self.rows);
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

    /// Whether a row passes whose last result is that of a trace's last cycle.
    pub fn passes(self, trace: &SwarmTrace, ThreadRow { row, thread }: ThreadRow) -> bool {
        match self.timing {
            TestTiming::Holds(row_holds) => nbc_swarm::passes(self.test, &self.rows[row], &row_holds[row], trace),
            TestTiming::Waves => self.waves(self.rows).row(trace, row, thread).is_none_or(|verdict| verdict.passed),
        }
    }
}
