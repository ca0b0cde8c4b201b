//! What editors add to a text: selections, colors, hints, links, lenses.

use crate::lsp::client::{Client, at, file, opened, uri};
use crate::lsp::{ADDER, HALF};

use crate::support::*;

fn whole(uri: &str) -> Value {
    let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 9999, "character": 0 } });
    json!({ "textDocument": { "uri": uri }, "range": range })
}

fn with_hints(text: &str, hints: &Value) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let mut hints = hints.as_array().unwrap().clone();
    hints.sort_by_key(|hint| hint["position"]["character"].as_u64());
    for hint in hints.iter().rev() {
        let (line, column) = (&hint["position"]["line"], &hint["position"]["character"]);
        let label = format!("<{}>", hint["label"].as_str().unwrap());
        lines[line.as_u64().unwrap() as usize].insert_str(column.as_u64().unwrap() as usize, &label);
    }
    lines.join("\n")
}

const CALLS: &str = "\
circuit mix(a, b) -> (q) {
    q = a nand b
}

circuit f(x[4], a) -> (q) {
    t = x xor {4{a}}
    q = mix(a, any(t)) and mix(any(t), a)
}
";

#[test]
fn hints_show_widths_ports_and_robots_and_can_be_switched_off() {
    let bench = Bench::new();
    let (uri, text) = file(&bench, "a.nb", CALLS);
    let off = |kind: &str| json!({ "inlayHints": { kind: false } });
    let expected = [
        (off("robots"), "t<[4]> = x", "mix(a, <b:>any(t)) and mix(<a:>any(t), <b:>a)"),
        (json!({ "inlayHints": { "robots": false, "widths": false } }), "t = x", "mix(a, <b:>any(t))"),
        (json!({ "inlayHints": { "robots": false, "parameters": false } }), "t<[4]> = x", "mix(a, any(t))"),
    ];
    for (options, net, call) in expected {
        let mut client = Client::initialized(&json!({ "initializationOptions": options, "capabilities": {} }));
        client.open(&uri, &text);
        let hints = client.ask("textDocument/inlayHint", whole(&uri)).unwrap();
        let shown = with_hints(&text, &hints);
        assert!(shown.contains(net) && shown.contains(call) && !shown.contains("robot"), "{options}: {shown}");
        client.goodbye();
    }
}

#[test]
fn robots_of_circuits_appear_as_soon_as_they_are_compiled() {
    let bench = Bench::new();
    let (uri, text) = file(&bench, "a.nb", CALLS);
    let refresh = json!({ "workspace": { "inlayHint": { "refreshSupport": true } } });
    let mut client = Client::with(&refresh);
    client.open(&uri, &text);
    client.ask("textDocument/inlayHint", whole(&uri)).unwrap();
    // The first answer may be complete already; else the server asks for another request.
    let mut shown = String::new();
    while !shown.contains("circuit mix(a, b) -> (q)<1 robot, clock ") || shown.matches(", clock ").count() < 2 {
        let hints = client.ask("textDocument/inlayHint", whole(&uri)).unwrap();
        shown = with_hints(&text, &hints);
    }
    let settings = json!({ "settings": { "nbc": { "inlayHints": { "robots": false } } } });
    client.tell("workspace/didChangeConfiguration", settings);
    let hints = client.ask("textDocument/inlayHint", whole(&uri)).unwrap();
    assert!(!with_hints(&text, &hints).contains("robot"));
    client.goodbye();
}

#[test]
fn what_depends_on_settings_and_files_is_asked_for_again() {
    let bench = Bench::new();
    file(&bench, "half.nb", HALF);
    let (full, text) = file(&bench, "full.nb", ADDER);
    let can = json!({ "refreshSupport": true });
    let all = ["workspace/codeLens/refresh", "workspace/inlayHint/refresh", "workspace/semanticTokens/refresh"];
    let cases = [
        (json!({ "codeLens": can, "inlayHint": can, "semanticTokens": can }), &all[..]),
        (json!({ "inlayHint": can }), &all[1..2]),
        (json!({}), &[]),
    ];
    for (abilities, expected) in cases {
        let mut client = Client::with(&json!({ "workspace": abilities }));
        client.open(&full, &text);
        let asked = |client: &mut Client, method: &str, parameters: Value| {
            client.tell(method, parameters);
            client.diagnostics(&full);
            std::mem::take(&mut client.requests)
        };
        let settings = |is_on: bool| json!({ "settings": { "nbc": { "codeLenses": is_on } } });
        let configured = "workspace/didChangeConfiguration";
        assert_eq!(asked(&mut client, configured, settings(false)), expected);
        assert_eq!(asked(&mut client, configured, settings(false)), [""; 0], "nothing has changed");
        let changed = |name: &str| json!({ "changes": [{ "uri": uri(&bench.path().join(name)), "type": 2 }] });
        let watched = "workspace/didChangeWatchedFiles";
        assert_eq!(asked(&mut client, watched, changed("half.nb")), expected);
        assert_eq!(asked(&mut client, watched, changed("full.nb")), [""; 0], "an open text is that of the editor");
        client.goodbye();
    }
}

#[test]
fn a_selection_grows_from_the_word_to_the_file() {
    let (_bench, mut client, uri, text) = opened("a.nb", CALLS);
    let asked = json!({ "textDocument": { "uri": uri }, "positions": [at(&text, "any(t))")] });
    let found = client.ask("textDocument/selectionRange", asked).unwrap();
    let mut ranges = Vec::new();
    let mut next = &found[0];
    while next.is_object() {
        ranges.push(client.text(&text, &next["range"]));
        next = &next["parent"];
    }
    let line = "mix(a, any(t)) and mix(any(t), a)";
    let statement = format!("q = {line}");
    let wanted = ["any", "any(t)", "mix(a, any(t))", line, statement.as_str()];
    let found: Vec<&str> = ranges.iter().map(String::as_str).filter(|range| wanted.contains(range)).collect();
    assert_eq!(found, wanted);
    assert_eq!(ranges.last().map(String::as_str), Some(text.as_str()));
    assert!(ranges.windows(2).all(|pair| pair[0].len() < pair[1].len()), "{ranges:?}");
    client.goodbye();
}

#[test]
fn every_token_has_its_meaning() {
    let bench = Bench::new();
    let text = "// é\nuse \"half.nb\"\ncircuit f[n = 2](a[n]) -> (q) {\n    (q, _) = half(a[0], a[1])\n}\n\
                swarm s { circuit: f }\né\n";
    file(&bench, "half.nb", HALF);
    let (uri, text) = file(&bench, "a.nb", text);
    let mut client = Client::start();
    let legend = client.capabilities()["semanticTokensProvider"]["legend"]["tokenTypes"].clone();
    client.open(&uri, &text);
    let tokens = client.ask("textDocument/semanticTokens/full", json!({ "textDocument": { "uri": uri } })).unwrap();
    let (mut line, mut column, mut found) = (0, 0, Vec::new());
    for token in tokens["data"].as_array().unwrap().chunks(5) {
        let number = |at: usize| token[at].as_u64().unwrap() as usize;
        column = if number(0) == 0 { column + number(1) } else { number(1) };
        line += number(0);
        let units: Vec<u16> = text.lines().nth(line).unwrap().encode_utf16().collect();
        let word = String::from_utf16(&units[column..column + number(2)]).unwrap();
        found.push((word, legend[number(3)].as_str().unwrap().to_owned(), number(4)));
    }
    let expected = [
        ("// é", "comment", 0),
        ("use", "keyword", 0),
        ("\"half.nb\"", "string", 0),
        ("circuit", "keyword", 0),
        ("f", "function", 1),
        ("n", "typeParameter", 1),
        ("2", "number", 0),
        ("a", "parameter", 1),
        ("q", "variable", 1),
        ("half", "function", 0),
        ("a", "parameter", 0),
        ("swarm", "keyword", 0),
        ("s", "class", 1),
        ("circuit", "property", 0),
    ];
    for (word, kind, modifiers) in expected {
        let wanted = (word.to_owned(), kind.to_owned(), modifiers);
        assert!(found.contains(&wanted), "{wanted:?}: {found:?}");
    }
    let range = json!({ "start": at(&text, "swarm"), "end": at(&text, "{ circuit: f") });
    let asked = json!({ "textDocument": { "uri": uri }, "range": range });
    let some = client.ask("textDocument/semanticTokens/range", asked);
    assert_eq!(some.unwrap()["data"].as_array().unwrap().len(), 2 * 5);
    client.goodbye();
}

#[test]
fn files_and_folders_that_a_source_names_are_links() {
    let bench = Bench::new();
    file(&bench, "half.nb", HALF);
    fs::create_dir(bench.path().join("robots")).unwrap();
    let text = format!("{ADDER}\nlibrary mine {{ from: \"robots\" }}\nuse \"missing.nb\"\n");
    let (full, text) = file(&bench, "full.nb", &text);
    let mut client = Client::start();
    client.open(&full, &text);
    let links = client.ask("textDocument/documentLink", json!({ "textDocument": { "uri": full } })).unwrap();
    let found: Vec<_> = links
        .as_array()
        .unwrap()
        .iter()
        .map(|link| (client.text(&text, &link["range"]), link["target"].clone()))
        .collect();
    let target = |name: &str| (name.to_owned(), json!(uri(&bench.path().join(name))));
    assert_eq!(found, [target("half.nb"), target("robots")]);
    client.goodbye();
}

#[test]
fn the_declarations_in_a_range_are_formatted_and_the_others_stay() {
    let (_bench, mut client, uri, text) = opened("a.nb", "circuit f(a)->(q){q=a}\n\n\n\ncircuit g(a)->(q){q=f(a)}\n");
    let range = json!({ "start": at(&text, "circuit g"), "end": at(&text, "q=f") });
    let asked =
        json!({ "textDocument": { "uri": uri }, "range": range, "options": { "tabSize": 4, "insertSpaces": true } });
    let edits = client.ask("textDocument/rangeFormatting", asked).unwrap();
    let after = client.edited(&text, edits.as_array().unwrap());
    assert_eq!(after, "circuit f(a)->(q){q=a}\n\n\n\ncircuit g(a) -> (q) {\n    q = f(a)\n}\n");
    client.goodbye();
}
