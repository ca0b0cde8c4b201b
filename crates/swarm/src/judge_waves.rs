//! Judges whether a wave machine passes a test: each row in each of its threads.

use crate::judge::{judge_row, without_outputs};
use crate::{RowVerdict, SwarmTrace, WrongOutput};
use nbc_base::model::{CircuitTest, TestRow};
use nbc_circuit::NetId;
use nbc_circuit::waves::{Reading, WaveMachine};

#[derive(Clone, Copy, Debug)]
pub struct WaveTest<'a> {
    pub test: &'a CircuitTest,
    /// Its steps: the first is before the first edge of the clock, each other one after one.
    pub rows: &'a [TestRow],
    pub machine: &'a WaveMachine,
}

impl WaveTest<'_> {
    /// If the trace ends early, only complete rows are judged; if a robot failed, the others have failed with it.
    pub fn judge(&self, trace: &SwarmTrace) -> Vec<RowVerdict> {
        let threads = 0..self.machine.period as usize;
        let verdict = |row, thread| self.row(trace, row, thread).or_else(|| self.failed(trace, row, thread));
        let rows = |thread| (0..self.rows.len()).map_while(move |row| verdict(row, thread));
        threads.flat_map(rows).collect()
    }

    fn failed(&self, trace: &SwarmTrace, row: usize, thread: usize) -> Option<RowVerdict> {
        let verdict = without_outputs(self.test, &self.rows[row], trace.fault()?);
        let cycles = Some(self.machine.cycles_per_step());
        Some(RowVerdict { thread: Some(thread), cycles, needed: cycles, ..verdict })
    }

    /// `None` if the trace does not have its results.
    pub fn row(&self, trace: &SwarmTrace, row: usize, thread: usize) -> Option<RowVerdict> {
        let machine = self.machine;
        let outputs = 0..machine.outputs.len();
        let value = |output: usize| match machine.reading(output, row, thread) {
            Reading::Start(start) => Some(start),
            Reading::Cycle(cycle) => trace.cycles.get(cycle).map(|cycle| cycle.outputs[output]),
        };
        let outputs = outputs.map(value).collect::<Option<Vec<bool>>>()?;
        let verdict = judge_row(self.test, &self.rows[row], &outputs, &vec![true; outputs.len()]);
        let wrong_outputs = match (verdict.passed, self.last_cycle(row, thread)) {
            (false, Some(last)) => self.wrong_outputs(trace, last, thread),
            _ => Vec::new(),
        };
        let cycles = Some(machine.cycles_per_step());
        Some(RowVerdict { thread: Some(thread), cycles, needed: cycles, wrong_outputs, ..verdict })
    }

    /// The last cycle at whose end an output shows the result of a row in a thread; none if all show start values.
    pub fn last_cycle(&self, row: usize, thread: usize) -> Option<usize> {
        let readings = (0..self.machine.outputs.len()).map(|output| self.machine.reading(output, row, thread));
        let cycle = |reading| match reading {
            Reading::Start(_) => None,
            Reading::Cycle(cycle) => Some(cycle),
        };
        readings.filter_map(cycle).max()
    }

    fn wrong_outputs(&self, trace: &SwarmTrace, last: usize, thread: usize) -> Vec<WrongOutput> {
        let machine = self.machine;
        let cells: Vec<NetId> = machine.netlist.cells().map(|(id, _)| id).collect();
        let first = (last + 1).saturating_sub(machine.cycles_per_step());
        let ends = (first..=last).filter(|cycle| (cycle + 1).is_multiple_of(machine.beat as usize));
        let robots = ends.flat_map(|cycle| (0..cells.len()).map(move |k| (cycle, k)));
        let lapse = |(cycle, k): (usize, usize)| {
            let robot = &trace.robots[k];
            let (sensed, output) = (trace.cycles[cycle].sensed[k], trace.cycles[cycle].bits[k]);
            let is_wrong = output != robot.function.under(sensed);
            (is_wrong && machine.thread_at(cells[k], cycle) == thread).then(|| WrongOutput {
                net: robot.net.clone(),
                robot: robot.robot.clone(),
                cycle,
                sensed: sensed.bits(robot.senses.len()),
                output,
            })
        };
        robots.filter_map(lapse).collect()
    }
}
