//! How fast the language server is, and what it holds: `cargo bench --bench editing`. It takes some minutes.

// Files of the tests have more than this needs.
#![allow(dead_code, unused_imports)]

use std::process::ExitCode;
use std::time::{Duration, Instant};

use serde_json::json;

use aims::Aims;
use client::{Client, file};
use long_program::long_program;
use support::bench::Bench;
use support::programs::programs;
use typing_client::TypingClient;

mod aims;
#[path = "../tests/it/lsp/client.rs"]
mod client;
#[path = "../tests/it/long_program.rs"]
mod long_program;
#[path = "../tests/it/support/mod.rs"]
mod support;
#[path = "../tests/it/lsp/typing_client.rs"]
mod typing_client;

/// The names by which these files know each other in the tests.
mod lsp {
    pub(crate) use super::client;
}

fn main() -> ExitCode {
    let mut aims = Aims::default();
    measure_latencies(&mut aims);
    measure_memory(&mut aims);
    aims.end()
}

/// Edits of each text.
const EDITS: usize = 40;

/// The times from an edit to its diagnostics, in order of length.
fn latencies(client: &mut Client, uri: &str, text: &str) -> Vec<Duration> {
    client.open(uri, text);
    client.diagnostics(uri);
    let last = text.lines().count();
    let mut times: Vec<Duration> = (0..EDITS)
        .map(|at| {
            let (start, new) = (json!({ "line": last, "character": 0 }), if at % 2 == 0 { "// typed\n" } else { "" });
            let end = if at % 2 == 0 { start.clone() } else { json!({ "line": last + 1, "character": 0 }) };
            let before = Instant::now();
            let version = client.edit(uri, &json!([{ "range": { "start": start, "end": end }, "text": new }]));
            client.published(uri, version);
            before.elapsed()
        })
        .collect();
    times.sort();
    times
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

fn measure_latencies(aims: &mut Aims) {
    let bench = Bench::new();
    let mut texts: Vec<(String, String)> = programs("circuits")
        .into_iter()
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(&path).unwrap()))
        .collect();
    let long = long_program();
    texts.push(("long.nb".to_owned(), long.clone()));
    texts.push(("faults.nb".to_owned(), long.replace("any(v)", "anyy(v)")));
    println!("| text | lines | median | longest |\n|---|---|---|---|");
    let (mut short_longest, mut long_longest) = (0.0f64, 0.0f64);
    for (name, text) in texts {
        let (uri, text) = file(&bench, &name, &text);
        let mut client = Client::start();
        let times = latencies(&mut client, &uri, &text);
        let (median, longest) = (milliseconds(times[EDITS / 2]), milliseconds(times[EDITS - 1]));
        let lines = text.lines().count();
        println!("| `{name}` | {lines} | {median:.1} ms | {longest:.1} ms |");
        let longest = if lines < 1000 { &mut short_longest } else { &mut long_longest };
        *longest = longest.max(median);
        client.goodbye();
    }
    aims.check(short_longest < 50.0, "a text of less than 1,000 lines is checked in 50 ms");
    aims.check(long_longest < 50.0, "a text of 10,000 lines is checked in 50 ms");
}

fn measure_memory(aims: &mut Aims) {
    let bench = Bench::new();
    let mut typing_client = TypingClient::start(&bench);
    println!("| edits | memory |\n|---|---|");
    let mut held = Vec::new();
    // The first edits come in a message each; a million cannot.
    for (edits, each) in [(100, 1), (1000, 1), (10_000, 1), (100_000, 1), (1_000_000, 1000), (2_000_000, 1000)] {
        typing_client.type_until(edits, each);
        held.push(typing_client.megabytes());
        println!("| {edits} | {:.1} MB |", typing_client.megabytes());
    }
    let is_bounded = held.iter().all(|megabytes| megabytes - held[0] < 20.0);
    aims.check(is_bounded, "two million edits take less than 20 MB");
    typing_client.goodbye();
}
