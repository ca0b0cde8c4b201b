//! The work of a command, and its result.

use crate::runs::order::{RunOrder, RunTask};
use crate::runs::watcher::{RunOutcome, Watcher};
use crate::shell::LanguageShell;
use crate::wording::{self, RequestError};
use nbc_base::diag::Diagnostics;
use nbc_base::model::Claim;
use nbc_base::source::SharedWorld;
use nbc_circuit::properties::SearchBudget;
use nbc_session::report::{self, Scheme};
use nbc_session::{Checked, Choice, CompileOptions, Compiled, Observer, RunList, RunReport, Session, TestOptions};
use nbc_swarm::{Level, Room};

pub(super) fn perform(
    world: SharedWorld,
    checked: &Checked,
    order: &RunOrder,
    shell: &dyn LanguageShell,
    watcher: &mut Watcher,
) -> Result<RunOutcome, RequestError> {
    if checked.has_errors() {
        return Err(wording::source_errors());
    }
    match &order.task {
        RunTask::Run { level, test, simulation } => {
            let session = Session::new(world.clone()).with_poses(Room::SWARM);
            let report = run(&session, checked, *level, (*test, *simulation), watcher)?;
            finish(checked, *level, &report, shell, &world)
        }
        RunTask::Prove(claim) => prove(checked, *claim, watcher, &world),
        RunTask::Schematic(choice) => {
            let compiled = compile(checked, choice, watcher)?;
            let picture = compiled.schematic(Scheme::default()).top();
            let path = written(checked, shell, "schematic.svg", &picture.finish())?;
            Ok(RunOutcome::new(None, "schematic".to_owned(), Some(path), &world))
        }
        RunTask::Timing(choice) => {
            let timing = compile(checked, choice, watcher)?.swarm_timing();
            Ok(RunOutcome::new(None, timing.describe(), None, &world))
        }
    }
}

fn compile(checked: &Checked, choice: &Choice, watcher: &Watcher) -> Result<Compiled, RequestError> {
    let circuit = checked.circuit(choice).map_err(|faults| said(&faults))?;
    let first = || checked.swarms(&circuit).first().map(|swarm| swarm.name.clone());
    let swarm = choice.swarm.clone().or_else(first);
    let options = CompileOptions { swarm, ..options(watcher) };
    let compiled = checked.compile(&circuit, &options).map_err(|faults| said(&faults))?;
    going(watcher).map(|()| compiled)
}

fn run(
    session: &Session,
    checked: &Checked,
    level: Level,
    (test, simulation): (Option<usize>, Option<usize>),
    watcher: &mut Watcher,
) -> Result<RunReport, RequestError> {
    let program = &checked.program;
    let is_chosen = |chosen: Option<usize>, at: usize| match (test, simulation) {
        (None, None) => true,
        _ => chosen == Some(at),
    };
    let tests = program.tests.iter().enumerate().filter(|(at, _)| is_chosen(test, *at)).map(|(_, test)| test);
    let simulations = program.simulations.iter().enumerate().filter(|(at, _)| is_chosen(simulation, *at));
    let simulations = simulations.filter(|_| level == Level::Physics).map(|(_, simulation)| simulation);
    let list = RunList { tests: tests.collect(), simulations: simulations.collect() };
    if list.is_empty() {
        return Err(wording::nothing_to_run());
    }
    let options = TestOptions { level: Some(level), compile: options(watcher) };
    let report = session.run_list(checked, &list, &options, watcher).map_err(|faults| said(&faults))?;
    going(watcher).map(|()| report)
}

fn prove(
    checked: &Checked,
    claim: Option<usize>,
    watcher: &mut Watcher,
    world: &SharedWorld,
) -> Result<RunOutcome, RequestError> {
    let claims = checked.program.claims.iter().enumerate().filter(|(at, _)| claim.is_none_or(|claim| claim == *at));
    let claims: Vec<&Claim> = claims.map(|(_, claim)| claim).collect();
    let (mut proved, mut text) = (!claims.is_empty(), String::new());
    for (part, claim) in claims.iter().enumerate() {
        watcher.begin(part, claims.len());
        let search = checked.prove(claim, SearchBudget::SHORT, watcher.stop.clone());
        let mut search = search.map_err(|faults| said(&faults))?;
        while search.advance(watcher) {}
        going(watcher)?;
        let decided = search.finish();
        proved &= decided.count("proved") == decided.properties.len();
        text += &decided.text();
    }
    if claims.is_empty() {
        Err(wording::nothing_to_run())
    } else {
        Ok(RunOutcome::new(Some(proved), text, None, world))
    }
}

/// Compiling ends early when the run is stopped.
fn options(watcher: &Watcher) -> CompileOptions {
    CompileOptions { cancel: watcher.stop.clone(), ..CompileOptions::default() }
}

fn going(watcher: &Watcher) -> Result<(), RequestError> {
    if watcher.stop.is_raised() { Err(wording::cancelled()) } else { Ok(()) }
}

fn finish(
    checked: &Checked,
    level: Level,
    report: &RunReport,
    shell: &dyn LanguageShell,
    world: &SharedWorld,
) -> Result<RunOutcome, RequestError> {
    let verdicts: Vec<_> = report.tests.iter().map(|run| &run.verdict).collect();
    let source = checked.path.rsplit('/').next().unwrap_or_default();
    let page = match level {
        Level::Physics => report.page(source, Scheme::default()),
        Level::Logic => report::draw_logic_page(source, &verdicts),
    };
    let path = written(checked, shell, "report.html", &page)?;
    let passed = verdicts.iter().filter(|verdict| verdict.passed).count();
    let word = if report.passed() { "pass" } else { "FAIL" };
    let text = match (verdicts.len(), report.fault()) {
        (0, None) => "simulated".to_owned(),
        (0, Some(fault)) => format!("{word}: {fault}"),
        (all, None) => format!("{word}: {passed} of {all} passed"),
        (all, Some(fault)) => format!("{word}: {passed} of {all} passed; {fault}"),
    };
    let has_verdict = !verdicts.is_empty() || report.fault().is_some();
    Ok(RunOutcome::new(has_verdict.then(|| report.passed()), text, Some(path), world))
}

fn written(checked: &Checked, shell: &dyn LanguageShell, name: &str, text: &str) -> Result<String, RequestError> {
    let source = checked.path.rsplit('/').next().unwrap_or_default();
    let folder: String = source.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
    shell.write_result(&folder, name, text).map_err(wording::failed)
}

fn said(faults: &Diagnostics) -> RequestError {
    wording::failed(faults.list.first().map_or("", |fault| &fault.message))
}
