//! Whether a swarm did what a test asks, row by row, and which robot failed where it did not.

use std::ops::Range;

use serde::Serialize;

use crate::swarm::{START_CYCLES, SwarmTrace};

/// Cycles over which an output must have had its value when its row ends.
const STEADY_CYCLES: usize = 2;

/// What a test came to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct TestVerdict {
    /// The test's title.
    pub title: String,
    /// The circuit under test.
    pub circuit: String,
    /// The names of the input ports.
    pub inputs: Vec<String>,
    /// The names of the output ports.
    pub outputs: Vec<String>,
    /// The rows in order.
    pub rows: Vec<RowVerdict>,
    /// Whether all rows passed.
    pub passed: bool,
}

/// What a test's row asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Demand {
    /// Cycles for which the row is held.
    pub hold: usize,
    /// Cycles for which static timing would have it held.
    pub needed: usize,
    /// The outputs at its end; `None` where the row does not say.
    pub expected: Vec<Option<bool>>,
}

/// What a test's row came to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RowVerdict {
    /// Cycles for which the row was held.
    pub hold: usize,
    /// Cycles for which static timing would have it held.
    pub needed: usize,
    /// The input ports' bits.
    pub inputs: Vec<bool>,
    /// The outputs asked for; `None` where the row does not say.
    pub expected: Vec<Option<bool>>,
    /// The outputs at the end of the row.
    pub observed: Vec<bool>,
    /// Whether every checked output had its value, over the last two cycles at least.
    pub passed: bool,
    /// Robots that were wrong in the row although their stimuli had not changed for as long as their clock, where it failed.
    pub lapses: Vec<Lapse>,
    /// Robots that were wrong in the row's last cycle and had not had as long as their clock, where it failed.
    pub late: Vec<Lapse>,
}

/// A robot that gave another output than its function does of its stimuli.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Lapse {
    /// The net whose bit was wrong.
    pub net: String,
    /// The robot's name.
    pub robot: String,
    /// The cycle, from 0 at the test's start.
    pub cycle: usize,
    /// What it sensed.
    pub sensed: [bool; 2],
    /// What it output.
    pub output: bool,
}

/// Judges a trace whose cycles are the rows of a test one after another; `clocks[k]` is the clock of robot `k` in cycles.
///
/// # Panics
/// When the trace is shorter than its rows, or a row has no cycle.
pub fn judge(title: &str, trace: &SwarmTrace, rows: &[Demand], clocks: &[u32]) -> TestVerdict {
    let mut start = 0;
    let verdicts: Vec<RowVerdict> = rows
        .iter()
        .map(|row| {
            let cycles = start..start + row.hold;
            start = cycles.end;
            judge_row(trace, row, cycles, clocks)
        })
        .collect();
    TestVerdict {
        title: title.to_owned(),
        circuit: trace.circuit.clone(),
        inputs: trace.inputs.clone(),
        outputs: trace.outputs.clone(),
        passed: verdicts.iter().all(|row| row.passed),
        rows: verdicts,
    }
}

fn judge_row(trace: &SwarmTrace, row: &Demand, cycles: Range<usize>, clocks: &[u32]) -> RowVerdict {
    let last = &trace.cycles[cycles.end - 1];
    let steady = cycles.end.saturating_sub(STEADY_CYCLES).max(cycles.start)..cycles.end;
    let passed = trace.cycles[steady].iter().all(|cycle| meets(&row.expected, &cycle.outputs));
    let mut wrong = if passed { Vec::new() } else { wrong(trace, cycles.clone(), clocks) };
    let late = wrong.extract_if(.., |(_, settled)| !*settled).map(|(lapse, _)| lapse);
    let late = late.filter(|lapse| lapse.cycle + 1 == cycles.end).collect();
    RowVerdict {
        hold: row.hold,
        needed: row.needed,
        inputs: last.inputs.clone(),
        expected: row.expected.clone(),
        observed: last.outputs.clone(),
        passed,
        late,
        lapses: wrong.into_iter().map(|(lapse, _)| lapse).collect(),
    }
}

fn meets(expected: &[Option<bool>], outputs: &[bool]) -> bool {
    expected.iter().zip(outputs).all(|(expected, &output)| expected.is_none_or(|expected| expected == output))
}

/// The robots that were wrong in these cycles, in order of cycles, and whether their stimuli had settled.
fn wrong(trace: &SwarmTrace, cycles: Range<usize>, clocks: &[u32]) -> Vec<(Lapse, bool)> {
    let robots = || trace.robots.iter().zip(clocks).enumerate();
    let of_cycle = |cycle: usize| {
        robots().filter_map(move |(k, (robot, &clock))| {
            let (sensed, output) = (trace.cycles[cycle].sensed[k], trace.cycles[cycle].bits[k]);
            let (net, name) = (robot.net.clone(), robot.robot.clone());
            let lapse = || Lapse { net, robot: name, cycle, sensed, output };
            let settled = || is_settled(trace, cycle, k, clock as usize);
            (output != robot.function.output(sensed[0], sensed[1])).then(|| (lapse(), settled()))
        })
    };
    cycles.flat_map(of_cycle).collect()
}

/// Whether robot `k` had sensed the same for `clock` cycles when this cycle ended; after its fresh start a robot has more time.
fn is_settled(trace: &SwarmTrace, cycle: usize, k: usize, clock: usize) -> bool {
    let sensed = trace.cycles[cycle].sensed[k];
    cycle + 1 >= clock.max(START_CYCLES)
        && trace.cycles[cycle + 1 - clock..=cycle].iter().all(|cycle| cycle.sensed[k] == sensed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Function;
    use crate::swarm::{CycleTrace, RobotTrace, Signal};

    /// An inverter's trace with these inputs and outputs in each cycle.
    fn inverter(cycles: &[(bool, bool)]) -> SwarmTrace {
        SwarmTrace {
            circuit: "inverter".to_owned(),
            inputs: vec!["a".to_owned()],
            outputs: vec!["y".to_owned()],
            shown: vec![Signal::Robot(0)],
            samples_per_cycle: 1,
            robots: vec![RobotTrace {
                net: "y".to_owned(),
                function: Function::NOT,
                robot: "not_1".to_owned(),
                senses: [Signal::Input(0), Signal::Constant(false)],
                sensed_nets: ["a".to_owned(), "0".to_owned()],
                com_x: vec![0.0; cycles.len() + 1],
                fault: None,
            }],
            cycles: cycles
                .iter()
                .map(|&(a, y)| CycleTrace {
                    inputs: vec![a],
                    sensed: vec![[a, false]],
                    bits: vec![y],
                    outputs: vec![y],
                })
                .collect(),
        }
    }

    fn judged(cycles: &[(bool, bool)], expected: Option<bool>, clock: u32) -> TestVerdict {
        let demand = Demand { hold: cycles.len(), needed: 4, expected: vec![expected] };
        judge("t", &inverter(cycles), &[demand], &[clock])
    }

    fn check(cycles: &[(bool, bool)], expected: Option<bool>, clock: u32, passed: bool, wrong_cycles: &[usize]) {
        let verdict = judged(cycles, expected, clock);
        assert_eq!(verdict.passed, passed);
        let found: Vec<usize> = verdict.rows[0].lapses.iter().map(|lapse| lapse.cycle).collect();
        assert_eq!(found, wrong_cycles);
    }

    #[test]
    fn a_row_passes_on_its_last_two_cycles() {
        check(&[(true, true), (true, false), (true, false)], Some(false), 1, true, &[]);
        check(&[(true, false), (true, true), (true, false)], Some(false), 1, false, &[1]);
    }

    #[test]
    fn an_output_that_is_not_asked_for_is_not_checked() {
        check(&[(true, true), (true, true)], None, 1, true, &[]);
    }

    #[test]
    fn a_robot_that_has_not_settled_is_not_to_blame() {
        check(&[(true, true), (true, true), (true, true)], Some(false), 3, false, &[2]);
    }

    #[test]
    fn a_robot_without_time_is_late() {
        let late = |cycles: &[(bool, bool)]| judged(cycles, Some(false), 2).rows[0].late.len();
        assert_eq!(late(&[(false, true), (true, true)]), 1);
        assert_eq!(late(&[(true, true), (true, true)]), 0);
    }
}
