//! Input that is not as expected: files that are not text, floods of edits.

use crate::lsp::HALF;
use crate::lsp::client::{at, file, opened, place, uri};
use crate::lsp::renaming::client_of;
use crate::lsp::typing_client::TypingClient;

use crate::support::*;

const NOT_TEXT: &[u8] = b"circuit half(a, b) -> (s, c) {\n    s = \xff\n}\n";

fn messages(found: &Value) -> Vec<&str> {
    found.as_array().unwrap().iter().map(|problem| problem["message"].as_str().unwrap()).collect()
}

#[test]
fn a_used_file_that_is_not_utf_8_is_a_diagnostic_until_it_is_text() {
    let bench = Bench::new();
    let half = bench.file("half.nb", NOT_TEXT);
    bench.file("cells.blif", NOT_TEXT);
    let text = "use \"half.nb\"\nuse \"cells.blif\"\n\ncircuit f(a, b) -> (q) {\n    (q, _) = half(a, b)\n}\n";
    let (own, text) = file(&bench, "a.nb", text);
    let mut client = client_of(&bench);
    client.open(&own, &text);
    let found = client.diagnostics(&own);
    let broken: Vec<_> = messages(&found).into_iter().filter(|message| message.contains("not valid UTF-8")).collect();
    assert!(broken.len() == 2 && broken.iter().all(|message| message.contains("(byte 39)")), "{found}");
    assert_eq!(found[0]["range"]["start"], at(&text, "\"half.nb\""));
    // What needs all files of the workspace still answers.
    let symbols = client.ask("workspace/symbol", json!({ "query": "" })).unwrap();
    assert_eq!((symbols.as_array().unwrap().len(), &symbols[0]["name"]), (1, &json!("f")), "{symbols}");
    let mut asked = place(&own, &text, "f(a");
    asked["newName"] = json!("g");
    let edit = client.ask("textDocument/rename", asked).unwrap();
    assert_eq!(edit["changes"][&own].as_array().unwrap().len(), 1);

    bench.file("half.nb", HALF);
    bench.file("cells.blif", ".model cells\n.inputs a\n.outputs q\n.names a q\n1 1\n.end\n");
    let changed = ["half.nb", "cells.blif"].map(|name| json!({ "uri": uri(&bench.path().join(name)), "type": 2 }));
    client.tell("workspace/didChangeWatchedFiles", json!({ "changes": changed }));
    assert_eq!(client.diagnostics(&own), json!([]), "{}", half.display());
    client.goodbye();
}

#[test]
fn edits_that_come_at_once_are_checked_once() {
    let (_bench, mut client, uri, _) = opened("a.nb", &crate::long_program::long_program());
    client.diagnostics(&uri);
    let start = json!({ "line": 0, "character": 0 });
    let edits = 40;
    let versions = (0..edits).map(|_| {
        let new = json!([{ "range": { "start": start, "end": start }, "text": "// typed\n" }]);
        client.edit(&uri, &new)
    });
    let last = versions.last().unwrap();
    let checks = client.published(&uri, last);
    assert!(checks < edits, "each of {edits} edits was checked");
    client.goodbye();
}

#[test]
#[cfg(target_os = "linux")]
fn memory_after_40_000_edits_is_that_after_100() {
    let bench = Bench::new();
    let mut typing_client = TypingClient::start(&bench);
    typing_client.type_until(100, 1);
    let before = typing_client.megabytes();
    typing_client.type_until(40_000, 50);
    let after = typing_client.megabytes();
    assert!(after - before < 8.0, "{before:.1} MB became {after:.1} MB");
    typing_client.goodbye();
}

#[test]
fn small_texts_that_would_make_much_are_diagnostics() {
    let (_bench, mut client, uri, _) = opened("a.nb", HALF);
    assert_eq!(client.diagnostics(&uri), json!([]));
    for (name, text) in crate::budget::rows() {
        client.change(&uri, &text);
        let found = client.diagnostics(&uri);
        assert_eq!((found[0]["code"].as_str(), found.as_array().unwrap().len()), (Some("too-large"), 1), "{name}");
    }
    client.goodbye();
}
