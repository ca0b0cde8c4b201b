//! Programs for a page: their description as JSON, and compiling and testing their circuits.

use std::iter;
use std::sync::Arc;

use crate::history::FRAMES;
use crate::jobs::{Job, JobWork, PortionEnd};
use crate::message::{
    CircuitEntry, ProgramReport, RequestResult, ShownSwarm, ShownWaves, SwarmAnswer, SwarmRobot, TestAnswer, TestEntry,
    TestRowEntry, WaveRegister, WrittenProgram, listed,
};
use crate::refusal::Refused;
use crate::runner::{LoadingSwarm, RunningSwarm};
use crate::script::{GivenInputs, chosen_test};
use crate::shared_cycle::SharedCycles;
use crate::shell::Shell;
use crate::site::SCHEME;
use crate::state;
use nbc_base::budget::Limit;
use nbc_base::diag::counted;
use nbc_base::model::{CircuitTest, GroundProfile, Instance, Stimulation, TestRow, Value as PortValue};
use nbc_circuit::properties::SearchBudget;
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{NetId, Netlist};
use nbc_session::report::{self, Looks};
use nbc_session::{Checked, Choice, CompileOptions, Compiled, Session, TestOptions};
use nbc_swarm::{Assembly, Level, LiveSwarm, Recorded, StimulusSource, SwarmTrace, TestVerdict};

pub(super) fn program(checked: &Checked) -> ProgramReport {
    let own = checked.program.circuits.iter().filter_map(|circuit| {
        let swarms = checked.program.swarms.iter().filter(|swarm| swarm.circuit.circuit == circuit.name);
        let mut places = iter::once(circuit.span).chain(swarms.map(|swarm| swarm.span));
        Some((circuit, places.find(|place| Some(place.file) == checked.file)?))
    });
    let circuits = own.filter_map(|(circuit, place)| {
        let instance = checked.in_use(circuit)?;
        let swarms = checked.swarms(&instance).iter().map(|swarm| swarm.name.clone()).collect();
        let line = checked.sources.file(place.file).lines().line(place.start as usize) + 1;
        Some(CircuitEntry { name: circuit.name.clone(), circuit: instance.to_string(), swarms, line })
    });
    ProgramReport {
        errors: checked.diagnostics.iter().filter(|found| found.is_error()).count(),
        diagnostics: checked.findings(),
        circuits: circuits.collect(),
        tests: checked.program.tests.iter().enumerate().map(|(i, one)| test(i, one)).collect(),
        claims: checked.program.claims.clone(),
        written: checked
            .file
            .map_or_else(WrittenProgram::default, |file| WrittenProgram::of(&checked.sources.file(file).text)),
    }
}

fn test(index: usize, test: &CircuitTest) -> TestEntry {
    let (extent, rows) = match &test.stimulation {
        Stimulation::Rows(rows) => {
            let whole = rows.iter().filter(|row| !row.is_half);
            let first = whole.clone().take(listed(&test.inputs, &test.outputs)).map(|one| row(test, one));
            (counted(whole.count(), "row"), first.collect())
        }
        Stimulation::Script(script) => (counted(script.steps.len(), "row"), Vec::new()),
        Stimulation::All { .. } => ("all inputs".to_owned(), Vec::new()),
        Stimulation::Ever { .. } => ("for ever".to_owned(), Vec::new()),
    };
    TestEntry {
        index,
        circuit: test.circuit.to_string(),
        title: test.title.clone(),
        line: test.line,
        ever: matches!(test.stimulation, Stimulation::Ever { .. }),
        inputs: test.inputs.clone(),
        outputs: test.outputs.clone(),
        extent,
        rows,
    }
}

fn row(test: &CircuitTest, row: &TestRow) -> TestRowEntry {
    let texts = |values: Vec<PortValue>| values.iter().map(PortValue::to_string).collect();
    let (inputs, outputs) = row.bases.split_at(test.inputs.len().min(row.bases.len()));
    TestRowEntry {
        row: row.row,
        line: row.line,
        inputs: texts(PortValue::of_ports(&test.inputs, row.inputs.iter().copied().map(Some), inputs)),
        outputs: texts(PortValue::of_ports(&test.outputs, row.expected.iter().copied(), outputs)),
    }
}

pub(super) fn chosen(checked: &Checked, choice: &Choice, job: &Job) -> Result<(Instance, CompileOptions), Refused> {
    let circuit = checked.circuit(choice)?;
    let first = || checked.swarms(&circuit).first().map(|swarm| swarm.name.clone());
    let swarm = choice.swarm.clone().or_else(first);
    let options = CompileOptions { swarm, ..job.options_for(checked, &circuit) };
    Ok((circuit, options))
}

/// A compiled circuit as a swarm that runs through some cycles before it is shown.
pub(super) fn loading(
    (session, checked): (&Session, &Checked),
    compiled: Compiled,
    script: GivenInputs,
    answer: impl FnOnce(SwarmAnswer) -> RequestResult,
    (number, job, shell): (u32, &Job, Arc<dyn Shell>),
) -> Result<LoadingSwarm, Refused> {
    job.check()?;
    let robots = compiled.assembly.members.len();
    if Limit::PageRobots.permit(robots as u64).is_err() {
        return Err(Refused::TooManyRobots { robots, most: Limit::PageRobots.most() as usize });
    }
    let swarm = session.swarm(&compiled);
    let described = ShownSwarm { script: script.shown, ..describe(number, checked, &compiled, &swarm) };
    let answer = answer(SwarmAnswer { swarm: Box::new(described) });
    let running = RunningSwarm::new(number, compiled, swarm, (script.inputs, shell));
    Ok(LoadingSwarm::new(running, script.before, (job.id, answer)))
}

pub(super) fn describe(number: u32, checked: &Checked, compiled: &Compiled, swarm: &LiveSwarm) -> ShownSwarm {
    let (assembly, trace, netlist) = (&compiled.assembly, swarm.trace(), &compiled.mapping.netlist);
    // A swarm has its robots in the order of the cells.
    let nets: Vec<NetId> = netlist.cells().map(|(cell, _)| cell).collect();
    let source = checked.program.circuit(&compiled.plan.circuit.circuit);
    let timing = compiled.swarm_timing();
    let all = Looks::of(assembly.members.iter().map(|member| &member.robot.body), SCHEME);
    ShownSwarm {
        number,
        circuit: compiled.plan.circuit.to_string(),
        swarm: compiled.plan.swarm.clone(),
        inputs: assembly.inputs.clone(),
        outputs: assembly.outputs.clone(),
        shown: assembly.shown.clone(),
        robots: trace
            .recording
            .robots
            .iter()
            .map(|recorded| robot(recorded, trace, assembly, (netlist, &nets), &all))
            .collect(),
        gates: compiled.mapping.source.cells().count(),
        registers: state::registers(netlist),
        listing: source.and_then(|source| state::listing(checked, source, &assembly.outputs)),
        looks: report::voxel_looks(&all),
        schematic: compiled.schematic(SCHEME).pages(),
        timing: timing.describe(),
        hold: compiled.timing.hold,
        clocks: state::clocks(&timing, &assembly.inputs),
        start: assembly.start_cycles(),
        ground: columns(&assembly.setting(Session::LIVE_CYCLES).ground),
        frames: FRAMES,
        own_clocks: match swarm.is_divisible() {
            true => Vec::new(),
            false => swarm.own_clocks().iter().map(|clock| (clock.phase, clock.rate)).collect(),
        },
        waves: compiled.mapping.waves.as_ref().map(|machine| {
            let registers = state::wave_registers(&compiled.mapping, machine);
            waves(machine, &trace.recording.robots, registers)
        }),
        script: None,
    }
}

/// The stretches of voxels in the columns of the ground; none if it is flat.
fn columns(ground: &GroundProfile) -> Vec<Vec<u8>> {
    let ends = |column| ground.stretches(column).into_iter().flat_map(|rows| [rows.start as u8, rows.end as u8]);
    (0..ground.columns().len()).map(|column| ends(column).collect()).collect()
}

fn waves(machine: &WaveMachine, robots: &[Recorded], registers: Vec<WaveRegister>) -> ShownWaves {
    // A swarm has its robots in the order of the cells.
    let phases: Vec<i64> = machine.netlist.cells().map(|(cell, _)| machine.phase[&cell]).collect();
    ShownWaves {
        step: machine.cycles_per_step(),
        beat: machine.beat,
        threads: machine.period,
        phases: robots.iter().map(|recorded| phases[recorded.robot]).collect(),
        begins: machine.beginning() * i64::from(machine.beat),
        clock: machine.clock.map(|(bit, _)| bit),
        registers,
    }
}

fn robot(
    recorded: &Recorded,
    trace: &SwarmTrace,
    assembly: &Assembly,
    (netlist, nets): (&Netlist, &[NetId]),
    looks: &Looks,
) -> SwarmRobot {
    let (robot, member) = (&trace.robots[recorded.robot], &assembly.members[recorded.robot]);
    let (body, character) = (&member.robot.body, &member.robot.character);
    let net = nets[recorded.robot];
    let called = |source| match source {
        StimulusSource::Robot(robot) => netlist.net_label(nets[robot]),
        _ => assembly.source_name(source),
    };
    SwarmRobot {
        net: robot.net.clone(),
        label: netlist.net_label(net),
        named: netlist.is_named(net),
        function: robot.function.name(),
        robot: robot.robot.clone(),
        about: report::about_robot(assembly, recorded.robot, &called),
        senses: robot.senses.clone(),
        body: body.rows(),
        size: [body.width(), body.height()],
        voxels: report::voxel_data(recorded, body, looks),
        points: recorded.points,
        clock: character.clock,
        margin: character.margin,
        errors: character.error_rate,
    }
}

/// Rows of a test that a page knows before its end.
const MOST_FOUND: usize = 500;

pub(super) fn testing(
    session: Session,
    open: impl FnOnce(&Job) -> Result<Arc<Checked>, Refused> + Send + 'static,
    (test, level): (Option<usize>, Level),
    shell: Arc<dyn Shell>,
) -> JobWork {
    let (mut open, mut running, mut cycles) = (Some(open), None, SharedCycles::new(shell));
    let mut sent = 0;
    Box::new(move |job| {
        let Some(run) = &mut running else {
            let checked = open.take().expect("it is opened once")(job)?;
            let test = chosen_test(&checked, test)?;
            let compile = job.options_for(&checked, &test.circuit);
            let options = TestOptions { level: Some(level), compile };
            running = Some(session.begin_test(&checked, test, &options)?);
            return Ok(PortionEnd::More);
        };
        let percent = job.percent;
        let is_running = run.advance_with(job, &mut cycles);
        if job.percent > percent && sent < MOST_FOUND {
            let found = run.found();
            sent = found.iter().map(|one| one.rows.len()).sum();
            job.outbox.found(job.id, listed_rows(found, MOST_FOUND));
        }
        if is_running {
            return Ok(if cycles.waits() { PortionEnd::Waits } else { PortionEnd::More });
        }
        job.check()?;
        let runs = running.take().expect("it runs").into_runs();
        let results = listed_rows(runs.into_iter().map(|run| run.verdict).collect(), usize::MAX);
        Ok(PortionEnd::Done(Some(RequestResult::Test(TestAnswer { results }))))
    })
}

fn listed_rows(mut verdicts: Vec<TestVerdict>, most: usize) -> Vec<TestVerdict> {
    verdicts.iter_mut().for_each(|one| one.rows.truncate(listed(&one.inputs, &one.outputs).min(most)));
    verdicts
}

pub(super) fn proving(
    open: impl FnOnce(&Job) -> Result<Arc<Checked>, Refused> + Send + 'static,
    claim: usize,
) -> JobWork {
    let (mut open, mut searching) = (Some(open), None);
    Box::new(move |job| {
        let Some(search) = &mut searching else {
            let checked = open.take().expect("it is opened once")(job)?;
            let claim = checked.program.claims.get(claim).ok_or(Refused::NoClaim)?;
            searching = Some(checked.prove(claim, SearchBudget::SHORT, job.stop.clone())?);
            return Ok(PortionEnd::More);
        };
        if search.advance(job) {
            return Ok(PortionEnd::More);
        }
        job.check()?;
        let decided = searching.take().expect("it searches").finish();
        Ok(PortionEnd::Done(Some(RequestResult::Prove(decided))))
    })
}
