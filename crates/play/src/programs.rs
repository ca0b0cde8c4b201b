//! Programs for a page: their description as JSON, and compiling and testing their circuits.

use serde_json::{Value, json};

use crate::history::FRAMES;
use crate::jobs::{Job, JobEnd};
use crate::refusal::Refused;
use crate::runner::LoadedSwarm;
use crate::served::SCHEME;
use nbc_base::model::{CircuitTest, Instance, Stimulation, TestRow, Value as PortValue};
use nbc_circuit::Effort;
use nbc_session::report::{self, Looks};
use nbc_session::{Checked, Choice, CompileOptions, Compiled, Session, TestOptions};
use nbc_swarm::{Level, LiveSwarm};

/// The most robots of a live swarm.
pub(super) const MOST_ROBOTS: usize = 2000;

/// The description of a checked program: its diagnostics, circuits and tests.
pub(super) fn program(checked: &Checked) -> Value {
    let own = checked.program.circuits.iter().filter(|circuit| Some(circuit.span.file) == checked.file);
    let circuits: Vec<Value> = own
        .filter_map(|circuit| {
            let instance = checked.in_use(circuit)?;
            let swarms: Vec<&str> = checked.swarms(&instance).iter().map(|swarm| swarm.name.as_str()).collect();
            let line = checked.sources.file(circuit.span.file).lines().line(circuit.span.start as usize) + 1;
            Some(json!({ "name": circuit.name, "circuit": instance.to_string(), "swarms": swarms, "line": line }))
        })
        .collect();
    let tests: Vec<Value> = checked.program.tests.iter().enumerate().map(|(i, one)| test(i, one)).collect();
    json!({
        "errors": checked.diagnostics.iter().filter(|found| found.is_error()).count(),
        "diagnostics": checked.json(),
        "circuits": circuits,
        "tests": tests,
    })
}

fn test(index: usize, test: &CircuitTest) -> Value {
    let rows = match &test.stimulation {
        Stimulation::Rows(rows) => rows.iter().map(|one| row(test, one)).collect(),
        Stimulation::All { .. } => Vec::new(),
    };
    json!({
        "index": index,
        "circuit": test.circuit.to_string(),
        "title": test.title,
        "line": test.line,
        "inputs": test.inputs,
        "outputs": test.outputs,
        "rows": rows,
    })
}

fn row(test: &CircuitTest, row: &TestRow) -> Value {
    let texts = |values: Vec<PortValue>| values.iter().map(PortValue::to_string).collect::<Vec<_>>();
    let (inputs, outputs) = row.bases.split_at(test.inputs.len().min(row.bases.len()));
    json!({
        "row": row.row,
        "line": row.line,
        "inputs": texts(PortValue::of_ports(&test.inputs, row.inputs.iter().copied().map(Some), inputs)),
        "outputs": texts(PortValue::of_ports(&test.outputs, row.expected.iter().copied(), outputs)),
    })
}

/// The circuit of that name, and the options to compile it with.
///
/// # Errors
/// When there is no such circuit.
pub(super) fn chosen(checked: &Checked, choice: &Choice, job: &Job) -> Result<(Instance, CompileOptions), Refused> {
    let circuit = checked.circuit(choice)?;
    let first = || checked.swarms(&circuit).first().map(|swarm| swarm.name.clone());
    let swarm = choice.swarm.clone().or_else(first);
    let options = CompileOptions { swarm, effort: Effort::Normal, cancel: job.stop.clone(), ..Default::default() };
    Ok((circuit, options))
}

/// A compiled circuit as a swarm to run.
///
/// # Errors
/// When it has too many robots.
pub(super) fn loaded(
    session: &Session,
    compiled: Compiled,
    inputs: Vec<Vec<bool>>,
    (number, job): (u32, &Job),
) -> Result<LoadedSwarm, Refused> {
    job.check()?;
    let robots = compiled.assembly.members.len();
    if robots > MOST_ROBOTS {
        return Err(Refused::TooManyRobots { robots, most: MOST_ROBOTS });
    }
    let swarm = session.swarm(&compiled);
    let answer = json!({ "swarm": describe(number, &compiled, &swarm) });
    Ok(LoadedSwarm { number, compiled, swarm, inputs, request: job.id, answer, stop: job.stop.clone() })
}

fn describe(number: u32, compiled: &Compiled, swarm: &LiveSwarm) -> Value {
    let (assembly, trace) = (&compiled.assembly, swarm.trace());
    let looks = Looks::of(assembly.members.iter().map(|member| &member.robot.body), SCHEME);
    json!({
        "number": number,
        "circuit": compiled.plan.circuit.to_string(),
        "swarm": compiled.plan.swarm,
        "inputs": assembly.inputs,
        "outputs": assembly.outputs,
        "shown": assembly.shown,
        "robots": report::live_robots(trace, assembly, &looks),
        "looks": report::look_data(&looks),
        "schematic": report::embedded(&compiled.schematic(SCHEME)),
        "timing": compiled.swarm_timing().describe(),
        "hold": compiled.timing.hold,
        "start": assembly.start_cycles(),
        "frames": FRAMES,
    })
}

/// Runs a test.
///
/// # Errors
/// When its circuit cannot be compiled, or it was stopped.
pub(super) fn run_test(session: &Session, checked: &Checked, test: usize, level: Level, job: &mut Job) -> JobEnd {
    let test = checked.program.tests.get(test).ok_or(Refused::NoTest)?;
    let compile = CompileOptions { cancel: job.stop.clone(), ..CompileOptions::default() };
    let runs = session.test(checked, test, &TestOptions { level: Some(level), compile }, job)?;
    if job.stop.is_raised() {
        return Err(Refused::Cancelled);
    }
    Ok(Some(json!({ "results": runs.iter().map(|run| &run.verdict).collect::<Vec<_>>() })))
}

/// The circuit of a test, and the inputs of each cycle up to the end of a row.
///
/// # Errors
/// When there is no such test or row, or its circuit cannot be compiled.
pub(super) fn until_row(
    session: &Session,
    checked: &Checked,
    (test, swarm, row): (usize, Option<&str>, usize),
    job: &Job,
) -> Result<(Compiled, Vec<Vec<bool>>), Refused> {
    let test = checked.program.tests.get(test).ok_or(Refused::NoTest)?;
    let compile = CompileOptions { cancel: job.stop.clone(), ..CompileOptions::default() };
    let cases = session.cases(checked, test, &TestOptions { level: Some(Level::Physics), compile })?;
    let meant = cases.into_iter().find(|case| swarm.is_none() || case.swarm() == swarm).ok_or(Refused::NoTest)?;
    let rows = meant.rows().iter().take_while(|one| one.row <= row).count();
    meant.into_physics(rows).filter(|_| rows > 0).ok_or(Refused::NoTest)
}
