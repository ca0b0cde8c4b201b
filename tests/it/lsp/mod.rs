//! `nbc lsp` in the real program, with a client that speaks the protocol over pipes.

mod bad_input;
mod client;
mod editors;
mod hovers;
mod protocol;
mod renaming;
mod runs;
mod typing_client;
#[cfg(target_os = "linux")]
mod verilog;
mod views;
mod writing;

use std::io::Write;

use client::{Client, at, file, opened, place};

use crate::support::*;

pub(crate) const ADDER: &str = "\
use \"half.nb\"

// Adds two bits and a carry.
circuit full(a, b, c) -> (s, co) {
    (t, c1) = half(a, b)
    (s, c2) = half(t, c)
    co = c1 or c2
}

test full {
    a b c | s co
    1 1 0 | 0 1
}
";

pub(crate) const HALF: &str = "\
// Adds two bits.
circuit half(a, b) -> (s, c) {
    s = a xor b
    c = a and b
}
";

#[test]
fn errors_are_published_while_typing_and_fixed_by_quick_fixes() {
    let (_bench, mut client, uri, text) = opened("a.nb", "circuit gate(a, b) -> (q) {\n    q = a & b\n}\n");
    let found = client.diagnostics(&uri);
    let [problem] = &found.as_array().unwrap()[..] else { panic!("{found}") };
    assert_eq!((&problem["code"], &problem["severity"]), (&json!("syntax"), &json!(1)));
    assert_eq!(problem["range"]["start"], at(&text, "&"));
    let page = problem["codeDescription"]["href"].as_str().unwrap().strip_prefix("file://").unwrap();
    assert!(fs::read_to_string(page).unwrap().contains("# "), "the page of the code is there to be read");

    let asked = json!({ "textDocument": { "uri": uri }, "range": problem["range"], "context": { "diagnostics": [] } });
    let actions = client.ask("textDocument/codeAction", asked).unwrap();
    let edit = &actions[0]["edit"]["changes"][&uri][0];
    assert_eq!(edit["newText"], "and");

    let change = json!({ "textDocument": { "uri": uri, "version": 2 },
        "contentChanges": [{ "range": edit["range"], "text": edit["newText"] }] });
    client.tell("textDocument/didChange", change);
    assert_eq!(client.diagnostics(&uri), json!([]));
    client.goodbye();
}

#[test]
fn a_problem_shows_its_related_places_in_other_files() {
    let bench = Bench::new();
    let (half, _) = file(&bench, "half.nb", HALF);
    let (uri, text) = file(&bench, "a.nb", "use \"half.nb\"\n\ncircuit half(a) -> (q) {\n    q = a\n}\n");
    let mut client = Client::start();
    client.open(&uri, &text);
    client.open(&half, HALF);
    let all = [client.diagnostics(&uri), client.diagnostics(&half)];
    let problem = all.iter().flat_map(|list| list.as_array().unwrap()).find(|problem| problem["code"] == "duplicate");
    let problem = problem.unwrap_or_else(|| panic!("{all:?}"));
    let places: Vec<_> = problem["relatedInformation"].as_array().unwrap().iter().map(|one| &one["location"]).collect();
    let [place] = &places[..] else { panic!("{problem}") };
    let (other, word) = if place["uri"] == half { (HALF, "half") } else { (text.as_str(), "half(a)") };
    assert_eq!(place["range"]["start"], at(other, word), "{problem}");
    client.goodbye();
}

#[test]
fn names_lead_to_their_declarations_in_other_files_and_in_the_prelude() {
    let bench = Bench::new();
    let (half, _) = file(&bench, "half.nb", HALF);
    let text = ADDER.replace("c1 or c2", "latch(c1, c2)");
    let (full, text) = file(&bench, "full.nb", &text);
    let mut client = Client::start();
    client.open(&full, &text);
    let found = client.ask("textDocument/definition", place(&full, &text, "half(t")).unwrap();
    assert_eq!(found, json!({ "uri": half, "range": { "start": at(HALF, "half"), "end": at(HALF, "(a, b)") } }));
    let found = client.ask("textDocument/definition", place(&full, &text, "latch")).unwrap();
    let prelude = fs::read_to_string(found["uri"].as_str().unwrap().strip_prefix("file://").unwrap()).unwrap();
    let line = found["range"]["start"]["line"].as_u64().unwrap() as usize;
    assert!(prelude.lines().nth(line).unwrap().starts_with("circuit latch"), "{found}");
    let nothing = client.ask("textDocument/definition", place(&full, &text, "1 1 0")).unwrap();
    assert_eq!(nothing, Value::Null);
    client.goodbye();
}

#[test]
fn a_text_is_formatted_as_by_the_program() {
    let (bench, mut client, uri, _) = opened("a.nb", "circuit   f(a)->(q){q=not a}\n");
    let asked = json!({ "textDocument": { "uri": uri }, "options": { "tabSize": 4, "insertSpaces": true } });
    let edits = client.ask("textDocument/formatting", asked.clone()).unwrap();
    bench.ok("fmt a.nb");
    assert_eq!(edits[0]["newText"], bench.read("a.nb"));
    let change = json!({ "textDocument": { "uri": uri, "version": 2 }, "contentChanges": [{ "text": "circuit f(" }] });
    client.tell("textDocument/didChange", change);
    assert_eq!(client.ask("textDocument/formatting", asked).unwrap(), Value::Null, "a broken text stays as it is");
    client.goodbye();
}

#[test]
fn declarations_are_listed_folded_and_completed() {
    let bench = Bench::new();
    file(&bench, "half.nb", HALF);
    let (full, text) = file(&bench, "full.nb", &ADDER.replace("carry.", "carry.\n// With two halves."));
    let mut client = Client::start();
    client.open(&full, &text);
    let document = json!({ "textDocument": { "uri": full } });
    let symbols = client.ask("textDocument/documentSymbol", document.clone()).unwrap();
    let names: Vec<_> = symbols.as_array().unwrap().iter().map(|symbol| symbol["detail"].as_str().unwrap()).collect();
    assert_eq!(names, ["circuit", "test"]);
    assert_eq!(symbols[0]["children"].as_array().unwrap().len(), 5);
    let folds = client.ask("textDocument/foldingRange", document).unwrap();
    let line = |word: &str| at(&text, word)["line"].clone();
    let circuit = (&line("circuit"), &line("}"), &json!("region"));
    let found: Vec<_> = folds.as_array().unwrap().iter().collect();
    let found: Vec<_> = found.iter().map(|fold| (&fold["startLine"], &fold["endLine"], &fold["kind"])).collect();
    assert!(found.len() == 3 && found[0] == circuit, "{folds}");
    assert_eq!(found[2], (&line("// Adds"), &line("// With"), &json!("comment")));
    let mut labels = |word: &str| -> Vec<String> {
        let items = client.ask("textDocument/completion", place(&full, &text, word)).unwrap();
        items.as_array().unwrap().iter().map(|item| item["label"].as_str().unwrap().to_owned()).collect()
    };
    let inside = labels("c1 or");
    for wanted in ["half", "latch", "t", "c2", "table"] {
        assert!(inside.iter().any(|label| label == wanted), "{wanted}: {inside:?}");
    }
    assert!(labels("\n// Adds").iter().any(|label| label == "circuit"));
    client.goodbye();
}

#[test]
fn characters_are_counted_as_was_agreed() {
    let bench = Bench::new();
    let (uri, text) = file(&bench, "a.nb", "// 𝔸é\ncircuit f(a) -> (q) { q = a /* */ }\n");
    for (encodings, character) in [(json!(["utf-16"]), 4), (json!(["utf-8", "utf-16"]), 7)] {
        let mut client = Client::with(&json!({ "general": { "positionEncodings": encodings } }));
        client.open(&uri, &text);
        let change = json!({ "textDocument": { "uri": uri, "version": 2 }, "contentChanges": [{
            "range": { "start": { "line": 0, "character": 3 }, "end": { "line": 0, "character": character + 2 } },
            "text": "text" }] });
        client.tell("textDocument/didChange", change);
        let folds = client.diagnostics(&uri);
        assert_eq!(folds[0]["range"]["start"]["line"], 1, "the comment kept its line: {folds}");
        client.goodbye();
    }
}

#[test]
fn wrong_messages_are_answered_and_the_server_goes_on() {
    let (_bench, mut client, uri, _) = opened("a.nb", HALF);
    assert!(client.ask("workspace/nonsense", json!({})).unwrap_err().contains("`workspace/nonsense`"));
    assert!(client.ask("textDocument/hover", json!({ "position": 3 })).is_err());
    let far = json!({ "textDocument": { "uri": uri }, "position": { "line": 4_000_000, "character": 9 } });
    assert_eq!(client.ask("textDocument/hover", far).unwrap(), Value::Null);
    let unopened = json!({ "textDocument": { "uri": "untitled:x" }, "position": { "line": 0, "character": 0 } });
    assert_eq!(client.ask("textDocument/hover", unopened).unwrap(), Value::Null);
    client.tell("textDocument/didChange", json!("nonsense"));
    client.tell("$/unknown", json!({}));
    assert_eq!(client.diagnostics(&uri), json!([]));
    client.goodbye();
}

#[test]
fn a_text_without_a_file_and_a_closed_one_are_served() {
    let mut client = Client::start();
    client.open("untitled:one", "circuit f(");
    assert_eq!(client.diagnostics("untitled:one")[0]["severity"], 1);
    client.tell("textDocument/didClose", json!({ "textDocument": { "uri": "untitled:one" } }));
    assert_eq!(client.diagnostics("untitled:one"), json!([]));
    client.goodbye();
}

#[test]
fn the_server_ends_when_its_client_vanishes() {
    for message in ["", "Content-Length: 3\r\n\r\n{x}", "Content-Length: 2\r\n\r\n\u{fffd}", "nonsense\r\n\r\n"] {
        let mut client = Client::start();
        let mut input = client.input.take().unwrap();
        let _ = input.write_all(message.as_bytes());
        drop(input);
        let status = client.server.wait().unwrap();
        assert!(matches!(status.code(), Some(0 | 2)), "{message:?}: {status}");
    }
}
