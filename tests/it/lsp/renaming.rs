//! Uses of names over files, and new names.

use crate::lsp::client::{Client, at, file, place, uri};
use crate::lsp::{ADDER, HALF};

use crate::support::*;

#[test]
fn a_new_name_is_written_in_all_open_files() {
    let bench = Bench::new();
    let (half, half_text) = file(&bench, "half.nb", HALF);
    let (full, text) = file(&bench, "full.nb", ADDER);
    let mut client = Client::start();
    client.open(&full, &text);
    client.open(&half, &half_text);
    let uses = client.ask("textDocument/references", {
        let mut asked = place(&half, &half_text, "half");
        asked["context"] = json!({ "includeDeclaration": false });
        asked
    });
    assert_eq!(uses.unwrap().as_array().unwrap().len(), 2);
    let mut asked = place(&full, &text, "half(a");
    asked["newName"] = json!("adder");
    let edit = client.ask("textDocument/rename", asked.clone()).unwrap();
    let changes = edit["changes"].as_object().unwrap();
    assert_eq!((changes[&half].as_array().unwrap().len(), changes[&full].as_array().unwrap().len()), (1, 2));
    asked["newName"] = json!("and");
    assert!(client.ask("textDocument/rename", asked).unwrap_err().contains("`and` is not a name"));
    // Ports are renamed in tests too.
    let mut asked = place(&full, &text, "co = c1");
    asked["newName"] = json!("carry");
    let edit = client.ask("textDocument/rename", asked).unwrap();
    assert_eq!(edit["changes"][&full].as_array().unwrap().len(), 3);
    let highlights = client.ask("textDocument/documentHighlight", place(&full, &text, "t, c1")).unwrap();
    assert_eq!(highlights.as_array().unwrap().len(), 2);
    client.goodbye();
}

pub(super) fn client_of(bench: &Bench) -> Client {
    let folder = json!({ "uri": uri(bench.path()), "name": "bench" });
    Client::initialized(&json!({ "workspaceFolders": [folder], "capabilities": {} }))
}

#[test]
fn a_new_name_is_written_in_files_that_are_not_open() {
    let bench = Bench::new();
    let (half, text) = file(&bench, "half.nb", HALF);
    let (full, _) = file(&bench, "full.nb", ADDER);
    fs::create_dir(bench.path().join("out")).unwrap();
    file(&bench, "out/copy.nb", ADDER);
    let mut client = client_of(&bench);
    client.open(&half, &text);
    let mut asked = place(&half, &text, "half");
    asked["newName"] = json!("adder");
    let edit = client.ask("textDocument/rename", asked.clone()).unwrap();
    let changes = edit["changes"].as_object().unwrap();
    assert_eq!(changes.keys().collect::<Vec<_>>(), [&full, &half], "results are no sources");
    let after = client.edited(ADDER, changes[&full].as_array().unwrap());
    assert_eq!(after, ADDER.replace("half(", "adder("));
    // A file that changes on the disk is read again.
    file(&bench, "full.nb", &format!("// moved\n{ADDER}"));
    let edit = client.ask("textDocument/rename", asked).unwrap();
    assert_eq!(edit["changes"][&full][0]["range"]["start"]["line"], 5);
    client.goodbye();
}

#[test]
fn a_new_name_that_clashes_is_refused() {
    let bench = Bench::new();
    let (half, _) = file(&bench, "half.nb", HALF);
    let (full, _) = file(&bench, "full.nb", ADDER);
    let text = "circuit f(a, b) -> (q) {\n    t = add(a, b)\n    q = half(t, b)\n}\n\n\
                circuit half(a, b) -> (q) {\n    q = a xor b\n}\n";
    let (other, text) = file(&bench, "other.nb", text);
    let mut client = client_of(&bench);
    client.open(&half, HALF);
    client.open(&other, &text);
    let mut refused = |uri: &str, text: &str, word: &str, new: &str| {
        let mut asked = place(uri, text, word);
        asked["newName"] = json!(new);
        client.ask("textDocument/rename", asked).unwrap_err()
    };
    let message = refused(&half, HALF, "half", "full");
    assert!(message.starts_with("`full` cannot be the new name: "), "a file that is not open: {full} {message}");
    assert!(refused(&half, HALF, "c) {", "s").contains("cannot be the new name"));
    assert!(refused(&other, &text, "t =", "a").contains("cannot be the new name"));
    // No error, but the call of the standard circuit would become one of this circuit.
    assert_eq!(refused(&other, &text, "half(a", "add"), "`add` has another meaning where the name is used");
    assert!(refused(&half, HALF, "half", "4x").contains("`4x` is not a name"));
    client.goodbye();
}

#[test]
fn declarations_are_found_in_the_workspace() {
    let bench = Bench::new();
    let (half, _) = file(&bench, "half.nb", HALF);
    let (full, text) = file(&bench, "full.nb", ADDER);
    let mut client = client_of(&bench);
    client.open(&full, &text);
    let found = client.ask("workspace/symbol", json!({ "query": "HAL" })).unwrap();
    assert_eq!(found.as_array().unwrap().len(), 1, "{found}");
    assert_eq!((&found[0]["name"], &found[0]["location"]["uri"]), (&json!("half"), &json!(half)));
    assert_eq!(found[0]["location"]["range"]["start"], at(HALF, "half"));
    let all = client.ask("workspace/symbol", json!({ "query": "" })).unwrap();
    assert_eq!(all.as_array().unwrap().len(), 2, "nets are no symbols of a workspace: {all}");
    let removed = json!({ "event": { "added": [], "removed": [{ "uri": uri(bench.path()), "name": "bench" }] } });
    client.tell("workspace/didChangeWorkspaceFolders", removed);
    let left = client.ask("workspace/symbol", json!({ "query": "" })).unwrap();
    assert_eq!(left.as_array().unwrap().len(), 1, "only the open file: {left}");
    client.goodbye();
}
