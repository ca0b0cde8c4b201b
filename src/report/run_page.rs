//! The report of a run as one HTML page that needs nothing else: the verdict, the schematic, and a player in step with the waveform.

use serde_json::{Value, json};

use crate::model::CYCLE_STEPS;
use crate::report::html::{Html, base64, controls, escape, picture};
use crate::report::recording::Recording;
use crate::report::sprite::Scheme;
use crate::report::svg::Svg;
use crate::swarm::{Assembly, RowVerdict, Signal, SwarmTrace, TestVerdict};

const SCRIPT: &str = include_str!("../../assets/page/swarm.js");

/// One test on the page.
pub struct PageTest<'a> {
    /// What it came to.
    pub verdict: &'a TestVerdict,
    /// What the swarm did.
    pub trace: &'a SwarmTrace,
    /// The swarm's robots.
    pub assembly: &'a Assembly,
    /// The robots' film.
    pub recording: Recording,
    /// The circuit.
    pub schematic: &'a Svg,
    /// The swarm in space and time.
    pub spacetime: &'a Svg,
}

/// The page of a run of the source file with that name.
pub fn draw_run_page(source: &str, tests: &[PageTest<'_>], scheme: Scheme) -> String {
    let palette: Vec<String> = (1..=8).map(|code| scheme.color(code).to_string()).collect();
    let (passed, count) = (tests.iter().filter(|test| test.verdict.passed).count(), tests.len());
    let word = if passed == count { "pass" } else { "FAIL" };
    Html {
        heading: source,
        passed: passed == count,
        verdict: format!("{word}: {passed} of {count} tests passed"),
        body: tests.iter().enumerate().map(|(i, test)| section(i, test)).collect(),
        data: json!({ "palette": palette, "tests": tests.iter().map(test_data).collect::<Vec<_>>() }),
        script: SCRIPT,
    }
    .finish()
}

fn section(number: usize, test: &PageTest<'_>) -> String {
    let verdict = test.verdict;
    let word = if verdict.passed { "pass" } else { "fail" };
    let shown = test.recording.robots.len();
    let left_out = match test.trace.robots.len() - shown {
        0 => String::new(),
        _ => format!("<p class=\"dim\">The player has room for the first {shown} robots.</p>\n"),
    };
    let player = if shown == 0 { String::new() } else { player() };
    format!(
        "<section id=\"test-{number}\">\n<h2>{circuit}: {title} <span class=\"{word}\">{word}</span></h2>\n{table}\
         <h3>Schematic</h3>\n<div class=\"beside\">{schematic}<div class=\"robot\" aria-live=\"polite\"></div></div>\n{left_out}{player}\
         <details><summary>The swarm in space and time</summary>\n{spacetime}</details>\n</section>\n",
        circuit = escape(&verdict.circuit),
        title = escape(&verdict.title),
        table = truth_table(verdict),
        schematic = picture(test.schematic, "schematic"),
        spacetime = picture(test.spacetime, "paths of the robots over time"),
    )
}

fn player() -> String {
    format!(
        "<h3>Robots</h3>\n{}<canvas class=\"stage\" role=\"img\" aria-label=\"the robots walking\"></canvas>\n\
         <h3>Waveform</h3>\n<canvas class=\"wave\" role=\"img\" aria-label=\"inputs, robots' bits and outputs over the cycles\"></canvas>\n",
        controls("2")
    )
}

fn truth_table(verdict: &TestVerdict) -> String {
    let head = |names: &[String]| names.iter().map(|name| format!("<th>{}</th>", escape(name))).collect::<String>();
    let (inputs, outputs) = (verdict.inputs.len(), verdict.outputs.len());
    let rows: String = verdict.rows.iter().map(truth_row).collect();
    format!(
        "<div class=\"scroll\" tabindex=\"0\"><table>\n<tr><th colspan=\"{inputs}\">inputs</th><th colspan=\"{outputs}\">expected</th>\
         <th colspan=\"{outputs}\">observed</th><th></th><th></th></tr>\n<tr>{}{}{}<th>cycles</th><th></th></tr>\n{rows}</table></div>\n",
        head(&verdict.inputs),
        head(&verdict.outputs),
        head(&verdict.outputs),
    )
}

fn truth_row(row: &RowVerdict) -> String {
    let cell = |bit: Option<bool>| format!("<td>{}</td>", bit.map_or("-", |bit| if bit { "1" } else { "0" }));
    let inputs: String = row.inputs.iter().map(|&bit| cell(Some(bit))).collect();
    let expected: String = row.expected.iter().map(|&bit| cell(bit)).collect();
    let observed: String = row.observed.iter().map(|&bit| cell(Some(bit))).collect();
    let word = if row.passed { "pass" } else { "fail" };
    format!("<tr>{inputs}{expected}{observed}<td>{}</td><td class=\"{word}\">{word}</td></tr>\n", row.hold)
}

/// What the player needs of one test.
fn test_data(test: &PageTest<'_>) -> Value {
    let trace = test.trace;
    let pairs = trace.cycles.windows(2).enumerate();
    let marks: Vec<usize> = pairs.filter(|(_, pair)| pair[0].inputs != pair[1].inputs).map(|(i, _)| i + 1).collect();
    let robots: Vec<Value> = (0..test.recording.robots.len()).map(|k| robot_data(test, k)).collect();
    let cycles: Vec<Value> = trace.cycles.iter().map(|cycle| json!({ "sensed": bits(&cycle.sensed) })).collect();
    json!({
        "pace": test.recording.frames_per_cycle,
        "robots": robots,
        "cycles": cycles,
        "marks": marks,
        "waves": waves(trace),
    })
}

fn bits(sensed: &[[bool; 2]]) -> Vec<[u8; 2]> {
    sensed.iter().map(|pair| pair.map(u8::from)).collect()
}

fn robot_data(test: &PageTest<'_>, k: usize) -> Value {
    let (recorded, robot, member) = (&test.recording.robots[k], &test.trace.robots[k], &test.assembly.members[k]);
    let pace = f64::from(CYCLE_STEPS) / f64::from(test.recording.frames_per_cycle.max(1));
    let fault = robot.fault.map(|fault| f64::from(fault.env_step) / pace);
    let voxels: Vec<[usize; 5]> =
        recorded.voxels.iter().map(|&([a, b, c, d], code)| [a, b, c, d, usize::from(code)]).collect();
    let body = &member.robot.body;
    let character = &member.robot.character;
    let wired = |i: usize| match robot.senses[i] {
        Signal::Constant(value) => format!("nothing (always {})", u8::from(value)),
        Signal::Input(_) | Signal::Robot(_) => robot.sensed_nets[i].clone(),
    };
    json!({
        "net": robot.net,
        "function": robot.function.name(),
        "fault": fault,
        "size": [body.width(), body.height()],
        "voxels": voxels,
        "corners": recorded.points,
        "frames": base64(&recorded.frames),
        "about": [
            ["robot", robot.robot.as_str()],
            ["behavior", &member.robot.behavior.to_string()],
            ["stimulus 1", &wired(0)],
            ["stimulus 2", &wired(1)],
            ["body", &body.rows().join(" ")],
            ["clock", &format!("{} cycles, margin {:.3} voxels a cycle", character.clock, character.margin)],
            ["errors", &format!("{:.2} % of {} switches", character.error_rate * 100.0, character.switches)],
        ],
    })
}

/// The rows of the waveform: inputs, robots, outputs; what a cycle puts out holds from its end.
fn waves(trace: &SwarmTrace) -> Vec<Value> {
    let row = |name: &str, color: &str, shift: usize, bits: Vec<bool>| {
        let bits: Vec<u8> = bits.into_iter().map(u8::from).collect();
        json!({ "name": name, "color": color, "shift": shift, "bits": bits })
    };
    let inputs = trace
        .inputs
        .iter()
        .enumerate()
        .map(|(i, name)| row(name, "s1", 0, trace.cycles.iter().map(|cycle| cycle.inputs[i]).collect()));
    let robots = trace
        .robots
        .iter()
        .enumerate()
        .map(|(k, robot)| row(&robot.net, "dim", 1, trace.cycles.iter().map(|cycle| cycle.bits[k]).collect()));
    let outputs = trace.outputs.iter().enumerate().map(|(o, name)| {
        row(&format!("output {name}"), "out", 1, trace.cycles.iter().map(|cycle| cycle.outputs[o]).collect())
    });
    inputs.chain(robots).chain(outputs).collect()
}
