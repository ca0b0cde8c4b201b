//! Judges whether a circuit passes a test, row by row, and which robots were wrong if it failed.

use std::ops::Range;

use crate::assemble::start_cycles;
use crate::{Flip, RobotFault, RowVerdict, StimulusSource, SwarmTrace, WrongOutput};
use nbc_base::model::{CYCLE_STEPS, CircuitTest, TestRow};
use nbc_circuit::{Netlist, Settled, SettledRow};

/// Cycles over which an output must have had its value when its row ends.
pub const STEADY_CYCLES: usize = 2;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowHold {
    pub hold: usize,
    /// Cycles for which `hold: auto` would hold it.
    pub needed: usize,
    /// For each output bit, whether it comes to rest at the level of logic.
    pub rests: Vec<bool>,
}

/// Every row of every test is judged here.
pub fn judge_row(test: &CircuitTest, row: &TestRow, outputs: &[bool], steady: &[bool]) -> RowVerdict {
    let meets = |((expected, &output), &steady): ((&Option<bool>, &bool), &bool)| {
        expected.is_none_or(|expected| expected == output && steady)
    };
    let mut bits = steady.iter();
    let values = |bits: &[Option<bool>]| row.output_values(&test.inputs, &test.outputs, bits.iter().copied());
    RowVerdict {
        row: row.row,
        line: row.line,
        inputs: row.input_values(&test.inputs),
        expected: values(&row.expected),
        observed: values(&outputs.iter().copied().map(Some).collect::<Vec<_>>()),
        steady: test
            .outputs
            .iter()
            .map(|port| bits.by_ref().take(port.width).fold(true, |all, &bit| all & bit))
            .collect(),
        passed: row.expected.iter().zip(outputs).zip(steady).all(meets),
        is_half: row.is_half,
        given_up: row.given_up,
        ..RowVerdict::default()
    }
}

pub(super) fn without_outputs(test: &CircuitTest, row: &TestRow, fault: RobotFault) -> RowVerdict {
    let none = vec![false; row.expected.len()];
    RowVerdict {
        observed: row.output_values(&test.inputs, &test.outputs, none.iter().map(|_| None)),
        passed: false,
        fault: Some(fault),
        ..judge_row(test, row, &none, &none)
    }
}

/// At most [`Settled::ROWS`] rows, each held until nothing changes. A checked output that keeps changing fails.
pub fn judge_logic(test: &CircuitTest, rows: &[TestRow], circuit: &mut Settled) -> impl Iterator<Item = RowVerdict> {
    rows.iter().zip(settle(rows, circuit)).map(|(row, end)| judge_row(test, row, &end.outputs, &end.rests))
}

fn settle(rows: &[TestRow], circuit: &mut Settled) -> Vec<SettledRow> {
    circuit.apply(&rows.iter().map(|row| row.inputs.as_slice()).collect::<Vec<_>>())
}

/// In physics an output that keeps changing may have one value for the last cycles of a row by chance.
pub fn resting_outputs(rows: &[TestRow], netlist: &Netlist) -> Vec<Vec<bool>> {
    let mut circuit = Settled::new(netlist);
    rows.chunks(Settled::ROWS).flat_map(|rows| settle(rows, &mut circuit)).map(|end| end.rests).collect()
}

pub fn passes(test: &CircuitTest, row: &TestRow, row_hold: &RowHold, trace: &SwarmTrace) -> bool {
    let end = trace.cycles.len();
    let steady = steady_outputs(trace, &(end - row_hold.hold..end), row_hold);
    judge_row(test, row, &trace.cycles[end - 1].outputs, &steady).passed
}

/// `clocks[k]` is the clock of robot `k` in cycles. If the trace ends early, only complete rows are judged; if a robot
/// failed, the others have failed with it.
pub fn judge_swarm(
    test: &CircuitTest,
    rows: &[TestRow],
    row_holds: &[RowHold],
    trace: &SwarmTrace,
    clocks: &[u32],
) -> Vec<RowVerdict> {
    let mut start = 0;
    let judge = |(row, row_hold): (&TestRow, &RowHold)| {
        let cycles = start..start + row_hold.hold;
        start = cycles.end;
        if cycles.end > trace.cycles.len() {
            let verdict = without_outputs(test, row, trace.fault()?);
            return Some(RowVerdict { cycles: Some(row_hold.hold), needed: Some(row_hold.needed), ..verdict });
        }
        let last = &trace.cycles[cycles.end - 1];
        let steady = steady_outputs(trace, &cycles, row_hold);
        let verdict = judge_row(test, row, &last.outputs, &steady);
        let mut wrong = if verdict.passed { Vec::new() } else { wrong(trace, cycles.clone(), clocks) };
        let late = wrong.extract_if(.., |(_, settled)| !*settled).map(|(wrong, _)| wrong);
        let late = late.filter(|wrong| wrong.cycle + 1 == cycles.end).collect();
        let wrong_outputs = wrong.into_iter().map(|(wrong, _)| wrong).collect();
        Some(RowVerdict { cycles: Some(row_hold.hold), needed: Some(row_hold.needed), wrong_outputs, late, ..verdict })
    };
    rows.iter().zip(row_holds).map_while(judge).collect()
}

fn steady_outputs(trace: &SwarmTrace, cycles: &Range<usize>, row_hold: &RowHold) -> Vec<bool> {
    let last = &trace.cycles[cycles.end - 1].outputs;
    let end = &trace.cycles[cycles.end.saturating_sub(STEADY_CYCLES).max(cycles.start)..cycles.end];
    let had_one_value = |bit: usize| end.iter().all(|cycle| cycle.outputs[bit] == last[bit]);
    row_hold.rests.iter().enumerate().map(|(bit, &rests)| rests && had_one_value(bit)).collect()
}

/// In order of cycles, and whether their stimuli had been stable long enough.
fn wrong(trace: &SwarmTrace, cycles: Range<usize>, clocks: &[u32]) -> Vec<(WrongOutput, bool)> {
    let start = start_cycles(clocks.iter().copied());
    let robots = || trace.robots.iter().zip(clocks).enumerate();
    let of_cycle = |cycle: usize| {
        robots().filter_map(move |(k, (robot, &clock))| {
            let (sensed, output) = (trace.cycles[cycle].sensed[k], trace.cycles[cycle].bits[k]);
            let (net, name) = (robot.net.clone(), robot.robot.clone());
            let wrong = || WrongOutput { net, robot: name, cycle, sensed: sensed.bits(robot.senses.len()), output };
            let settled = || cycle + 1 >= start && is_settled(trace, cycle, k, clock as usize);
            (output != robot.function.under(sensed)).then(|| (wrong(), settled()))
        })
    };
    cycles.flat_map(of_cycle).collect()
}

/// The cycle, the robot, and voxels a cycle in the correct direction, in order of cycles.
pub(super) fn settled_margins(trace: &SwarmTrace, clocks: &[u32], window: usize) -> Vec<(usize, usize, f64)> {
    let start = start_cycles(clocks.iter().copied());
    let first = start.saturating_sub(1);
    let margin = |cycle: usize, k: usize| {
        let (robot, sensed) = (&trace.robots[k], trace.cycles[cycle].sensed[k]);
        let from = (cycle + 1).saturating_sub(window);
        let moved: f64 = (from..=cycle).map(|cycle| trace.displacement(k, cycle)).sum();
        let sign = if robot.function.under(sensed) { 1.0 } else { -1.0 };
        (cycle, k, sign * moved / (cycle + 1 - from) as f64)
    };
    let settled = |cycle: usize, k: usize| is_settled(trace, cycle, k, clocks[k] as usize + window - 1);
    let robots = |cycle| (0..clocks.len()).filter(move |&k| settled(cycle, k)).map(move |k| margin(cycle, k));
    (first..trace.cycles.len()).flat_map(robots).collect()
}

fn is_settled(trace: &SwarmTrace, cycle: usize, k: usize, clock: usize) -> bool {
    let sensed = trace.cycles[cycle].sensed[k];
    let Some(first) = (cycle + 1).checked_sub(clock) else { return false };
    let is_same = trace.cycles[first..=cycle].iter().all(|cycle| cycle.sensed[k] == sensed);
    let within = first as u32 * CYCLE_STEPS..(cycle + 1) as u32 * CYCLE_STEPS;
    let is_sensed = |flip: &Flip| trace.robots[k].senses.contains(&StimulusSource::Robot(flip.robot));
    is_same && !trace.flips.iter().any(|flip| within.contains(&flip.env_step) && is_sensed(flip))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CycleTrace, Recording, RobotTrace};
    use nbc_base::model::{Base, Column, Function, Pattern, Stimulation};
    use nbc_base::source::{FileId, Span};

    fn port(name: &str) -> Column {
        Column::new(name, 1)
    }

    fn inverter(cycles: &[(bool, bool)]) -> SwarmTrace {
        SwarmTrace {
            circuit: "inverter".to_owned(),
            inputs: vec![port("a")],
            outputs: vec![port("y")],
            shown: vec![StimulusSource::Robot(0)],
            samples_per_cycle: 1,
            robots: vec![RobotTrace {
                net: "y".to_owned(),
                block: Vec::new(),
                function: Function::NOT,
                robot: "not_1".to_owned(),
                senses: vec![StimulusSource::Input(0), StimulusSource::Constant(false)],
                sensed_nets: vec!["a".to_owned(), "0".to_owned()],
                com_x: vec![0.0; cycles.len() + 1],
                fault: None,
            }],
            cycles: cycles
                .iter()
                .map(|&(a, y)| CycleTrace {
                    inputs: vec![a],
                    sensed: vec![Pattern::new(&[a, false])],
                    bits: vec![y],
                    outputs: vec![y],
                })
                .collect(),
            flips: Vec::new(),
            recording: Recording::default(),
        }
    }

    fn test() -> CircuitTest {
        CircuitTest {
            circuit: "inverter".into(),
            title: String::new(),
            span: Span::new(FileId(0), 0, 0),
            file: "a.nb".to_owned(),
            line: 1,
            inputs: vec![port("a")],
            outputs: vec![port("y")],
            stimulation: Stimulation::Rows(Vec::new()),
            rows_from: None,
            worlds: Vec::new(),
        }
    }

    fn row(input: bool, expected: Option<bool>) -> TestRow {
        let span = Span::new(FileId(0), 0, 0);
        let bases = vec![Base::Bits; 2];
        let inputs = vec![input];
        let (hold, is_half, given_up) = (None, false, None);
        TestRow { inputs, expected: vec![expected], bases, hold, span, line: 3, row: 1, is_half, given_up }
    }

    fn judged(cycles: &[(bool, bool)], expected: Option<bool>, clock: u32) -> RowVerdict {
        let row_hold = RowHold { hold: cycles.len(), needed: 4, rests: vec![true] };
        let row = row(cycles[0].0, expected);
        judge_swarm(&test(), &[row], &[row_hold], &inverter(cycles), &[clock]).remove(0)
    }

    #[test]
    fn an_oscillation_fails_only_where_a_row_asks_for_it() {
        let mut netlist = Netlist::new("ring");
        let a = netlist.add_input("a");
        let wire = netlist.add_wire("q", Some(false), None);
        let ring = netlist.add_gate(Function::NOT, &[wire]);
        netlist.drive(wire, 0, ring);
        let still = netlist.add_gate(Function::NOT, &[a]);
        let passed = |output, expected| {
            let mut netlist = netlist.clone();
            netlist.add_output("y", output);
            judge_logic(&test(), &[row(true, expected)], &mut Settled::new(&netlist)).all(|verdict| verdict.passed)
        };
        assert!(passed(ring, None) && !passed(ring, Some(true)) && !passed(ring, Some(false)));
        assert!(passed(still, Some(false)) && !passed(still, Some(true)), "an output that rests beside the ring");
    }

    fn check(cycles: &[(bool, bool)], expected: Option<bool>, clock: u32, passed: bool, wrong_cycles: &[usize]) {
        let verdict = judged(cycles, expected, clock);
        assert_eq!(verdict.passed, passed);
        let found: Vec<usize> = verdict.wrong_outputs.iter().map(|wrong| wrong.cycle).collect();
        assert_eq!(found, wrong_cycles);
    }

    #[test]
    fn a_row_passes_on_its_last_two_cycles() {
        check(&[(true, true), (true, false), (true, false)], Some(false), 1, true, &[]);
        check(&[(true, false), (true, true), (true, false)], Some(false), 1, false, &[1]);
        // An output without an expected value is not checked, and a robot that has not settled is not to blame.
        check(&[(true, true), (true, true)], None, 1, true, &[]);
        check(&[(true, true), (true, true), (true, true)], Some(false), 3, false, &[2]);
    }

    #[test]
    fn an_output_that_keeps_changing_fails_even_if_it_had_one_value_for_a_while() {
        let (row, trace) = (row(true, Some(false)), inverter(&[(true, false); 3]));
        let passed = |rests: bool| {
            let row_hold = RowHold { hold: 3, needed: 3, rests: vec![rests] };
            let passed = passes(&test(), &row, &row_hold, &trace);
            assert_eq!(judge_swarm(&test(), std::slice::from_ref(&row), &[row_hold], &trace, &[1])[0].passed, passed);
            passed
        };
        assert!(passed(true) && !passed(false));
    }

    #[test]
    fn margins_are_those_of_settled_robots() {
        let mut trace = inverter(&[(false, true), (false, true), (true, true), (true, false)]);
        trace.robots[0].com_x = vec![0.0, 0.5, 0.75, 1.0, 0.5];
        assert_eq!(settled_margins(&trace, &[2], 1), [(1, 0, 0.25), (3, 0, 0.5)]);
        assert_eq!(settled_margins(&trace, &[1], 2)[0], (1, 0, 0.375));
    }

    #[test]
    fn a_robot_without_time_is_late() {
        let late = |cycles: &[(bool, bool)]| judged(cycles, Some(false), 2).late.len();
        assert_eq!(late(&[(false, true), (true, true)]), 1);
        assert_eq!(late(&[(true, true), (true, true)]), 0);
    }
}
