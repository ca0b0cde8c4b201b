//! A test that is ready to run: nothing about it can be at fault any more.

use crate::circuit::{Logic, Netlist, elaborate};
use crate::cli::test::outcome::Outcome;
use crate::diag::Diagnostic;
use crate::model::{CircuitTest, Column, Program, TestRow};
use crate::pipeline::{self, Compiled, Options};
use crate::report;

/// Swarms of as many robots or more are tested at the level of logic unless physics is asked for.
const LARGE: usize = 40;

/// Circuits of as many gates are not compiled to find out: no library makes them of fewer than [`LARGE`] robots.
const SURELY_LARGE: usize = 10 * LARGE;

/// What a test is run on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Level {
    /// Robots where they are few, else gates.
    Auto,
    /// Gates.
    Logic,
    /// Robots.
    Physics,
}

/// A test that is ready to run.
pub(super) struct Case<'a> {
    /// The number of its file on the command line.
    pub(super) file: usize,
    program: &'a Program,
    test: &'a CircuitTest,
    rows: Vec<TestRow>,
    subject: Subject,
}

/// What is tested.
enum Subject {
    Gates(Netlist),
    Robots(Box<Compiled>),
}

impl<'a> Case<'a> {
    /// Makes a test of a file ready.
    ///
    /// # Errors
    /// When its circuit cannot be built or compiled, or it has too many rows.
    pub(super) fn new(
        file: usize,
        program: &'a Program,
        test: &'a CircuitTest,
        level: Level,
    ) -> Result<Self, Vec<Diagnostic>> {
        let netlist = elaborate(program, &test.circuit)?;
        let rows = pipeline::rows(program, test)?;
        let subject = match swarm(program, test, &netlist, level)? {
            Some(compiled) => Subject::Robots(Box::new(compiled)),
            None => Subject::Gates(netlist),
        };
        Ok(Self { file, program, test, rows, subject })
    }

    /// How much there is to do: cycles in physics, rows at the level of logic.
    pub(super) fn work(&self) -> u64 {
        match &self.subject {
            Subject::Gates(_) => self.rows.len() as u64,
            Subject::Robots(compiled) => {
                let protocol = pipeline::protocol(self.program, self.test);
                let demands = pipeline::demands(&self.rows, protocol, &compiled.timing);
                demands.iter().map(|demand| demand.hold as u64).sum()
            }
        }
    }

    /// Runs the test, telling `observe` of work that is done.
    pub(super) fn run(&self, file: &str, observe: &dyn Fn(u64)) -> Outcome {
        let (level, failures, warnings) = match &self.subject {
            Subject::Gates(netlist) => {
                let failures = in_logic(netlist, self.test, &self.rows);
                observe(self.rows.len() as u64);
                ("logic", failures, Vec::new())
            }
            Subject::Robots(compiled) => {
                let (failures, warnings) = self.in_physics(compiled.as_ref().clone(), observe);
                ("physics", failures, warnings)
            }
        };
        Outcome {
            file: file.to_owned(),
            circuit: self.test.circuit.to_string(),
            title: self.test.title.clone(),
            level,
            passed: failures.is_empty(),
            rows: self.rows.len(),
            failures,
            warnings,
        }
    }

    /// What went wrong with the robots, nothing where all went well; and what is legal and surely not meant.
    fn in_physics(&self, compiled: Compiled, observe: &dyn Fn(u64)) -> (String, Vec<Diagnostic>) {
        let mut observe = |_, _| observe(1);
        let run = pipeline::simulate_test(self.program, self.test, compiled, &Options::default(), &mut observe)
            .expect("the rows were made once already");
        let failures = if run.verdict.passed { String::new() } else { report::describe_test(&run.verdict) };
        (failures, run.warnings)
    }
}

/// The swarm to be tested in physics; nothing where the test is to be at the level of logic.
fn swarm(
    program: &Program,
    test: &CircuitTest,
    netlist: &Netlist,
    level: Level,
) -> Result<Option<Compiled>, Vec<Diagnostic>> {
    if level == Level::Logic || (level == Level::Auto && netlist.cells().count() >= SURELY_LARGE) {
        return Ok(None);
    }
    let compiled = pipeline::compile_test(program, test, &Options::default())?;
    Ok(Some(compiled).filter(|compiled| level == Level::Physics || compiled.assembly.members.len() < LARGE))
}

/// The rows whose outputs are wrong, as text.
fn in_logic(netlist: &Netlist, test: &CircuitTest, rows: &[TestRow]) -> String {
    let mut logic = Logic::new(netlist);
    let mut failures = String::new();
    for (number, row) in rows.iter().enumerate() {
        let settled = logic.settle(&row.inputs);
        let found = match &settled {
            Ok(found) if fits(row, found) => continue,
            Ok(found) => bits(&test.outputs, &found.iter().copied().map(Some).collect::<Vec<_>>()),
            Err(restless) => restless.to_string(),
        };
        let inputs = bits(&test.inputs, &row.inputs.iter().copied().map(Some).collect::<Vec<_>>());
        let expected = bits(&test.outputs, &row.expected);
        failures += &format!("    row {}: {inputs} | expected {expected}, found {found}\n", number + 1);
    }
    failures
}

fn fits(row: &TestRow, found: &[bool]) -> bool {
    row.expected.iter().zip(found).all(|(expected, found)| expected.is_none_or(|expected| expected == *found))
}

/// Bits as a row of a test, a word for each port.
fn bits(columns: &[Column], values: &[Option<bool>]) -> String {
    let mut values = values.iter().map(|value| value.map_or('-', |value| if value { '1' } else { '0' }));
    let words: Vec<String> = columns.iter().map(|column| values.by_ref().take(column.width).collect()).collect();
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_shown_as_words() {
        let columns = [Column { name: "a".to_owned(), width: 2 }, Column { name: "b".to_owned(), width: 1 }];
        assert_eq!(bits(&columns, &[Some(true), Some(false), None]), "10 -");
    }
}
