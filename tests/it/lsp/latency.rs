//! How fast the server is and what it holds, measured in release builds on request: `cargo test --release --test it
//! lsp::latency:: -- --ignored --nocapture --test-threads=1`.

use std::time::{Duration, Instant};

use serde_json::json;

use crate::lsp::client::{Client, file};
use crate::lsp::typing_client::TypingClient;
use crate::speed::long_program;
use crate::support::bench::Bench;
use crate::support::programs::programs;

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

#[test]
#[ignore = "measures a release build"]
fn measure_memory_over_edits() {
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
    assert!(held.iter().all(|megabytes| megabytes - held[0] < 20.0));
    typing_client.goodbye();
}
