//! Tests: compiled to cases without errors, and run at the level of logic or in physics.

use crate::compile::{Compiled, compile};
use crate::hold;
use crate::observer::Observer;
use crate::options::CompileOptions;
use crate::plan::plans;
use crate::robots::RobotSources;
use crate::swarm_run::{self, Physics, RunEnd, SwarmRun};
use crate::test_timing::{TestTiming, TimedTest};
use crate::waves::steps;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Base, CircuitTest, PhysicsWorld, Program, Stimulation, TestRow};
use nbc_circuit::{Logic, Netlist, elaborate, elaborate_reference};
use nbc_swarm::{Level, RowHold, SwarmBits, SwarmTask, SwarmTrace, TestVerdict, WorldTrial};

/// Swarms of this many robots or more are tested at the level of logic unless physics is requested.
const LARGE: usize = 40;

/// Circuits with this many gates are not compiled to count robots: no library makes them of fewer than [`LARGE`]
/// robots.
const SURELY_LARGE: usize = 10 * LARGE;

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

/// A test that is ready to run.
#[derive(Clone, Debug)]
pub struct TestCase<'a> {
    test: &'a CircuitTest,
    rows: Vec<TestRow>,
    subject: Subject,
    /// Whether it ends in physics with the first row that fails.
    ends_at_failure: bool,
}

/// The tested circuit.
#[derive(Clone, Debug)]
enum Subject {
    Gates(Netlist),
    Robots(Box<Compiled>, TestTiming),
}

/// The cases of a test: one for each swarm that is declared for its circuit, or one at the level of logic.
///
/// # Errors
/// When the circuit or its reference cannot be built, the circuit cannot be compiled, or robots cannot be read.
pub(super) fn cases<'a>(
    sources: RobotSources<'_>,
    program: &Program,
    test: &'a CircuitTest,
    options: &TestOptions,
) -> Result<Vec<TestCase<'a>>, Vec<Diagnostic>> {
    let rows = rows(program, test)?;
    let case = |subject| TestCase { test, rows: rows.clone(), subject, ends_at_failure: false };
    let netlist = elaborate(program, &test.circuit)?;
    let level = options.level;
    if level == Some(Level::Logic) || (level.is_none() && netlist.cells().count() >= SURELY_LARGE) {
        return Ok(vec![case(Subject::Gates(netlist))]);
    }
    let mut cases = Vec::new();
    for mut plan in plans(sources, program, &test.circuit, &options.compile)? {
        plan.world = test.world.unwrap_or(plan.world);
        let mut compiled = compile(program, plan, &options.compile.mapping(), test.span)?;
        if level.is_none() && compiled.assembly.members.len() >= LARGE {
            return Ok(vec![case(Subject::Gates(netlist))]);
        }
        let mut one = case(Subject::Gates(Netlist::default()));
        let timing = match &compiled.mapping.waves {
            Some(machine) => {
                one.rows = steps(test, &rows, machine)?;
                TestTiming::Waves
            }
            None => {
                let row_holds = hold::row_holds(&rows, &netlist, &compiled);
                compiled.warnings.extend(short_holds(program, test, &rows, &row_holds, &compiled));
                TestTiming::Holds(row_holds)
            }
        };
        cases.push(TestCase { subject: Subject::Robots(Box::new(compiled), timing), ..one });
    }
    Ok(cases)
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
        Some(WorldTrial::new(compiled.plan.world, &self.verdict, trace, &compiled.clocks(), window))
    }
}

impl TestCase<'_> {
    /// The test with its swarm and its timing; `None` at the level of logic.
    fn timed(&self) -> Option<TimedTest<'_>> {
        match &self.subject {
            Subject::Gates(_) => None,
            Subject::Robots(compiled, timing) => {
                Some(TimedTest { test: self.test, rows: &self.rows, compiled, timing })
            }
        }
    }

    /// The amount of work: cycles in physics, rows at the level of logic.
    pub fn work(&self) -> u64 {
        self.timed().map_or(self.rows.len(), |timed| timed.cycles(self.rows.len())) as u64
    }

    /// The hold of each row in physics; empty at the level of logic, and for wave machines.
    pub fn row_holds(&self) -> &[RowHold] {
        match &self.subject {
            Subject::Robots(_, TestTiming::Holds(row_holds)) => row_holds,
            Subject::Robots(_, TestTiming::Waves) | Subject::Gates(_) => &[],
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

    /// The swarm, and the input bits of each of its cycles through the first `rows` rows; `None` at the level of logic.
    pub fn into_physics(self, rows: usize) -> Option<(Compiled, Vec<Vec<bool>>)> {
        let inputs = self.timed()?.inputs(rows);
        match self.subject {
            Subject::Gates(_) => None,
            Subject::Robots(compiled, _) => Some((*compiled, inputs)),
        }
    }

    /// The world of its swarm; the paper's at the level of logic, which has none.
    pub fn world(&self) -> PhysicsWorld {
        self.compiled().map_or_else(PhysicsWorld::default, |compiled| compiled.plan.world)
    }

    /// The same test in another world, where it ends with the first row that fails.
    pub fn trial_in(&self, world: PhysicsWorld) -> Self {
        let subject = match &self.subject {
            Subject::Gates(netlist) => Subject::Gates(netlist.clone()),
            Subject::Robots(compiled, timing) => Subject::Robots(Box::new(compiled.in_world(world)), timing.clone()),
        };
        Self { test: self.test, rows: self.rows.clone(), subject, ends_at_failure: true }
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
        let end = if bits.cycles.len() < inputs.len() { RunEnd::Cancelled } else { RunEnd::Complete };
        let trace = bits.trace(&timed.compiled.assembly, &inputs);
        let (verdict, warnings) = judged(timed, &trace, end);
        TestRun { verdict, end, swarm: None, hold: None, warnings }
    }

    /// Runs the test.
    pub(super) fn run(self, physics: &Physics, observer: &mut dyn Observer) -> TestRun {
        let Some(timed) = self.timed() else { return self.run_logic(observer) };
        let inputs = timed.inputs(self.rows.len());
        let swarm = physics.swarm(timed.compiled, inputs.len());
        let mut has_failed = timed.has_failed();
        let mut is_enough = |trace: &SwarmTrace| self.ends_at_failure && has_failed(trace);
        let (trace, end) = swarm_run::run_until(swarm, &inputs, &mut is_enough, observer);
        let (verdict, warnings) = judged(timed, &trace, end);
        let hold = match timed.timing {
            TestTiming::Holds(_) => hold::sufficient(&self.rows, timed.compiled),
            TestTiming::Waves => timed.compiled.timing.hold as usize,
        };
        drop(has_failed);
        let Subject::Robots(compiled, _) = self.subject else { unreachable!("a test in physics has robots") };
        TestRun { verdict, end, swarm: Some(SwarmRun { compiled: *compiled, trace }), hold: Some(hold), warnings }
    }

    fn run_logic(self, observer: &mut dyn Observer) -> TestRun {
        let Subject::Gates(netlist) = &self.subject else { unreachable!("a test without robots has gates") };
        let rows = nbc_swarm::judge_logic(self.test, &self.rows, netlist);
        observer.progress(rows.len() as u64, rows.len() as u64);
        let verdict = verdict(self.test, Level::Logic, None, rows);
        TestRun { verdict, end: RunEnd::Complete, swarm: None, hold: None, warnings: Vec::new() }
    }
}

/// The verdict on a trace, and the warnings.
fn judged(timed: TimedTest<'_>, trace: &SwarmTrace, end: RunEnd) -> (TestVerdict, Vec<Diagnostic>) {
    let compiled = timed.compiled;
    let mut verdict = verdict(timed.test, Level::Physics, Some(compiled), timed.judge(trace));
    verdict.passed &= end == RunEnd::Complete;
    (verdict, compiled.warnings.clone())
}

fn verdict(
    test: &CircuitTest,
    level: Level,
    compiled: Option<&Compiled>,
    rows: Vec<nbc_swarm::RowVerdict>,
) -> TestVerdict {
    TestVerdict {
        file: test.file.clone(),
        line: test.line,
        circuit: test.circuit.to_string(),
        title: test.title.clone(),
        swarm: compiled.and_then(|compiled| compiled.plan.swarm.clone()),
        level,
        passed: rows.iter().all(|row| row.passed),
        inputs: test.inputs.clone(),
        outputs: test.outputs.clone(),
        weak_robots: compiled.map_or(Vec::new(), |compiled| compiled.weak_robots.clone()),
        rows,
    }
}

/// The rows of a test. For a test over all inputs, of which the checker allows few, they are computed from its
/// reference.
///
/// # Errors
/// When the reference cannot be built.
fn rows(program: &Program, test: &CircuitTest) -> Result<Vec<TestRow>, Vec<Diagnostic>> {
    let reference = match &test.stimulation {
        Stimulation::Rows(rows) => return Ok(rows.clone()),
        Stimulation::All { reference } => reference,
    };
    let bits: usize = test.inputs.iter().map(|port| port.width).sum();
    let mut logic = Logic::new(&elaborate_reference(program, reference)?);
    let bases: Vec<Base> = test.inputs.iter().chain(&test.outputs).map(|port| Base::of_width(port.width)).collect();
    let row = |pattern: usize| {
        let inputs: Vec<bool> = (0..bits).rev().map(|bit| pattern >> bit & 1 == 1).collect();
        let expected = match logic.settle(&inputs) {
            Ok(outputs) => outputs.into_iter().map(Some).collect(),
            Err(_) => vec![None; test.output_bits().len()],
        };
        let (bases, span, line) = (bases.clone(), test.span, test.line);
        TestRow { inputs, expected, bases, hold: None, span, line, row: pattern + 1 }
    };
    Ok((0..1 << bits).map(row).collect())
}
