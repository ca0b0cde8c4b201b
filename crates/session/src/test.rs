//! Tests: compiled to cases without errors, and run at the level of logic or in physics.

use std::sync::Arc;

use crate::compile::{Compiled, compile, need_beat};
use crate::contents::declared_file;
use crate::equivalence::Equivalence;
use crate::hold;
use crate::options::CompileOptions;
use crate::plan::plans;
use crate::robots::RobotSources;
use crate::script::{EnvironmentRun, Performance, PerformedRow};
use crate::swarm_run::{RunEnd, SwarmRun};
use crate::test_timing::{TestTiming, TimedTest};
use crate::waves::steps;
use crate::wording;
use nbc_base::budget::{CYCLE_BITS, Limit, WorkBudget};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Base, CircuitTest, NamedWorld, PhysicsWorld, Program, Stimulation, TestRow};
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{Netlist, Settled, elaborate, elaborate_reference};
use nbc_swarm::{Level, RowHold, SwarmBits, SwarmTask, TestVerdict, WorldTrial};

/// Swarms of at least this many robots are tested at the level of logic unless physics is requested.
const LARGE: usize = 40;

/// Circuits of so many gates are not compiled to count robots: no library makes them of fewer than [`LARGE`].
const SURELY_LARGE: usize = 10 * LARGE;

const MOST_PHYSICAL_ROWS: usize = 200_000;

/// How a test is run.
#[derive(Clone, Debug, Default)]
pub struct TestOptions {
    /// By default physics for swarms of few robots.
    pub level: Option<Level>,
    pub compile: CompileOptions,
}

/// A test with its results.
#[derive(Clone, Debug)]
pub struct TestRun {
    /// A cancelled run has not passed, and its verdict has the completed rows.
    pub verdict: TestVerdict,
    pub end: RunEnd,
    /// `None` at the level of logic.
    pub swarm: Option<SwarmRun>,
    /// Cycles that are a sufficient hold for each row; `None` without a swarm.
    pub hold: Option<usize>,
    pub warnings: Vec<Diagnostic>,
}

#[derive(Clone, Debug)]
pub struct PhysicalTest {
    pub compiled: Compiled,
    pub inputs: Vec<Vec<bool>>,
    /// The cycles after which each row has passed.
    pub ends: Vec<usize>,
}

/// A test that is ready to run.
#[derive(Clone, Debug)]
pub struct TestCase {
    pub(super) test: Arc<CircuitTest>,
    pub(super) subject: TestSubject,
}

#[derive(Clone, Debug)]
pub(super) enum TestSubject {
    Gates(Box<Netlist>, Arc<[TestRow]>),
    /// Gates whose rows depend on what they do.
    Script(Box<Performance>),
    Ever(Box<Equivalence>),
    Robots(Box<TimedTest>),
}

/// One for each declared swarm in each world of the test, or one at the level of logic, as for each test for ever.
pub(super) fn cases(
    sources: RobotSources<'_>,
    program: &Program,
    test: &CircuitTest,
    options: &TestOptions,
) -> Result<Vec<TestCase>, Vec<Diagnostic>> {
    for (name, _) in &options.compile.files {
        declared_file(program, name).map_err(|fault| vec![fault])?;
    }
    let netlist = elaborate(program, &test.circuit)?;
    let own = Arc::new(test.clone());
    let case = |subject| TestCase { test: own.clone(), subject };
    if let Stimulation::Ever { other, reference } = &test.stimulation {
        let cancel = options.compile.cancel.clone();
        let subject = Equivalence::new(program, test, netlist, (other, reference), cancel)?;
        return Ok(vec![case(TestSubject::Ever(Box::new(subject)))]);
    }
    let level = options.level;
    let performance = performance(sources, program, test, &netlist, &options.compile)?;
    let logic = |netlist| {
        let subject = match &performance {
            Some(performance) => TestSubject::Script(Box::new(performance.clone())),
            None => TestSubject::Gates(Box::new(netlist), rows(program, test)?.into()),
        };
        Ok(vec![case(subject)])
    };
    if level == Some(Level::Logic) || (level.is_none() && netlist.cells().count() >= SURELY_LARGE) {
        return logic(netlist);
    }
    let plans = plans(sources, program, &test.circuit, &options.compile)?;
    let mut rows_of_test = None;
    let mut cases = Vec::new();
    for plan in plans {
        let worlds = if test.worlds.is_empty() { vec![plan.world.clone()] } else { test.worlds.clone() };
        let plan = plan.in_world(worlds[0].clone());
        let mut compiled = compile(program, netlist.clone(), plan, &options.compile.mapping(), test.span)?;
        if level.is_none() && compiled.assembly.members.len() >= LARGE {
            return logic(netlist);
        }
        let (mut rows, printed) = match &rows_of_test {
            Some(found) => Clone::clone(found),
            None => rows_of_test.insert(physical_rows(program, test, performance.clone(), &options.compile)?).clone(),
        };
        let timing = match &compiled.mapping.waves {
            Some(machine) => {
                need_beat(&worlds, test.span)?;
                rows = if performance.is_some() { edges_only(rows, machine) } else { rows };
                rows = steps(test, &rows, machine.clock, Some(machine.cycles_per_step() as u32))?;
                permit_cycles(test, machine.cycles(rows.len()) as u64)?;
                TestTiming::Waves
            }
            None => {
                let row_holds = hold::row_holds(&rows, &netlist, &compiled);
                permit_cycles(test, row_holds.iter().map(|row_hold| row_hold.hold as u64).sum())?;
                compiled.warnings.extend(short_holds(program, test, &rows, &row_holds, &compiled));
                TestTiming::Holds(row_holds)
            }
        };
        let first =
            TimedTest { test: own.clone(), rows: rows.into(), compiled, timing, ends_at_failure: false, printed };
        let timed = |world| Box::new(first.in_world(world));
        cases.extend(worlds.into_iter().map(|world| case(TestSubject::Robots(timed(world)))));
    }
    Ok(cases)
}

fn permit_cycles(test: &CircuitTest, cycles: u64) -> Result<(), Vec<Diagnostic>> {
    let bits = test.inputs.iter().map(|column| column.width as u64).sum::<u64>() + CYCLE_BITS;
    Limit::CycleBits.permit(cycles.saturating_mul(bits)).map_err(|over| vec![over.at(test.span)])
}

fn performance(
    sources: RobotSources<'_>,
    program: &Program,
    test: &CircuitTest,
    netlist: &Netlist,
    options: &CompileOptions,
) -> Result<Option<Performance>, Vec<Diagnostic>> {
    let Stimulation::Script(script) = &test.stimulation else { return Ok(None) };
    Performance::new(sources.world, program, test, script, netlist, &options.files).map(Some)
}

pub(super) fn environment(
    sources: RobotSources<'_>,
    program: &Program,
    test: &CircuitTest,
    rows: usize,
    options: &CompileOptions,
) -> Result<Option<EnvironmentRun>, Vec<Diagnostic>> {
    let netlist = elaborate(program, &test.circuit)?;
    let performance = performance(sources, program, test, &netlist, options)?;
    performance.map_or(Ok(None), |performance| performance.watch(rows)).map_err(|fault| vec![fault])
}

/// All outputs are checked in the rows of a script.
fn physical_rows(
    program: &Program,
    test: &CircuitTest,
    performance: Option<Performance>,
    options: &CompileOptions,
) -> Result<(Vec<TestRow>, String), Vec<Diagnostic>> {
    let Some(mut performance) = performance else { return Ok((rows(program, test)?, String::new())) };
    let mut rows: Vec<TestRow> = Vec::new();
    let mut budget = WorkBudget::default();
    let bits = test.inputs.iter().chain(&test.outputs).map(|column| column.width as u64 + 1).sum();
    while let Some(performed) = performance.step().map_err(|fault| vec![fault])? {
        if options.cancel.is_raised() {
            break;
        }
        for PerformedRow { mut row, outputs, is_last } in performed {
            budget.take(Limit::RowBits, bits).map_err(|over| vec![over.at(test.span)])?;
            let written = std::mem::replace(&mut row.expected, outputs.into_iter().map(Some).collect());
            if is_last {
                for (expected, written) in row.expected.iter_mut().zip(written).filter(|(_, written)| written.is_some())
                {
                    *expected = written;
                }
            }
            rows.push(row);
        }
        if rows.len() > MOST_PHYSICAL_ROWS {
            return Err(vec![wording::too_long_for_physics(MOST_PHYSICAL_ROWS, test.span)]);
        }
    }
    Ok((rows, performance.printed))
}

/// Outputs of a wave machine are checked after the edges of the clock only.
fn edges_only(mut rows: Vec<TestRow>, machine: &WaveMachine) -> Vec<TestRow> {
    if let Some((clock, rises)) = machine.clock {
        for row in rows.iter_mut().skip(1).filter(|row| row.inputs[clock] != rises) {
            row.expected.fill(None);
        }
    }
    rows
}

fn short_holds(
    program: &Program,
    test: &CircuitTest,
    own: &[TestRow],
    row_holds: &[RowHold],
    compiled: &Compiled,
) -> Vec<Diagnostic> {
    let sufficient = || {
        let others = program.tests.iter().filter(|other| other.circuit == test.circuit && *other != test);
        let others = others.filter(|other| matches!(other.stimulation, Stimulation::Rows(_) | Stimulation::All { .. }));
        let others = others.filter_map(|other| rows(program, other).ok());
        let cycles = others.map(|rows| hold::sufficient(&rows, compiled));
        cycles.fold(hold::sufficient(own, compiled), usize::max)
    };
    hold::warnings(test, own, row_holds, compiled, sufficient)
}

impl TestRun {
    pub fn world_trial(&self) -> Option<WorldTrial> {
        let SwarmRun { compiled, trace } = self.swarm.as_ref()?;
        let window = compiled.plan.window as usize;
        Some(WorldTrial::new(compiled.plan.world.world, &self.verdict, trace, &compiled.clocks(), window))
    }
}

impl TestCase {
    fn timed(&self) -> Option<&TimedTest> {
        if let TestSubject::Robots(timed) = &self.subject { Some(timed) } else { None }
    }

    /// Cycles in physics, rows at the level of logic.
    pub fn work(&self) -> u64 {
        let work = match &self.subject {
            TestSubject::Gates(_, rows) => rows.len(),
            TestSubject::Script(performance) => performance.progress().1,
            TestSubject::Ever(_) => 1,
            TestSubject::Robots(timed) => timed.cycles(timed.rows.len()),
        };
        work as u64
    }

    /// The hold of each row in physics; empty at the level of logic, and for wave machines.
    pub fn row_holds(&self) -> &[RowHold] {
        match &self.subject {
            TestSubject::Robots(timed) => timed.timing.row_holds(),
            _ => &[],
        }
    }

    /// Those of a wave machine are its steps.
    pub fn rows(&self) -> &[TestRow] {
        match &self.subject {
            TestSubject::Gates(_, rows) => rows,
            TestSubject::Robots(timed) => &timed.rows,
            TestSubject::Script(_) | TestSubject::Ever(_) => &[],
        }
    }

    pub fn swarm(&self) -> Option<&str> {
        self.timed()?.compiled.plan.swarm.as_deref()
    }

    pub fn world_name(&self) -> Option<&str> {
        Some(&self.timed()?.compiled.plan.world.name)
    }

    pub fn into_physics(self, rows: usize) -> Option<PhysicalTest> {
        let TestSubject::Robots(timed) = self.subject else { return None };
        let (inputs, ends) = (timed.inputs(rows), timed.ends(rows));
        Some(PhysicalTest { compiled: timed.compiled, inputs, ends })
    }

    /// The world of the swarm; at the level of logic the paper's.
    pub fn world(&self) -> PhysicsWorld {
        self.timed().map_or_else(PhysicsWorld::default, |timed| timed.compiled.plan.world.world)
    }

    /// The same test in another world. It ends with the first row that fails, unless the test permits failures.
    pub fn trial_in(&self, world: PhysicsWorld) -> Self {
        let mut trial = self.clone();
        if let TestSubject::Robots(timed) = &mut trial.subject {
            let name = timed.compiled.plan.world.name.clone();
            **timed = timed.in_world(NamedWorld { name, world });
            timed.ends_at_failure = self.test.rows_from.as_ref().is_none_or(|from| from.at_least.is_none());
        }
        trial
    }

    /// 0 at the level of logic.
    pub fn robots(&self) -> usize {
        self.timed().map_or(0, |timed| timed.compiled.assembly.members.len())
    }

    pub fn task(&self) -> Option<SwarmTask> {
        let timed = self.timed()?;
        let Compiled { assembly, plan, .. } = &timed.compiled;
        Some(SwarmTask::of(assembly, timed.inputs(timed.rows.len()), plan.window as usize))
    }

    /// Judges bits that were simulated elsewhere; the run has no trace. Panics if they belong to another swarm.
    pub fn judge(self, bits: &SwarmBits) -> TestRun {
        let timed = self.timed().expect("a test in physics");
        let inputs = timed.inputs(timed.rows.len());
        let is_short = bits.cycles.len() < inputs.len() && bits.fault.is_none();
        let end = if is_short { RunEnd::Cancelled } else { RunEnd::Complete };
        let verdict = timed.verdict(&bits.trace(&timed.compiled.assembly, &inputs), end);
        TestRun { verdict, end, swarm: None, hold: None, warnings: timed.compiled.warnings.clone() }
    }
}

/// A test over all inputs, of which the checker allows few, has the rows of its reference.
fn rows(program: &Program, test: &CircuitTest) -> Result<Vec<TestRow>, Vec<Diagnostic>> {
    let reference = match &test.stimulation {
        Stimulation::Rows(rows) => return Ok(rows.clone()),
        Stimulation::Script(_) | Stimulation::Ever { .. } => unreachable!("it has no rows before it runs"),
        Stimulation::All { reference } => reference,
    };
    let bits: usize = test.inputs.iter().map(|port| port.width).sum();
    let mut settled = Settled::new(&elaborate_reference(program, reference)?);
    let bases: Vec<Base> = test.inputs.iter().chain(&test.outputs).map(Base::of_port).collect();
    let inputs = |pattern: usize| (0..bits).rev().map(|bit| pattern >> bit & 1 == 1).collect();
    let mut rows = Vec::with_capacity(1 << bits);
    for first in (0..1usize << bits).step_by(Settled::ROWS) {
        let block: Vec<Vec<bool>> = (first..(first + Settled::ROWS).min(1 << bits)).map(inputs).collect();
        let ends = settled.apply(&block.iter().map(Vec::as_slice).collect::<Vec<_>>());
        for (inputs, end) in block.into_iter().zip(ends) {
            let expected = end.outputs.into_iter().map(|bit| end.is_settled.then_some(bit)).collect();
            let (bases, span, line, row) = (bases.clone(), test.span, test.line, rows.len() + 1);
            let (hold, is_half, given_up) = (None, false, None);
            rows.push(TestRow { inputs, expected, bases, hold, span, line, row, is_half, given_up });
        }
    }
    Ok(rows)
}
