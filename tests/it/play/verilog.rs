//! Verilog on the page: Yosys ends when the page leaves.

use tungstenite::Message;

use super::page::Server;
use crate::support::slow_yosys::{SlowYosys, USER, ended};
use crate::support::*;

#[test]
fn yosys_ends_when_the_page_leaves() {
    let slow = SlowYosys::new();
    let server = Server::run(slow.program().args(["play", "--no-open", "a.nb"]));
    let mut page = server.page();
    page.begin(json!({ "do": "program", "path": "a.nb", "text": USER }));
    let yosys = slow.begun();
    drop(page);
    ended(yosys);
}

#[test]
fn a_check_can_be_cancelled_and_nothing_waits_for_it() {
    let slow = SlowYosys::new();
    let server = Server::run(slow.program().args(["play", "--no-open", "a.nb"]));
    let mut page = server.page();
    let check = json!({ "do": "program", "path": "a.nb", "text": USER });
    let first = page.begin(check.clone());
    let yosys = slow.begun();
    assert!(page.done(json!({ "do": "files" })).to_string().contains("m.v"));
    page.begin(json!({ "do": "cancel", "of": first }));
    assert_eq!(page.event(|answer| answer["id"] == json!(first))["error"]["code"], "cancelled");
    ended(yosys);
    // Another text for the same path takes the place of the one that is being checked.
    let older = page.begin(check);
    let yosys = slow.begun();
    let newer = page.done(json!({ "do": "program", "path": "a.nb", "text": "circuit f(a) -> (q) { q = a }" }));
    assert_eq!((&newer["errors"], newer["circuits"].as_array().unwrap().len()), (&json!(0), 1));
    assert_eq!(page.event(|answer| answer["id"] == json!(older))["error"]["code"], "cancelled");
    ended(yosys);
}

#[test]
fn yosys_ends_when_the_editor_of_the_page_leaves() {
    let slow = SlowYosys::new();
    let server = Server::run(slow.program().args(["play", "--no-open", "a.nb"]));
    let mut editor = server.socket("language", &format!("http://{}", server.host())).unwrap();
    let uri = format!("file://{}", slow.bench.path().canonicalize().unwrap().join("a.nb").display());
    let document = json!({ "uri": uri, "languageId": "nb", "version": 1, "text": USER });
    for message in [
        json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": { "capabilities": {} } }),
        json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }),
        json!({ "jsonrpc": "2.0", "method": "textDocument/didOpen", "params": { "textDocument": document } }),
    ] {
        editor.send(Message::text(message.to_string())).unwrap();
    }
    let yosys = slow.begun();
    drop(editor);
    ended(yosys);
}
