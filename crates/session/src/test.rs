//! Tests: compiled to cases without errors, and run at the level of logic or in physics.

use std::sync::Arc;

use crate::compile::{Compiled, compile};
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
use crate::wording::ScriptError;
use nbc_base::budget::{CYCLE_BITS, Limit, WorkBudget};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Base, CircuitTest, NamedWorld, PhysicsWorld, Program, Stimulation, TestRow};
use nbc_circuit::waves::WaveMachine;
use nbc_circuit::{Netlist, Settled, elaborate, elaborate_reference};
use nbc_swarm::{Level, RowHold, RowVerdict, SwarmBits, SwarmTask, SwarmTrace, TestVerdict, WorldTrial};

/// Swarms of this many robots or more are tested at the level of logic unless physics is requested.
const LARGE: usize = 40;

/// Circuits with this many gates are not compiled to count robots: no library makes them of fewer than [`LARGE`]
/// robots.
const SURELY_LARGE: usize = 10 * LARGE;

/// The most rows of a script in physics.
const MOST_PHYSICAL_ROWS: usize = 200_000;

/// How a test is run.
#[derive(Clone, Debug, Default)]
pub struct TestOptions {
    /// The level; by default physics for swarms of few robots.
    pub level: Option<Level>,
    /// How its circuit becomes a swarm.
    pub compile: CompileOptions,
}

/// A test with its results.
#[derive(Clone, Debug)]
pub struct TestRun {
    /// Whether the circuit passed. A cancelled run has not passed, and its verdict has the completed rows.
    pub verdict: TestVerdict,
    /// How the run ended.
    pub end: RunEnd,
    /// The swarm and its trace; `None` at the level of logic.
    pub swarm: Option<SwarmRun>,
    /// Cycles that are a sufficient hold for each of its rows; `None` without a swarm.
    pub hold: Option<usize>,
    /// Warnings.
    pub warnings: Vec<Diagnostic>,
}

/// The first rows of a test as inputs of its swarm.
#[derive(Clone, Debug)]
pub struct PhysicalTest {
    /// The swarm.
    pub compiled: Compiled,
    /// The input bits of each cycle.
    pub inputs: Vec<Vec<bool>>,
    /// For each row, the cycles after which it has passed.
    pub ends: Vec<usize>,
}

/// A test that is ready to run.
#[derive(Clone, Debug)]
pub struct TestCase {
    pub(super) test: Arc<CircuitTest>,
    pub(super) rows: Arc<[TestRow]>,
    pub(super) subject: TestSubject,
    /// Whether it ends in physics with the first row that fails.
    pub(super) ends_at_failure: bool,
    /// What its environment writes as text while the rows pass.
    pub(super) printed: String,
}

/// The tested circuit.
#[derive(Clone, Debug)]
pub(super) enum TestSubject {
    Gates(Netlist),
    /// Gates whose rows depend on what they do.
    Script(Box<Performance>),
    /// Gates that are compared with others for ever.
    Ever(Box<Equivalence>),
    Robots(Box<Compiled>, TestTiming),
}

/// The cases of a test: one for each swarm that is declared for its circuit in each world that the test names, or one
/// at the level of logic, which has no worlds. A test for ever is always at the level of logic.
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
    if let Stimulation::Ever { other, reference } = &test.stimulation {
        let cancel = options.compile.cancel.clone();
        let subject = Equivalence::new(program, test, netlist, (other, reference), cancel)?;
        let (test, subject) = (Arc::new(test.clone()), TestSubject::Ever(Box::new(subject)));
        return Ok(vec![TestCase { test, rows: [].into(), subject, ends_at_failure: false, printed: String::new() }]);
    }
    let level = options.level;
    let performance = performance(sources, program, test, &netlist, &options.compile)?;
    let own = Arc::new(test.clone());
    let case = |rows: Vec<TestRow>, printed: String, subject: TestSubject| TestCase {
        test: own.clone(),
        rows: rows.into(),
        subject,
        ends_at_failure: false,
        printed,
    };
    let logic = |netlist| {
        let (rows, subject) = match &performance {
            Some(performance) => (Vec::new(), TestSubject::Script(Box::new(performance.clone()))),
            None => (rows(program, test)?, TestSubject::Gates(netlist)),
        };
        Ok(vec![case(rows, String::new(), subject)])
    };
    if level == Some(Level::Logic) || (level.is_none() && netlist.cells().count() >= SURELY_LARGE) {
        return logic(netlist);
    }
    let plans = plans(sources, program, &test.circuit, &options.compile)?;
    let mut rows_of_test = None;
    let mut cases = Vec::new();
    for mut plan in plans {
        let worlds = if test.worlds.is_empty() { vec![plan.world.clone()] } else { test.worlds.clone() };
        plan.world.clone_from(&worlds[0]);
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
        let one = case(rows, printed, TestSubject::Gates(Netlist::default()));
        for world in worlds {
            let there = compiled.in_world(world);
            cases.push(TestCase { subject: TestSubject::Robots(Box::new(there), timing.clone()), ..one.clone() });
        }
    }
    Ok(cases)
}

/// Whether there is room for so many cycles of a test in physics.
fn permit_cycles(test: &CircuitTest, cycles: u64) -> Result<(), Vec<Diagnostic>> {
    let bits = test.inputs.iter().map(|column| column.width as u64).sum::<u64>() + CYCLE_BITS;
    Limit::CycleBits.permit(cycles.saturating_mul(bits)).map_err(|over| vec![over.at(test.span)])
}

/// The performance of a test whose rows depend on what its circuit does; `None` for other tests.
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

/// What the environment of a test does in its first rows, at the level of logic; `None` without an environment.
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

/// The rows of a test in physics, and what its environment wrote meanwhile. All outputs are checked in the rows of a
/// script.
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
            return Err(vec![ScriptError::TooLong { most: MOST_PHYSICAL_ROWS }.at(test.span)]);
        }
    }
    Ok((rows, performance.printed))
}

/// The rows of a wave machine: its outputs are checked after the edges of the clock only.
fn edges_only(mut rows: Vec<TestRow>, machine: &WaveMachine) -> Vec<TestRow> {
    if let Some((clock, rises)) = machine.clock {
        for row in rows.iter_mut().skip(1).filter(|row| row.inputs[clock] != rises) {
            row.expected.fill(None);
        }
    }
    rows
}

/// The warnings of a hold that is too short, with one that suffices for all tests of the circuit.
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
    /// The run as the result in its world; `None` at the level of logic.
    pub fn world_trial(&self) -> Option<WorldTrial> {
        let SwarmRun { compiled, trace } = self.swarm.as_ref()?;
        let window = compiled.plan.window as usize;
        Some(WorldTrial::new(compiled.plan.world.world, &self.verdict, trace, &compiled.clocks(), window))
    }
}

impl TestCase {
    /// The test with its swarm and its timing; `None` at the level of logic.
    pub(super) fn timed(&self) -> Option<TimedTest<'_>> {
        match &self.subject {
            TestSubject::Gates(_) | TestSubject::Script(_) | TestSubject::Ever(_) => None,
            TestSubject::Robots(compiled, timing) => {
                Some(TimedTest { test: &self.test, rows: &self.rows, compiled, timing })
            }
        }
    }

    /// The amount of work: cycles in physics, rows at the level of logic.
    pub fn work(&self) -> u64 {
        match &self.subject {
            TestSubject::Script(performance) => performance.progress().1 as u64,
            TestSubject::Ever(_) => 1,
            _ => self.timed().map_or(self.rows.len(), |timed| timed.cycles(self.rows.len())) as u64,
        }
    }

    /// The hold of each row in physics; empty at the level of logic, and for wave machines.
    pub fn row_holds(&self) -> &[RowHold] {
        match &self.subject {
            TestSubject::Robots(_, TestTiming::Holds(row_holds)) => row_holds,
            TestSubject::Robots(_, TestTiming::Waves)
            | TestSubject::Gates(_)
            | TestSubject::Script(_)
            | TestSubject::Ever(_) => &[],
        }
    }

    /// The swarm; `None` at the level of logic.
    fn compiled(&self) -> Option<&Compiled> {
        self.timed().map(|timed| timed.compiled)
    }

    /// The declared swarm that is tested, if it is one.
    pub fn swarm(&self) -> Option<&str> {
        self.compiled()?.plan.swarm.as_deref()
    }

    /// The name of the world of its swarm; `None` at the level of logic.
    pub fn world_name(&self) -> Option<&str> {
        Some(&self.compiled()?.plan.world.name)
    }

    /// The swarm with the inputs of the first `rows` rows; `None` at the level of logic.
    pub fn into_physics(self, rows: usize) -> Option<PhysicalTest> {
        let timed = self.timed()?;
        let (inputs, ends) = (timed.inputs(rows), timed.ends(rows));
        match self.subject {
            TestSubject::Gates(_) | TestSubject::Script(_) | TestSubject::Ever(_) => None,
            TestSubject::Robots(compiled, _) => Some(PhysicalTest { compiled: *compiled, inputs, ends }),
        }
    }

    /// The world of its swarm; the paper's at the level of logic, which has none.
    pub fn world(&self) -> PhysicsWorld {
        self.compiled().map_or_else(PhysicsWorld::default, |compiled| compiled.plan.world.world)
    }

    /// The same test in another world, where it ends with the first row that fails.
    pub fn trial_in(&self, world: PhysicsWorld) -> Self {
        let subject = match &self.subject {
            TestSubject::Robots(compiled, timing) => {
                let world = NamedWorld { name: compiled.plan.world.name.clone(), world };
                TestSubject::Robots(Box::new(compiled.in_world(world)), timing.clone())
            }
            other => other.clone(),
        };
        let (test, rows, printed) = (self.test.clone(), self.rows.clone(), self.printed.clone());
        // A test that permits failures goes on after one.
        let ends_at_failure = test.rows_from.as_ref().is_none_or(|from| from.at_least.is_none());
        Self { test, rows, subject, ends_at_failure, printed }
    }

    /// The number of robots; 0 at the level of logic.
    pub fn robots(&self) -> usize {
        self.compiled().map_or(0, |compiled| compiled.assembly.members.len())
    }

    /// The rows, in order; those of a wave machine are its steps.
    pub fn rows(&self) -> &[TestRow] {
        &self.rows
    }

    /// The simulation of its swarm, to be done elsewhere; `None` at the level of logic.
    pub fn task(&self) -> Option<SwarmTask> {
        let timed = self.timed()?;
        let Compiled { assembly, plan, .. } = timed.compiled;
        Some(SwarmTask::of(assembly, timed.inputs(self.rows.len()), plan.window as usize))
    }

    /// The end of the test when its swarm was simulated elsewhere, with these bits. There is no trace.
    ///
    /// # Panics
    /// When the bits belong to another swarm, or the test has none.
    pub fn judge(self, bits: &SwarmBits) -> TestRun {
        let timed = self.timed().expect("a test in physics");
        let inputs = timed.inputs(self.rows.len());
        let is_short = bits.cycles.len() < inputs.len() && bits.fault.is_none();
        let end = if is_short { RunEnd::Cancelled } else { RunEnd::Complete };
        let trace = bits.trace(&timed.compiled.assembly, &inputs);
        let (verdict, warnings) = judged(timed, &self.printed, &trace, end);
        TestRun { verdict, end, swarm: None, hold: None, warnings }
    }
}

/// The verdict on a trace, and the warnings.
pub(super) fn judged(
    timed: TimedTest<'_>,
    printed: &str,
    trace: &SwarmTrace,
    end: RunEnd,
) -> (TestVerdict, Vec<Diagnostic>) {
    let compiled = timed.compiled;
    let mut verdict = verdict(timed.test, Level::Physics, Some(compiled), timed.judge(trace));
    verdict.printed = Some(printed.to_owned()).filter(|printed| !printed.is_empty() && end == RunEnd::Complete);
    verdict.passed &= end == RunEnd::Complete;
    (verdict, compiled.warnings.clone())
}

pub(super) fn verdict(
    test: &CircuitTest,
    level: Level,
    compiled: Option<&Compiled>,
    rows: Vec<RowVerdict>,
) -> TestVerdict {
    TestVerdict {
        file: test.file.clone(),
        line: test.line,
        circuit: test.circuit.to_string(),
        title: test.title.clone(),
        swarm: compiled.and_then(|compiled| compiled.plan.swarm.clone()),
        world: compiled.map(|compiled| compiled.plan.world.name.clone()),
        is_world_named: !test.worlds.is_empty(),
        level,
        passed: enough(test, &rows),
        rows_from: test.rows_from.clone(),
        inputs: test.inputs.clone(),
        outputs: test.outputs.clone(),
        weak_robots: compiled.map_or(Vec::new(), |compiled| compiled.weak_robots.clone()),
        rows,
        printed: None,
        proof: None,
    }
}

/// Whether all rows passed, or the share that the test asks for.
fn enough(test: &CircuitTest, rows: &[RowVerdict]) -> bool {
    let passed = rows.iter().filter(|row| row.passed).count();
    match test.rows_from.as_ref().and_then(|from| from.at_least) {
        Some(percent) => passed as f64 * 100.0 >= percent * rows.len() as f64,
        None => passed == rows.len(),
    }
}

/// The rows of a test without a script. For a test over all inputs, of which the checker allows few, they are computed
/// from its reference.
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
