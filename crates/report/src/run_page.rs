//! The report of a run as one self-contained HTML page: the verdict, the schematic, and a player in step with the
//! waveform; of tests at the level of logic, their truth tables.

use serde::Serialize;

use crate::color::Scheme;
use crate::html::{Html, controls, escape, page_json, picture};
use crate::looks::Looks;
use crate::page_bodies::{PageCell, RecordedBody, VoxelLook, page_cells, voxel_looks};
use crate::schematic::SchematicPages;
use crate::schematic::explorer;
use crate::svg::Svg;
use crate::truth_table::TruthTable;
use crate::verdict::{describe_test, in_world, named_world};
use nbc_base::diag::counted;
use nbc_base::model::{CYCLE_STEPS, Column, Value};
use nbc_swarm::{Assembly, Recorded, SimulationResult, SwarmTrace, TestVerdict};

const SCRIPT: &str = include_str!("../page/run.js");

#[derive(Clone, Copy)]
pub enum SwarmOutcome<'a> {
    Test(&'a TestVerdict),
    Simulation(&'a SimulationResult),
}

pub struct PageSwarm<'a> {
    pub outcome: SwarmOutcome<'a>,
    pub trace: &'a SwarmTrace,
    pub assembly: &'a Assembly,
    pub schematic: &'a SchematicPages,
    pub spacetime: &'a Svg,
    pub timing: String,
}

pub fn draw_run_page(source: &str, swarms: &[PageSwarm<'_>], scheme: Scheme) -> String {
    let members = swarms.iter().flat_map(|swarm| &swarm.assembly.members);
    let looks = Looks::of(members.map(|member| &member.robot.body), scheme);
    let (tests, simulations): (Vec<SwarmOutcome<'_>>, Vec<SwarmOutcome<'_>>) =
        swarms.iter().map(|swarm| swarm.outcome).partition(|outcome| matches!(outcome, SwarmOutcome::Test(_)));
    let recorded = swarms.iter().map(|swarm| RecordedSwarm::of(swarm, &looks)).collect();
    let data = page_json(&RunData { looks: voxel_looks(&looks), swarms: recorded });
    Html {
        heading: source,
        passed: swarms.iter().all(|swarm| swarm.outcome.passed()),
        verdict: heading(&tests, &simulations),
        body: swarms.iter().enumerate().map(|(i, swarm)| section(i, swarm)).collect(),
        script: Some((SCRIPT, data)),
    }
    .finish()
}

#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RunData<'a> {
    looks: Vec<VoxelLook>,
    swarms: Vec<RecordedSwarm<'a>>,
}

#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct RecordedSwarm<'a> {
    /// Frames in a cycle.
    pace: u32,
    robots: Vec<RecordedRobot>,
    cells: Vec<RecordedCell>,
    schematic: &'a SchematicPages,
    cycles: usize,
    /// The cycles at which inputs change.
    marks: Vec<usize>,
    inputs: Vec<WaveRow>,
    outputs: Vec<WaveRow>,
}

#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct RecordedCell {
    #[serde(flatten)]
    cell: PageCell,
    /// Hexadecimal digits of four cycles each, the first cycle highest.
    bits: String,
}

#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct RecordedRobot {
    /// Its place among the cells.
    cell: usize,
    /// The frame in which it became unstable.
    fault: Option<f64>,
    /// For each stimulus, a digit a cycle.
    sensed: Vec<String>,
    /// Columns and rows.
    size: [usize; 2],
    #[serde(flatten)]
    body: RecordedBody,
}

/// A row of a waveform, whose values apply `shift` cycles later.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct WaveRow {
    name: String,
    /// The name of its color in the style sheet.
    color: &'static str,
    shift: usize,
    values: WaveValues,
}

/// The digits of a bit, or the values of a bus.
#[derive(Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
enum WaveValues {
    Bit(String),
    Bus(Vec<String>),
}

/// `pass: 2 of 2 tests passed, 1 simulation`
fn heading(tests: &[SwarmOutcome<'_>], simulations: &[SwarmOutcome<'_>]) -> String {
    let passed = |outcomes: &[SwarmOutcome<'_>]| outcomes.iter().filter(|outcome| outcome.passed()).count();
    let failed = simulations.len() - passed(simulations);
    let word = if passed(tests) == tests.len() && failed == 0 { "pass" } else { "FAIL" };
    let tested = format!("{} of {} passed", passed(tests), counted(tests.len(), "test"));
    let simulated = match failed {
        0 => counted(simulations.len(), "simulation"),
        _ => format!("{failed} of {} failed", counted(simulations.len(), "simulation")),
    };
    match (tests.len(), simulations.len()) {
        (0, _) if failed == 0 => simulated,
        (0, _) => format!("{word}: {simulated}"),
        (_, 0) => format!("{word}: {tested}"),
        _ => format!("{word}: {tested}, {simulated}"),
    }
}

impl SwarmOutcome<'_> {
    fn passed(self) -> bool {
        match self {
            Self::Test(verdict) => verdict.passed,
            Self::Simulation(result) => result.fault.is_none(),
        }
    }

    fn heading(self) -> String {
        let of_swarm = |swarm: &str| format!(" as {}", escape(swarm));
        match self {
            Self::Test(verdict) => {
                let swarm = verdict.swarm.as_deref().map_or(String::new(), of_swarm);
                let word = if verdict.passed { "pass" } else { "fail" };
                let (circuit, title) = (escape(&verdict.circuit), escape(&verdict.title));
                let world = escape(&named_world(verdict));
                format!("{circuit}{swarm}{world}: {title} <span class=\"{word}\">{word}</span>")
            }
            Self::Simulation(result) => {
                let world = escape(&in_world(&result.world));
                format!("{}{}{world}, simulated", escape(&result.circuit), of_swarm(&result.swarm))
            }
        }
    }

    fn table(self) -> String {
        let (table, fault) = match self {
            Self::Test(verdict) => {
                let rows = verdict.rows.iter().map(|row| (row, row.passed));
                (TruthTable::of_test(verdict, rows), verdict.fault.clone())
            }
            Self::Simulation(result) => {
                (TruthTable::of_simulation(result), result.fault.as_ref().map(ToString::to_string))
            }
        };
        let fault = fault.map(|fault| format!("<p class=\"fail\">{}</p>\n", escape(&fault)));
        table.html() + &fault.unwrap_or_default()
    }
}

fn section(number: usize, swarm: &PageSwarm<'_>) -> String {
    format!(
        "<section id=\"swarm-{number}\">\n<h2>{heading}</h2>\n{table}<h3>Schematic</h3>\n{explorer}{player}\
         <details><summary>The swarm in space and time</summary>\n{spacetime}</details>\n\
         <details><summary>Timing, in cycles</summary>\n<pre>{timing}</pre></details>\n</section>\n",
        heading = swarm.outcome.heading(),
        table = swarm.outcome.table(),
        explorer = explorer(),
        player = player(),
        spacetime = picture(swarm.spacetime, "paths of the robots over time"),
        timing = escape(&swarm.timing),
    )
}

fn player() -> String {
    format!(
        "<h3>Robots of the sheet</h3>\n{}<p class=\"dim unrecorded\"></p>\n<div class=\"stage\"></div>\n\
         <h3>Waveform of the sheet</h3>\n<div class=\"wave\"></div>\n",
        controls("2")
    )
}

impl<'a> RecordedSwarm<'a> {
    fn of(swarm: &PageSwarm<'a>, looks: &Looks) -> Self {
        let trace = swarm.trace;
        let pairs = trace.cycles.windows(2).enumerate();
        let cell = |(k, cell)| RecordedCell { cell, bits: packed(trace.cycles.iter().map(|cycle| cycle.bits[k])) };
        let [inputs, outputs] = port_waves(trace);
        Self {
            pace: trace.recording.frames_per_cycle,
            robots: trace.recording.robots.iter().map(|robot| RecordedRobot::of(swarm, robot, looks)).collect(),
            cells: page_cells(swarm.assembly).into_iter().enumerate().map(cell).collect(),
            schematic: swarm.schematic,
            cycles: trace.cycles.len(),
            marks: pairs.filter(|(_, pair)| pair[0].inputs != pair[1].inputs).map(|(i, _)| i + 1).collect(),
            inputs,
            outputs,
        }
    }
}

/// A bit in each cycle, four of them in a hexadecimal digit, the first one highest.
fn packed(bits: impl Iterator<Item = bool>) -> String {
    let bits: Vec<bool> = bits.collect();
    let digit = |four: &[bool]| {
        let value = (0..4).fold(0, |value, i| 2 * value + u32::from(four.get(i).copied().unwrap_or(false)));
        char::from_digit(value, 16).expect("four bits are a digit")
    };
    bits.chunks(4).map(digit).collect()
}

fn digits(bits: impl Iterator<Item = bool>) -> String {
    bits.map(|bit| if bit { '1' } else { '0' }).collect()
}

impl RecordedRobot {
    fn of(swarm: &PageSwarm<'_>, recorded: &Recorded, looks: &Looks) -> Self {
        let (trace, k) = (swarm.trace, recorded.robot);
        let robot = &trace.robots[k];
        let pace = f64::from(CYCLE_STEPS) / f64::from(trace.recording.frames_per_cycle.max(1));
        let body = &swarm.assembly.members[k].robot.body;
        let strip = |i: usize| digits(trace.cycles.iter().map(|cycle| cycle.sensed[k].has(i)));
        Self {
            cell: k,
            fault: robot.fault.map(|fault| f64::from(fault.env_step) / pace),
            sensed: (0..robot.senses.len()).map(strip).collect(),
            size: [body.width(), body.height()],
            body: RecordedBody::of(recorded, body, looks),
        }
    }
}

/// The rows of the inputs and of the outputs in the waveform. An output changes at the end of its cycle.
fn port_waves(trace: &SwarmTrace) -> [Vec<WaveRow>; 2] {
    let values = |port: &Column, value: &dyn Fn(usize) -> Value| {
        let words: Vec<String> = (0..trace.cycles.len()).map(|cycle| value(cycle).to_string()).collect();
        if port.width == 1 { WaveValues::Bit(words.concat()) } else { WaveValues::Bus(words) }
    };
    let input = |(i, port): (usize, &Column)| {
        let values = values(port, &|cycle| trace.input_values(cycle).swap_remove(i));
        WaveRow { name: port.name.clone(), color: "s1", shift: 0, values }
    };
    let output = |(o, port): (usize, &Column)| {
        let values = values(port, &|cycle| trace.output_values(cycle).swap_remove(o));
        WaveRow { name: format!("output {}", port.name), color: "out", shift: 1, values }
    };
    [trace.inputs.iter().enumerate().map(input).collect(), trace.outputs.iter().enumerate().map(output).collect()]
}

pub fn draw_logic_page(source: &str, verdicts: &[&TestVerdict]) -> String {
    let tests: Vec<SwarmOutcome<'_>> = verdicts.iter().map(|verdict| SwarmOutcome::Test(verdict)).collect();
    Html {
        heading: source,
        passed: tests.iter().all(|test| test.passed()),
        verdict: heading(&tests, &[]),
        body: verdicts.iter().map(|verdict| logic_section(verdict)).collect(),
        script: None,
    }
    .finish()
}

fn logic_section(verdict: &TestVerdict) -> String {
    let (circuit, title) = (escape(&verdict.circuit), escape(&verdict.title));
    format!("<section>\n<h2>{circuit} {title}</h2>\n<pre>{}</pre>\n</section>\n", escape(&describe_test(verdict)))
}
