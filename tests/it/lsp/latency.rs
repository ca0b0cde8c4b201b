//! How fast the server is and what it holds, measured in release builds on request: `cargo test --release --test it
//! lsp::latency:: -- --ignored --nocapture --test-threads=1`.

use std::time::{Duration, Instant};

use serde_json::json;

use crate::cli::Bench;
use crate::language::programs;
use crate::lsp::client::{Client, file};
use crate::speed::long_program;

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

#[test]
#[ignore = "measures a release build"]
fn measure_latencies() {
    let bench = Bench::new();
    let mut texts: Vec<(String, String)> = programs("circuits")
        .into_iter()
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(&path).unwrap()))
        .collect();
    let long = long_program();
    texts.push(("long.nb".to_owned(), long.clone()));
    texts.push(("faults.nb".to_owned(), long.replace("any(v)", "anyy(v)")));
    println!("| text | lines | median | longest |\n|---|---|---|---|");
    for (name, text) in texts {
        let (uri, text) = file(&bench, &name, &text);
        let mut client = Client::start();
        let times = latencies(&mut client, &uri, &text);
        let (median, longest) = (milliseconds(times[EDITS / 2]), milliseconds(times[EDITS - 1]));
        let lines = text.lines().count();
        println!("| `{name}` | {lines} | {median:.1} ms | {longest:.1} ms |");
        assert!(median < if lines < 1000 { 50.0 } else { 200.0 }, "{name}");
        client.goodbye();
    }
}

/// The memory that a process holds, in megabytes.
fn megabytes(process: u32) -> f64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let held = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    held.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0
}

#[test]
#[ignore = "measures a release build"]
fn measure_memory_over_edits() {
    let bench = Bench::new();
    let path = programs("circuits").into_iter().find(|path| path.ends_with("full_adder.nb")).unwrap();
    let (uri, text) = file(&bench, "a.nb", &std::fs::read_to_string(path).unwrap());
    let mut client = Client::start();
    client.open(&uri, &text);
    let process = client.server.id();
    let mut held = Vec::new();
    println!("| edits | memory |\n|---|---|");
    for at in 1..=100_000 {
        // A letter is typed and taken back; each version is checked, and its lenses and hints are asked for.
        let (start, end) = (json!({ "line": 0, "character": 0 }), json!({ "line": 0, "character": (at + 1) % 2 }));
        let new = if at % 2 == 1 { "/" } else { "" };
        let version = client.edit(&uri, &json!([{ "range": { "start": start, "end": end }, "text": new }]));
        client.published(&uri, version);
        if at % 10 == 0 {
            client.ask("textDocument/codeLens", json!({ "textDocument": { "uri": uri } })).unwrap();
        }
        if [100, 1000, 10_000, 100_000].contains(&at) {
            held.push(megabytes(process));
            println!("| {at} | {:.1} MB |", megabytes(process));
        }
    }
    // Two million edits in two thousand messages.
    let back = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 1 } });
    let there = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 0, "character": 0 } });
    let pair = [json!({ "range": there, "text": "/" }), json!({ "range": back, "text": "" })];
    let thousand: Vec<_> = pair.iter().cycle().take(1000).cloned().collect();
    let mut version = 0;
    for _ in 0..2000 {
        version = client.edit(&uri, &json!(thousand));
    }
    client.published(&uri, version);
    println!("| 2,100,000 | {:.1} MB |", megabytes(process));
    assert!(held[3] - held[0] < 20.0 && megabytes(process) - held[0] < 20.0);
    assert_eq!(client.diagnostics(&uri), json!([]));
    client.goodbye();
}
