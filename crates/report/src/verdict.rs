//! The verdict of a test or a simulation as text: a truth table and the failures.

use crate::truth_table::{TruthTable, pass_word};
use nbc_base::diag::counted;
use nbc_base::model::NamedWorld;
use nbc_swarm::{RowVerdict, SimulationResult, SwarmTrace, TestVerdict};

const MOST_ROWS: usize = 20;

pub fn describe_test(verdict: &TestVerdict) -> String {
    let of_first_thread = verdict.rows.iter().filter(|row| row.thread.unwrap_or(0) == 0);
    let rows = of_first_thread.map(|row| {
        let is_same = |other: &&RowVerdict| other.thread.is_some() && (other.line, other.row) == (row.line, row.row);
        (row, row.passed && verdict.rows.iter().filter(is_same).all(|other| other.passed))
    });
    let table = TruthTable::of_test(verdict, rows).text();
    let threads = verdict.rows.iter().filter_map(|row| row.thread).max().map_or(0, |last| last + 1);
    let threads = if threads > 1 { format!(" in {threads} threads") } else { String::new() };
    let proof = verdict.proof.as_ref().map_or(String::new(), |proof| format!(", {proof}"));
    let heading = format!("test {}{threads}: {}{proof}\n", name_test(verdict), pass_word(verdict.passed));
    if verdict.proof.is_some() && verdict.rows.is_empty() {
        return heading;
    }
    let robots = describe_weak_robots(verdict);
    let printed = describe_printed(verdict);
    format!("{heading}{printed}{robots}{table}{}", describe_rows(verdict))
}

/// A test with its swarm and its world: `inverter as sliders "inverts" in worn`.
fn name_test(verdict: &TestVerdict) -> String {
    let swarm = verdict.swarm.as_ref().map_or(String::new(), |swarm| format!(" as {swarm}"));
    let title = if verdict.title.is_empty() { String::new() } else { format!(" \"{}\"", verdict.title) };
    format!("{}{swarm}{title}{}", verdict.circuit, named_world(verdict))
}

/// ` in worn`; nothing for the world of the paper unless the test names it, and at the level of logic.
pub(super) fn named_world(verdict: &TestVerdict) -> String {
    match &verdict.world {
        Some(world) if verdict.is_world_named => format!(" in {world}"),
        Some(world) => in_world(world),
        None => String::new(),
    }
}

/// ` in worn`; nothing for the world of the paper.
pub(super) fn in_world(world: &str) -> String {
    if world == NamedWorld::DEFAULT { String::new() } else { format!(" in {world}") }
}

/// The line of a test, with the failures below it: `pass  inverter "inverts" in worn (2 rows, physics)`.
pub fn describe_verdict(verdict: &TestVerdict) -> String {
    let (name, rows, level) = (name_test(verdict), counted_rows(verdict), verdict.level.word());
    let (printed, failures) = (describe_printed(verdict), describe_failures(verdict));
    format!("{}  {name} ({rows}, {level})\n{printed}{failures}", pass_word(verdict.passed))
}

/// `360 rows`, of a test that permits failures `342 of 360 rows, at least 93 %`, or how a test for ever was decided.
fn counted_rows(verdict: &TestVerdict) -> String {
    if let Some(proof) = &verdict.proof {
        return proof.clone();
    }
    let rows = counted(verdict.row_count(), "row");
    let passed = || verdict.rows.iter().filter(|row| row.passed).count();
    verdict.at_least().map_or_else(|| rows.clone(), |percent| format!("{} of {rows}, at least {percent} %", passed()))
}

fn describe_printed(verdict: &TestVerdict) -> String {
    verdict
        .printed
        .iter()
        .flat_map(|printed| printed.lines())
        .map(|line| format!("    > {}\n", line.escape_debug()))
        .collect()
}

/// Empty if the test passed. First the unreliable robots, then each failing row with its place, its columns, and the
/// wrong robots.
fn describe_failures(verdict: &TestVerdict) -> String {
    // A test that permits failures passes with some.
    let rows = if verdict.passed { String::new() } else { describe_rows(verdict) };
    describe_weak_robots(verdict) + &rows
}

pub fn describe_simulation(result: &SimulationResult) -> String {
    let table = TruthTable::of_simulation(result).text();
    let fault = result.fault.as_ref().map_or(String::new(), |fault| format!("    {fault}\n"));
    let world = in_world(&result.world);
    format!("simulate {}, of {}{world}\n{table}{fault}", result.swarm, result.circuit)
}

fn describe_weak_robots(verdict: &TestVerdict) -> String {
    let weak = verdict.weak_robots.iter().filter(|_| !verdict.passed);
    weak.map(|weak| format!("    robot {} on {}: {}\n", weak.robot, weak.nets.join(", "), weak.complaint())).collect()
}

fn describe_rows(verdict: &TestVerdict) -> String {
    let failed = || verdict.rows.iter().filter(|row| !row.passed);
    // After the row in which a robot failed, the others say nothing.
    let told = failed().position(|row| row.fault.is_some()).map_or(usize::MAX, |first| first + 1).min(MOST_ROWS);
    let rows: String = failed().take(told).map(|row| describe_row(verdict, row)).collect();
    match failed().count().saturating_sub(told) {
        0 => rows,
        more => format!("{rows}    {} more failed\n", counted(more, "row")),
    }
}

/// A failing row: `a.nb:12: row 3: a=4'd9 b=0 | q=1, expected 0`.
fn describe_row(verdict: &TestVerdict, row: &RowVerdict) -> String {
    let file = verdict.rows_from.as_ref().map_or(&verdict.file, |from| &from.file);
    let words = row.words.as_deref().unwrap_or_default().replace('\n', "\n    ");
    format!("    {file}:{}: {words}\n", row.line)
}

/// The robots of a swarm, grouped by the gate they play: `4 nand (nand_1), 1 not (not_2)`.
pub fn describe_swarm(trace: &SwarmTrace) -> String {
    let mut groups: Vec<(String, usize)> = Vec::new();
    for robot in &trace.robots {
        let word = format!("{} ({})", robot.function, robot.robot);
        match groups.iter_mut().find(|(known, _)| *known == word) {
            Some((_, count)) => *count += 1,
            None => groups.push((word, 1)),
        }
    }
    let words: Vec<String> = groups.into_iter().map(|(word, count)| format!("{count} {word}")).collect();
    match trace.robots.len() {
        0 => "no robots".to_owned(),
        1 => format!("one robot: {}", words.join(", ")),
        count => format!("{count} robots: {}", words.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::model::{Base, Column, RowSource, Value};
    use nbc_swarm::{Level, WeakRobot, WrongOutput};

    fn port(name: &str, width: usize) -> Column {
        Column::new(name, width)
    }

    fn bits(bits: &[Option<bool>]) -> Vec<Value> {
        bits.iter().map(|&bit| Value { bits: vec![bit], base: Base::Bits, members: None }).collect()
    }

    fn verdict(passed: bool) -> TestVerdict {
        let wrong = WrongOutput {
            net: "q".to_owned(),
            robot: "nand_1".to_owned(),
            cycle: 4,
            sensed: vec![true, false],
            output: false,
        };
        TestVerdict {
            file: "latch.nb".to_owned(),
            line: 1,
            title: "holds".to_owned(),
            circuit: "latch".to_owned(),
            world: Some("paper".to_owned()),
            level: Level::Physics,
            inputs: vec![port("d", 1), port("en", 1)],
            outputs: vec![port("q", 1), port("nq", 1)],
            rows: vec![RowVerdict {
                row: 2,
                line: 7,
                cycles: Some(12),
                needed: Some(14),
                inputs: bits(&[Some(true), Some(false)]),
                expected: bits(&[Some(true), None]),
                observed: bits(&[Some(passed), Some(false)]),
                steady: vec![true, true],
                passed,
                wrong_outputs: if passed { vec![] } else { vec![wrong] },
                ..RowVerdict::default()
            }],
            passed,
            ..TestVerdict::default()
        }
    }

    fn told(mut verdict: TestVerdict) -> String {
        let TestVerdict { inputs, outputs, rows, .. } = &mut verdict;
        rows.iter_mut().for_each(|row| row.words = Some(row.describe(inputs, outputs)));
        describe_test(&verdict) + &describe_verdict(&verdict)
    }

    #[test]
    fn a_test_is_a_truth_table() {
        assert_eq!(
            describe_test(&verdict(true)),
            "test latch \"holds\": pass\n    inputs  expected  observed  cycles\n    d en    q nq      q nq\n    1 \
             0     1 -       1 0           12  pass\n"
        );
    }

    #[test]
    fn a_test_without_a_title_has_none() {
        let untitled = TestVerdict { title: String::new(), swarm: Some("cells".to_owned()), ..verdict(true) };
        assert!(describe_test(&untitled).starts_with("test latch as cells: pass\n"));
    }

    #[test]
    fn a_test_that_permits_failures_counts_the_rows_that_passed() {
        let from = |at_least| Some(RowSource { file: "rows.csv".to_owned(), at_least });
        let mut verdict = TestVerdict { rows_from: from(Some(99.5)), ..verdict(false) };
        verdict.rows[0].wrong_outputs.clear();
        let text = told(verdict.clone());
        assert!(text.contains("\nFAIL  latch \"holds\" (0 of 1 row, at least 99.5 %, physics)\n"), "{text}");
        assert!(text.contains("    rows.csv:7: row 2: d=1 en=0 | q=0, expected 1\n"), "{text}");
        verdict.passed = true;
        verdict.rows_from = from(Some(0.0));
        assert_eq!(describe_verdict(&verdict), "pass  latch \"holds\" (0 of 1 row, at least 0 %, physics)\n");
    }

    #[test]
    fn a_failure_without_a_wrong_robot_blames_the_hold_or_the_circuit() {
        let mut verdict = verdict(false);
        verdict.rows[0].late = std::mem::take(&mut verdict.rows[0].wrong_outputs);
        let text = told(verdict.clone());
        assert!(text.contains("robot nand_1 on net q had not settled yet and output 0 on stimuli 1 0\n"), "{text}");
        assert!(text.ends_with("    nearest fix: hold the row for 14 cycles, as `hold: auto` does\n"), "{text}");
        verdict.rows[0].cycles = Some(14);
        let text = told(verdict);
        assert!(text.ends_with("so correct the circuit or the test\n"), "{text}");
    }

    #[test]
    fn a_bus_is_one_value_in_its_notation() {
        let decimal = |number: u8| Value {
            bits: (0..4).rev().map(|b| Some(number >> b & 1 == 1)).collect(),
            base: Base::Decimal,
            members: None,
        };
        let mut verdict = verdict(false);
        verdict.outputs = vec![port("sum", 4)];
        let row = &mut verdict.rows[0];
        (row.expected, row.observed, row.steady, row.wrong_outputs) =
            (vec![decimal(9)], vec![decimal(11)], vec![true], Vec::new());
        let text = told(verdict.clone());
        assert!(text.contains("1 0     4'd9      4'd11         12  FAIL"), "{text}");
        assert!(text.contains("row 2: d=1 en=0 | sum=4'd11, expected 4'd9\n"), "{text}");
        verdict.rows[0].steady = vec![false];
        assert!(told(verdict).contains("| sum keeps changing, expected 4'd9\n"));
    }

    #[test]
    fn a_weak_robot_is_reported_first_if_a_test_failed() {
        let weak = WeakRobot { robot: "nand_9".to_owned(), nets: vec!["q".to_owned()], error_rate: 0.43, margin: -1.0 };
        let told = |passed| {
            let failed = describe_failures(&TestVerdict { weak_robots: vec![weak.clone()], ..verdict(passed) });
            failed.lines().next().map(str::to_owned)
        };
        assert_eq!(told(false).as_deref(), Some("    robot nand_9 on q: wrong in 43.0 % of its measured switches"));
        assert_eq!(told(true), None);
    }
}
