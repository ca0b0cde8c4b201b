//! `nbc test`: a file's tests, at the level of logic or in full physics.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::circuit::{Logic, Netlist, elaborate};
use crate::cli::{Context, Failure, Format, Progress, Status};
use crate::diag::{Code, Diagnostic, render};
use crate::model::{CircuitTest, Column, Program, TestRow};
use crate::pipeline::{self, Compiled, Loaded, Options};
use crate::report;
use crate::store::DiskWorld;

/// Swarms of as many robots or more are tested at the level of logic unless physics is asked for.
const LARGE: usize = 40;

/// Circuits of as many gates are not compiled to find out: no library makes them of fewer than [`LARGE`] robots.
const SURELY_LARGE: usize = 10 * LARGE;

/// Test the circuits of a file
#[derive(Args)]
#[command(after_help = "Examples:
  nbc test circuits/counter.nb
  nbc test circuits/latch.nb --logic
  nbc test circuits/latch.nb --physics

At the level of logic every cell takes one time step, and a row is held until nothing changes. In physics every robot is simulated voxel \
by voxel. By default circuits of fewer than 40 robots are tested in physics, larger ones at the level of logic.
Exit status: 0 every test passed, 1 a test failed, 2 the file has errors.")]
pub struct Arguments {
    /// The source files
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Test at the level of logic
    #[arg(long, conflicts_with = "physics")]
    logic: bool,
    /// Test in full physics
    #[arg(long)]
    physics: bool,
}

/// What came of a test.
#[derive(Serialize)]
struct Outcome {
    file: String,
    circuit: String,
    title: String,
    level: &'static str,
    passed: bool,
    rows: usize,
    #[serde(skip)]
    failures: String,
    #[serde(skip)]
    warnings: Vec<Diagnostic>,
}

impl Arguments {
    /// Runs the tests and prints what came of them.
    ///
    /// # Errors
    /// When a file has errors, or declares no test.
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let mut outcomes = Vec::new();
        for file in &self.files {
            outcomes.extend(self.test_file(&file.to_string_lossy(), context)?);
        }
        let passed = outcomes.iter().all(|outcome| outcome.passed);
        match context.format {
            Format::Json => context.print_json(&serde_json::json!({ "passed": passed, "tests": outcomes }))?,
            Format::Text => {
                for outcome in &outcomes {
                    context.print(describe(outcome))?;
                }
                let failed = outcomes.iter().filter(|outcome| !outcome.passed).count();
                context.print(format_args!("{} passed, {failed} failed\n", outcomes.len() - failed))?;
            }
        }
        Ok(if passed { Status::Done } else { Status::TestFailed })
    }

    fn test_file(&self, path: &str, context: &mut Context) -> Result<Vec<Outcome>, Failure> {
        let Loaded { sources, checked } = pipeline::load(&DiskWorld, path);
        if checked.has_errors() {
            return Err(Failure::input(checked.diagnostics, sources));
        }
        if checked.program.tests.is_empty() {
            let fault = Diagnostic::without_place(Code::Empty, format!("`{path}` declares no test"));
            let help = "declare one: `test my_circuit { a b | q` and a row for each input pattern";
            return Err(Failure::plain(fault.with_help(help)));
        }
        context.log(&render::text(&checked.diagnostics, &sources, context.color));
        let mut outcomes = Vec::new();
        for test in &checked.program.tests {
            match self.test(path, &checked.program, test) {
                Ok(outcome) => {
                    context.log(&render::text(&outcome.warnings, &sources, context.color));
                    outcomes.push(outcome);
                }
                Err(faults) => return Err(Failure::input(faults, sources)),
            }
        }
        Ok(outcomes)
    }

    fn test(&self, path: &str, program: &Program, test: &CircuitTest) -> Result<Outcome, Vec<Diagnostic>> {
        let netlist = elaborate(program, &test.circuit)?;
        let rows = pipeline::rows(program, test)?;
        let swarm = self.swarm(program, test, &netlist)?;
        let level = if swarm.is_some() { "physics" } else { "logic" };
        let (failures, warnings) = match swarm {
            Some(compiled) => in_physics(program, test, compiled)?,
            None => (in_logic(&netlist, test, &rows), Vec::new()),
        };
        Ok(Outcome {
            file: path.to_owned(),
            circuit: test.circuit.to_string(),
            title: test.title.clone(),
            level,
            passed: failures.is_empty(),
            rows: rows.len(),
            failures,
            warnings,
        })
    }

    /// The swarm to be tested in physics; nothing where the test is to be at the level of logic.
    fn swarm(
        &self,
        program: &Program,
        test: &CircuitTest,
        netlist: &Netlist,
    ) -> Result<Option<Compiled>, Vec<Diagnostic>> {
        if self.logic || (!self.physics && netlist.cells().count() >= SURELY_LARGE) {
            return Ok(None);
        }
        let compiled = pipeline::compile_test(program, test, &Options::default())?;
        Ok(Some(compiled).filter(|compiled| self.physics || compiled.assembly.members.len() < LARGE))
    }
}

/// What went wrong with the robots, nothing where all went well; and what is legal and surely not meant.
fn in_physics(
    program: &Program,
    test: &CircuitTest,
    compiled: Compiled,
) -> Result<(String, Vec<Diagnostic>), Vec<Diagnostic>> {
    let bar = Progress::new("simulating", 0);
    let run = pipeline::simulate_test(program, test, compiled, &Options::default(), &mut |done, all| {
        bar.set_total(all as u64);
        bar.set(done as u64);
    })?;
    let failures = if run.verdict.passed { String::new() } else { report::describe_test(&run.verdict) };
    Ok((failures, run.warnings))
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

fn describe(outcome: &Outcome) -> String {
    let verdict = if outcome.passed { "pass" } else { "FAIL" };
    let title = if outcome.title.is_empty() { String::new() } else { format!(" \"{}\"", outcome.title) };
    format!("{verdict}  {}{title} ({} rows, {})\n{}", outcome.circuit, outcome.rows, outcome.level, outcome.failures)
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
