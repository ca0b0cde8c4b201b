//! Clients that break the protocol, or say goodbye in their own way.

use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};
use std::time::Instant;

use lsp_server::ErrorCode;

use crate::lsp::client::opened;
use crate::support::*;

fn frame(message: &Value) -> String {
    let text = message.to_string();
    format!("Content-Length: {}\r\n\r\n{text}", text.len())
}

fn request(id: i32, method: &str, params: &Value) -> String {
    frame(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }))
}

fn told(method: &str) -> String {
    frame(&json!({ "jsonrpc": "2.0", "method": method }))
}

/// The exit status of a server that is sent some bytes, and for each answer its number and the code of its error.
fn talk(sent: &[String]) -> (Option<i32>, Vec<(Value, i64)>) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_nbc"));
    let command = command.arg("lsp").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut server = command.spawn().unwrap();
    // A server that has ended reads no more.
    let _ = server.stdin.take().unwrap().write_all(sent.concat().as_bytes());
    let ended = limits::end(server);
    let mut output = BufReader::new(&ended.stdout[..]);
    let mut answers = Vec::new();
    while let Some(text) = body(&mut output) {
        answers.push((text["id"].clone(), text["error"]["code"].as_i64().unwrap_or(0)));
    }
    (ended.status.code(), answers)
}

fn body(output: &mut impl BufRead) -> Option<Value> {
    let mut line = String::new();
    output.read_line(&mut line).unwrap();
    let length = line.trim().strip_prefix("Content-Length: ")?.parse().unwrap();
    output.read_line(&mut line).unwrap();
    let mut bytes = vec![0; length];
    output.read_exact(&mut bytes).unwrap();
    Some(serde_json::from_slice(&bytes).unwrap())
}

fn start() -> String {
    request(1, "initialize", &json!({ "capabilities": {} })) + &told("initialized")
}

const OK: i64 = 0;
const INVALID: i64 = ErrorCode::InvalidRequest as i64;

#[test]
fn nothing_is_answered_after_shutdown_and_exit_has_the_status_of_the_protocol() {
    let hover = request(3, "textDocument/hover", &json!({}));
    let shut = request(2, "shutdown", &Value::Null);
    let (status, answers) = talk(&[start(), shut.clone(), hover.clone(), shut, told("exit"), hover]);
    assert_eq!(status, Some(0));
    assert_eq!(answers, [(json!(1), OK), (json!(2), OK), (json!(3), INVALID), (json!(2), INVALID)]);
    assert_eq!(talk(&[start(), told("exit")]).0, Some(1));
    assert_eq!(talk(&[told("exit")]).0, Some(1));
}

#[test]
fn the_first_request_is_initialize_with_an_object() {
    let early = ErrorCode::ServerNotInitialized as i64;
    let wrong = ErrorCode::InvalidParams as i64;
    let sent = [
        request(5, "textDocument/hover", &json!({})),
        told("textDocument/didChange"),
        request(6, "initialize", &json!([])),
        start(),
        request(7, "initialize", &json!({})),
        request(8, "shutdown", &Value::Null),
        told("exit"),
    ];
    let (status, answers) = talk(&sent);
    assert_eq!(status, Some(0));
    let expected = [(5, early), (6, wrong), (1, OK), (7, INVALID), (8, OK)];
    assert_eq!(answers, expected.map(|(id, code)| (json!(id), code)));
}

#[test]
fn a_check_ends_when_the_text_has_changed_meanwhile() {
    const SMALL: &str = "circuit f(a) -> (q) {\n    q = not a\n}\n";
    // Its check takes most of the steps that a program may take.
    let slow = |name: &str| {
        let turn = "_ = a and a and a and a and a and a";
        format!("circuit {name}(a) -> (q) {{\nfor i in 0..180000 {{\n{turn}\n}}\nq = a\n}}\n")
    };
    let (_bench, mut client, uri, _) = opened("a.nb", SMALL);
    let mut least = f64::INFINITY;
    for round in 0..3 {
        let begun = Instant::now();
        client.change(&uri, &slow(&format!("f{round}")));
        assert_eq!(client.diagnostics(&uri), json!([]));
        let whole = begun.elapsed();
        let begun = Instant::now();
        client.change(&uri, &slow(&format!("g{round}")));
        std::thread::sleep(whole / 4);
        client.change(&uri, SMALL);
        assert_eq!(client.diagnostics(&uri), json!([]));
        least = least.min(begun.elapsed().as_secs_f64() / whole.as_secs_f64());
    }
    assert!(least < 0.7, "the new text has its diagnostics after {least:.2} of the time of the old one");
    client.goodbye();
}
