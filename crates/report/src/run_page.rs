//! The report of a run as one self-contained HTML page: the verdict, the schematic, and a player in step with the
//! waveform; of tests at the level of logic, their truth tables.

use serde_json::{Value as Json, json};

use crate::color::Scheme;
use crate::html::{Html, base64, controls, escape, picture};
use crate::looks::Looks;
use crate::page_bodies::{cell_data, voxel_data, voxel_looks};
use crate::schematic::SchematicPages;
use crate::schematic::explorer;
use crate::svg::Svg;
use crate::verdict::{describe_test, in_world, named_world};
use nbc_base::diag::counted;
use nbc_base::model::{CYCLE_STEPS, Column, Value};
use nbc_swarm::{Assembly, Recorded, RowActivity, RowVerdict, SimulationResult, SwarmTrace, TestVerdict};

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
    let data = json!({
        "looks": voxel_looks(&looks),
        "swarms": swarms.iter().map(|swarm| swarm_data(swarm, &looks)).collect::<Vec<_>>(),
    });
    Html {
        heading: source,
        passed: swarms.iter().all(|swarm| swarm.outcome.passed()),
        verdict: heading(&tests, &simulations),
        body: swarms.iter().enumerate().map(|(i, swarm)| section(i, swarm)).collect(),
        script: Some((SCRIPT, data)),
    }
    .finish()
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
            Self::Test(verdict) => (truth_table(verdict), verdict.fault()),
            Self::Simulation(result) => (activity_table(result), result.fault.as_ref()),
        };
        let fault = fault.map(|fault| format!("<p class=\"fail\">{}</p>\n", escape(&fault.to_string())));
        table + &fault.unwrap_or_default()
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

fn truth_table(verdict: &TestVerdict) -> String {
    let (inputs, outputs) = (verdict.inputs.len(), verdict.outputs.len());
    let rows: String = verdict.rows.iter().map(truth_row).collect();
    format!(
        "<div class=\"scroll\" tabindex=\"0\"><table>\n<tr><th></th>{}{}{}<th></th><th></th></tr>\n\
         <tr><th>line</th>{}{}{}<th>cycles</th><th></th></tr>\n{rows}</table></div>\n",
        group_head(inputs, "inputs"),
        group_head(outputs, "expected"),
        group_head(outputs, "observed"),
        port_heads(&verdict.inputs),
        port_heads(&verdict.outputs),
        port_heads(&verdict.outputs),
    )
}

fn truth_row(row: &RowVerdict) -> String {
    let word = if row.passed { "pass" } else { "fail" };
    format!(
        "<tr><td>{}</td>{}{}{}<td>{}</td><td class=\"{word}\">{word}</td></tr>\n",
        row.line,
        cells(&row.inputs),
        cells(&row.expected),
        cells(&row.observed),
        row.cycles.map_or(String::new(), |cycles| cycles.to_string()),
    )
}

fn activity_table(result: &SimulationResult) -> String {
    let (inputs, outputs) = (result.inputs.len(), result.outputs.len());
    let row = |row: &RowActivity| {
        let (inputs, observed, changes) = (cells(&row.inputs), cells(&row.observed), cells(&row.changes));
        format!("<tr><td>{}</td>{inputs}<td>{}</td>{observed}{changes}</tr>\n", row.line, row.cycles)
    };
    let rows: String = result.rows.iter().map(row).collect();
    format!(
        "<div class=\"scroll\" tabindex=\"0\"><table>\n<tr><th></th>{}<th></th>{}{}</tr>\n\
         <tr><th>line</th>{}<th>cycles</th>{}{}</tr>\n{rows}</table></div>\n",
        group_head(inputs, "inputs"),
        group_head(outputs, "at the end"),
        group_head(outputs, "changes"),
        port_heads(&result.inputs),
        port_heads(&result.outputs),
        port_heads(&result.outputs),
    )
}

fn group_head(columns: usize, name: &str) -> String {
    if columns == 0 { String::new() } else { format!("<th colspan=\"{columns}\">{name}</th>") }
}

fn port_heads(ports: &[Column]) -> String {
    ports.iter().map(|port| format!("<th>{}</th>", escape(&port.name))).collect()
}

fn cells(values: &[impl ToString]) -> String {
    values.iter().map(|value| format!("<td>{}</td>", escape(&value.to_string()))).collect()
}

fn swarm_data(swarm: &PageSwarm<'_>, looks: &Looks) -> Json {
    let trace = swarm.trace;
    let pairs = trace.cycles.windows(2).enumerate();
    let marks: Vec<usize> = pairs.filter(|(_, pair)| pair[0].inputs != pair[1].inputs).map(|(i, _)| i + 1).collect();
    let robots: Vec<Json> = trace.recording.robots.iter().map(|recorded| robot_data(swarm, recorded, looks)).collect();
    let mut cells = cell_data(swarm.assembly);
    for (k, cell) in cells.iter_mut().enumerate() {
        cell["bits"] = json!(packed(trace.cycles.iter().map(|cycle| cycle.bits[k])));
    }
    let [inputs, outputs] = port_waves(trace);
    json!({
        "pace": trace.recording.frames_per_cycle,
        "robots": robots,
        "cells": cells,
        "schematic": swarm.schematic,
        "cycles": trace.cycles.len(),
        "marks": marks,
        "inputs": inputs,
        "outputs": outputs,
    })
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

fn robot_data(swarm: &PageSwarm<'_>, recorded: &Recorded, looks: &Looks) -> Json {
    let (trace, k) = (swarm.trace, recorded.robot);
    let robot = &trace.robots[k];
    let pace = f64::from(CYCLE_STEPS) / f64::from(trace.recording.frames_per_cycle.max(1));
    let fault = robot.fault.map(|fault| f64::from(fault.env_step) / pace);
    let body = &swarm.assembly.members[k].robot.body;
    let strip = |i: usize| digits(trace.cycles.iter().map(|cycle| cycle.sensed[k].has(i)));
    let sensed: Vec<String> = (0..robot.senses.len()).map(strip).collect();
    json!({
        "cell": k,
        "fault": fault,
        "sensed": sensed,
        "size": [body.width(), body.height()],
        "voxels": voxel_data(recorded, body, looks),
        "corners": recorded.points,
        "frames": base64(&recorded.frames),
    })
}

/// The rows of the inputs and of the outputs in the waveform. An output changes at the end of its cycle. The row of a
/// bit is a text of digits, that of a bus a list of values.
fn port_waves(trace: &SwarmTrace) -> [Vec<Json>; 2] {
    let cycles = 0..trace.cycles.len();
    let words = |port: &Column, value: &dyn Fn(usize) -> Value| {
        let words: Vec<String> = cycles.clone().map(|cycle| value(cycle).to_string()).collect();
        if port.width == 1 { json!(words.concat()) } else { json!(words) }
    };
    let input =
        |(i, port): (usize, &Column)| row(&port.name, "s1", 0, words(port, &|c| trace.input_values(c).swap_remove(i)));
    let output = |(o, port): (usize, &Column)| {
        row(&format!("output {}", port.name), "out", 1, words(port, &|c| trace.output_values(c).swap_remove(o)))
    };
    [trace.inputs.iter().enumerate().map(input).collect(), trace.outputs.iter().enumerate().map(output).collect()]
}

fn row(name: &str, color: &str, shift: usize, values: Json) -> Json {
    json!({ "name": name, "color": color, "shift": shift, "values": values })
}

pub fn draw_logic_page(source: &str, verdicts: &[&TestVerdict]) -> String {
    let passed = verdicts.iter().filter(|verdict| verdict.passed).count();
    let all = verdicts.len();
    let word = if passed == all { "pass" } else { "FAIL" };
    Html {
        heading: source,
        passed: passed == all,
        verdict: format!("{word}: {passed} of {} passed", counted(all, "test")),
        body: verdicts.iter().map(|verdict| logic_section(verdict)).collect(),
        script: None,
    }
    .finish()
}

fn logic_section(verdict: &TestVerdict) -> String {
    let (circuit, title) = (escape(&verdict.circuit), escape(&verdict.title));
    format!("<section>\n<h2>{circuit} {title}</h2>\n<pre>{}</pre>\n</section>\n", escape(&describe_test(verdict)))
}
