//! Those who take more than their share, or look where the token may be seen.

use std::net::TcpStream;
use std::process::Command;
use std::thread;
use std::time::Duration;

use tungstenite::{Message, WebSocket};

use super::page::{Server, served};
use crate::support::*;

fn text(message: &Value) -> Message {
    Message::text(message.to_string())
}

fn answer(socket: &mut WebSocket<TcpStream>) -> Value {
    loop {
        let Message::Text(text) = socket.read().unwrap() else { continue };
        let value: Value = serde_json::from_str(&text).unwrap();
        if value.get("method").is_none() {
            return value;
        }
    }
}

#[test]
fn a_number_that_is_in_use_is_refused() {
    let (_folder, _server, mut page) = served(&[]);
    let mut evolve = json!({ "do": "evolve", "body": null, "box": [3, 3], "generations": 1000, "seed": 1 });
    let id = page.begin(evolve.clone());
    evolve["id"] = json!(id);
    for _ in 0..40 {
        page.send(&evolve);
    }
    for _ in 0..40 {
        assert_eq!(page.wait(id).unwrap_err()["code"], "in-use");
    }
    page.done(json!({ "do": "cancel", "of": id }));
    assert_eq!(page.wait(id).unwrap_err()["code"], "cancelled");
}

#[test]
#[cfg(unix)]
fn those_who_stay_silent_keep_nobody_out() {
    let folder = tempfile::tempdir().unwrap();
    // With fewer files than usual, so that this test does not need many itself.
    let mut limited = Command::new("sh");
    limited.args(["-c", "ulimit -n 256; exec \"$0\" play --no-open", env!("CARGO_BIN_EXE_nbc")]);
    let server = Server::run(limited.current_dir(folder.path()));
    let _silent: Vec<TcpStream> = (0..300).map(|_| TcpStream::connect(server.host()).unwrap()).collect();
    assert!(server.fetch("").0.starts_with("HTTP/1.1 200"));
}

#[test]
fn a_full_server_says_so_to_people() {
    let folder = Bench::new();
    let server = Server::start(folder.path(), &[]);
    let mut pages: Vec<_> = (0..32).map(|_| server.page()).collect();
    let (head, body) = server.fetch("");
    assert!(head.starts_with("HTTP/1.1 503") && head.contains("text/html"), "{head}");
    assert!(String::from_utf8(body).unwrap().contains("no room for another page"));
    pages.truncate(30);
    // The server hears of it a moment later.
    let has_room = || {
        thread::sleep(Duration::from_millis(50));
        server.fetch("").0.starts_with("HTTP/1.1 200")
    };
    assert!((0..100).any(|_| has_room()));
}

#[test]
fn what_is_no_message_of_the_language_server_is_answered_by_an_error() {
    let (_folder, server, _) = served(&[]);
    let mut socket = server.socket("language", &format!("http://{}", server.host())).unwrap();
    let initialize = |params: Value| json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": params });
    for (message, id, code) in [
        (Message::text("nonsense"), json!(null), -32700),
        (text(&json!([])), json!(null), -32600),
        (text(&json!(["initialize"])), json!(null), -32600),
        (text(&json!("initialize")), json!(null), -32600),
        (text(&initialize(json!([]))), json!(1), -32602),
        (text(&initialize(json!("x"))), json!(1), -32602),
        (text(&initialize(json!(null))), json!(1), -32602),
    ] {
        let asked = message.to_string();
        socket.send(message).unwrap();
        let refused = answer(&mut socket);
        assert_eq!((&refused["id"], &refused["error"]["code"]), (&id, &json!(code)), "{asked}");
    }
    socket.send(text(&initialize(json!({ "capabilities": {} })))).unwrap();
    assert!(answer(&mut socket)["result"]["capabilities"].is_object());
}

#[cfg(target_os = "linux")]
fn memory_of(process: u32) -> u64 {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap() >> 10
}

#[test]
#[cfg(target_os = "linux")]
fn messages_that_nobody_has_time_for_wait_at_their_sender() {
    let (_folder, server, _) = served(&[]);
    let mut socket = server.socket("language", &format!("http://{}", server.host())).unwrap();
    let initialize = json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": { "capabilities": {} } });
    socket.send(text(&initialize)).unwrap();
    answer(&mut socket);
    socket.send(text(&json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }))).unwrap();
    // A program that takes long to check, whose check a request waits for.
    let circuits: String = (0..4000).map(|i| format!("circuit c{i}(a, b) -> (q) {{ q = a and b }}\n")).collect();
    let document = json!({ "uri": "file:///a.nb", "languageId": "nb", "version": 1, "text": circuits });
    let open = json!({ "jsonrpc": "2.0", "method": "textDocument/didOpen", "params": { "textDocument": document } });
    socket.send(text(&open)).unwrap();
    socket
        .send(text(&json!({ "jsonrpc": "2.0", "id": 2, "method": "workspace/symbol", "params": { "query": "c7" } })))
        .unwrap();
    let before = memory_of(server.process());
    socket.get_mut().set_write_timeout(Some(Duration::from_secs(2))).unwrap();
    let large = text(&json!({ "jsonrpc": "2.0", "method": "x", "params": { "text": "x".repeat(1_000_000) } }));
    let sent = (0..300).take_while(|_| socket.send(large.clone()).is_ok()).count();
    let after = memory_of(server.process());
    assert!(after < before + 150, "{sent} messages: from {before} to {after} MiB");
}

#[test]
#[cfg(unix)]
fn the_token_is_not_among_the_arguments_of_the_browser() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (browser, told) = (folder.path().join("xdg-open"), folder.path().join("told"));
    fs::write(&browser, format!("#!/bin/sh\necho \"$@\" > '{0}.new'\nmv '{0}.new' '{0}'\n", told.display())).unwrap();
    fs::set_permissions(&browser, fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    let server = Server::run(
        Command::new(env!("CARGO_BIN_EXE_nbc"))
            .arg("play")
            .current_dir(folder.path())
            .env("PATH", path)
            .env("TMPDIR", folder.path()),
    );
    limits::until("no browser is opened", || told.exists());
    let opened = fs::read_to_string(&told).unwrap();
    assert!(!opened.contains(server.token()), "{opened}");
    let file = Path::new(opened.trim());
    assert!(fs::read_to_string(file).unwrap().contains(&format!("url={}\"", server.address)));
    assert_eq!(fs::metadata(file).unwrap().permissions().mode() & 0o777, 0o600);
}

#[test]
fn scripts_are_small_and_kept_and_the_document_is_not() {
    let (_folder, server, _) = served(&[]);
    let (head, body) = server.fetch("");
    assert!(head.contains("no-store"), "{head}");
    let html = String::from_utf8(body).unwrap();
    let start = html.find("app-").unwrap();
    let names: Vec<&str> = html[start..].split('"').filter(|part| part.starts_with("app-")).collect();
    assert_eq!(names.len(), 2, "{html}");
    for name in names {
        let host = format!("Host: {}\r\n", server.host());
        let path = format!("/{}/{name}", server.token());
        let (head, packed) = server.get(&path, &format!("{host}Accept-Encoding: gzip, br\r\n"));
        assert!(head.contains("content-encoding: gzip") && head.contains("immutable"), "{head}");
        let (plain_head, plain) = server.get(&path, &host);
        assert!(!plain_head.contains("content-encoding"), "{plain_head}");
        assert!(packed.starts_with(&[0x1f, 0x8b]) && 2 * packed.len() < plain.len(), "{}", packed.len());
    }
    assert!(server.fetch("app.js").0.starts_with("HTTP/1.1 404"));
}
