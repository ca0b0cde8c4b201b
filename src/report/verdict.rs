//! What a test came to, as a truth table for people.

use crate::report::{Align, Table};
use crate::swarm::{Lapse, RowVerdict, SwarmTrace, TestVerdict};

/// A test's truth table with expected and observed outputs for every row, and the robots to blame where a row failed.
pub fn describe_test(verdict: &TestVerdict) -> String {
    use Align::{Left, Right};
    let mut table =
        Table::new(&[("inputs", Left), ("expected", Left), ("observed", Left), ("cycles", Right), ("", Left)]);
    let (inputs, outputs) = (verdict.inputs.join(" "), verdict.outputs.join(" "));
    table.push(vec![inputs, outputs.clone(), outputs, String::new(), String::new()]);
    for row in &verdict.rows {
        let some = |bits: &[bool]| bits.iter().map(|&bit| Some(bit)).collect::<Vec<_>>();
        table.push(vec![
            align_bits(&some(&row.inputs), &verdict.inputs),
            align_bits(&row.expected, &verdict.outputs),
            align_bits(&some(&row.observed), &verdict.outputs),
            row.hold.to_string(),
            pass_word(row.passed).to_owned(),
        ]);
    }
    let table = table.to_string().lines().map(|line| format!("    {line}\n")).collect::<String>();
    let blame: String = verdict.rows.iter().flat_map(describe_lapses).collect();
    format!("test {} \"{}\": {}\n{table}{blame}", verdict.circuit, verdict.title, pass_word(verdict.passed))
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

fn pass_word(passed: bool) -> &'static str {
    if passed { "pass" } else { "FAIL" }
}

/// Bits below the names of their ports; `-` where nothing is asked.
fn align_bits(bits: &[Option<bool>], names: &[String]) -> String {
    let digit = |bit: &Option<bool>| bit.map_or("-", |bit| if bit { "1" } else { "0" });
    let cells =
        bits.iter().zip(names).map(|(bit, name)| format!("{:<width$}", digit(bit), width = name.chars().count()));
    cells.collect::<Vec<_>>().join(" ").trim_end().to_owned()
}

fn describe_lapses(row: &RowVerdict) -> Vec<String> {
    let wrong = row.lapses.iter().map(|lapse| describe_lapse(lapse, "output"));
    let late = row.late.iter().map(|lapse| describe_lapse(lapse, "had no time yet and still output"));
    wrong.chain(late).chain(nearest_fix(row)).collect()
}

fn describe_lapse(lapse: &Lapse, did: &str) -> String {
    let Lapse { net, robot, cycle, .. } = lapse;
    let [first, second] = lapse.sensed.map(u8::from);
    let (cycle, output) = (cycle + 1, u8::from(lapse.output));
    format!("    cycle {cycle}: robot {robot} on net {net} {did} {output} on stimuli {first} {second}\n")
}

/// What would most likely mend a row: robots that were wrong though they had time are to be replaced, else time was short, else the
/// circuit itself answers so.
fn nearest_fix(row: &RowVerdict) -> Option<String> {
    let fix = match row.lapses.first() {
        _ if row.passed => return None,
        Some(Lapse { net, robot, .. }) => format!("another robot than {robot} on net {net}, or a longer hold"),
        None if row.hold < row.needed => format!("hold the row for {} cycles, as `hold: auto` does", row.needed),
        None => "every robot did as its gate does, so mend the circuit or the test".to_owned(),
    };
    Some(format!("    nearest fix: {fix}\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(passed: bool) -> TestVerdict {
        let lapse =
            Lapse { net: "q".to_owned(), robot: "nand_1".to_owned(), cycle: 4, sensed: [true, false], output: false };
        TestVerdict {
            title: "holds".to_owned(),
            circuit: "latch".to_owned(),
            inputs: vec!["d".to_owned(), "en".to_owned()],
            outputs: vec!["q".to_owned(), "nq".to_owned()],
            rows: vec![RowVerdict {
                hold: 12,
                needed: 14,
                inputs: vec![true, false],
                expected: vec![Some(true), None],
                observed: vec![passed, false],
                passed,
                lapses: if passed { vec![] } else { vec![lapse] },
                late: vec![],
            }],
            passed,
        }
    }

    #[test]
    fn a_test_is_a_truth_table() {
        assert_eq!(
            describe_test(&verdict(true)),
            "test latch \"holds\": pass\n    inputs  expected  observed  cycles\n    d en    q nq      q nq\n    1 0     1 -       1 0           12  pass\n"
        );
    }

    #[test]
    fn a_failure_names_the_robot() {
        let text = describe_test(&verdict(false));
        assert!(text.contains("1 0     1 -       0 0           12  FAIL"), "{text}");
        assert!(text.contains("    cycle 5: robot nand_1 on net q output 0 on stimuli 1 0\n"), "{text}");
        assert!(text.ends_with("    nearest fix: another robot than nand_1 on net q, or a longer hold\n"), "{text}");
    }

    #[test]
    fn a_failure_without_a_wrong_robot_is_a_matter_of_time_or_of_the_circuit() {
        let mut verdict = verdict(false);
        verdict.rows[0].late = std::mem::take(&mut verdict.rows[0].lapses);
        let text = describe_test(&verdict);
        assert!(text.contains("robot nand_1 on net q had no time yet and still output 0 on stimuli 1 0\n"), "{text}");
        assert!(text.ends_with("    nearest fix: hold the row for 14 cycles, as `hold: auto` does\n"), "{text}");
        verdict.rows[0].hold = 14;
        let text = describe_test(&verdict);
        assert!(text.ends_with("so mend the circuit or the test\n"), "{text}");
    }
}
