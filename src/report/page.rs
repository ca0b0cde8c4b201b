//! The report of a run as one HTML page that needs nothing else: the verdict, the schematic, and a player in step with the waveform.

use serde_json::{Value, json};

use crate::model::CYCLE_STEPS;
use crate::report::recording::Recording;
use crate::report::sprite::Scheme;
use crate::report::svg::Svg;
use crate::swarm::{Assembly, RowVerdict, Signal, SwarmTrace, TestVerdict};

const STYLE: &str = include_str!("../../assets/report.css");
const SCRIPT: &str = include_str!("../../assets/report.js");

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
    pub schematic: Svg,
    /// The swarm in space and time.
    pub spacetime: Svg,
}

/// The page of a run of the source file with that name.
pub fn draw_page(source: &str, tests: &[PageTest<'_>], scheme: Scheme) -> String {
    let sections: String = tests.iter().enumerate().map(|(i, test)| section(i, test)).collect();
    let palette: Vec<String> = (1..=8).map(|code| scheme.color(code).to_string()).collect();
    let data = json!({ "palette": palette, "tests": tests.iter().map(test_data).collect::<Vec<_>>() });
    // No text of the user's can end the element.
    let data = data.to_string().replace('<', "\\u003c");
    let passed = tests.iter().filter(|test| test.verdict.passed).count();
    let (word, verdict) = if passed == tests.len() { ("pass", "pass") } else { ("fail", "FAIL") };
    let count = tests.len();
    let (source, version) = (escape(source), env!("CARGO_PKG_VERSION"));
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n\
         <title>{verdict}: {source}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{source}</h1>\n\
         <p class=\"verdict {word}\">{verdict}: {passed} of {count} tests passed</p>\n{sections}\
         <footer class=\"dim\"><p>made by nbc {version}</p></footer>\n</main>\n\
         <script id=\"data\" type=\"application/json\">{data}</script>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    )
}

fn section(number: usize, test: &PageTest<'_>) -> String {
    let verdict = test.verdict;
    let word = if verdict.passed { "pass" } else { "fail" };
    let shown = test.recording.robots.len();
    let left_out = match test.trace.robots.len() - shown {
        0 => String::new(),
        _ => format!("<p class=\"dim\">The player has room for the first {shown} robots.</p>\n"),
    };
    let player = if shown == 0 { String::new() } else { PLAYER.to_owned() };
    format!(
        "<section id=\"test-{number}\">\n<h2>{circuit}: {title} <span class=\"{word}\">{word}</span></h2>\n{table}\
         <h3>Schematic</h3>\n<div class=\"scroll picture\" tabindex=\"0\" role=\"group\" aria-label=\"schematic\">{schematic}</div>\n\
         <div class=\"robot\" aria-live=\"polite\"></div>\n{left_out}{player}\
         <details><summary>The swarm in space and time</summary>\n<div class=\"scroll picture\" tabindex=\"0\">{spacetime}</div>\n</details>\n</section>\n",
        circuit = escape(&verdict.circuit),
        title = escape(&verdict.title),
        table = truth_table(verdict),
        schematic = inline(&test.schematic),
        spacetime = inline(&test.spacetime),
    )
}

const PLAYER: &str = "<h3>Robots</h3>\n<div class=\"controls\"><button type=\"button\" class=\"play\">Play</button>\
    <input type=\"range\" class=\"scrub\" min=\"0\" step=\"0.05\" value=\"0\" aria-label=\"time in cycles\">\
    <label>cycles a second <select class=\"speed\"><option>0.5</option><option selected>2</option><option>4</option><option>8</option></select></label>\
    <output class=\"clock\"></output></div>\n<canvas class=\"stage\" role=\"img\" aria-label=\"the robots walking\"></canvas>\n\
    <h3>Waveform</h3>\n<canvas class=\"wave\" role=\"img\" aria-label=\"inputs, robots' bits and outputs over the cycles\"></canvas>\n";

/// A drawing within the page; several drawings may name their parts alike, so the names are no longer identities.
fn inline(svg: &Svg) -> String {
    svg.finish().replace("<g id=\"", "<g data-id=\"")
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
    let bytes: Vec<u8> = recorded.frames.iter().flat_map(|small| small.to_le_bytes()).collect();
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
        "points": recorded.points,
        "frames": base64(&bytes),
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

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Bytes as base64 (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for place in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * place) & 63) as usize];
            text.push(if place <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, coded) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
