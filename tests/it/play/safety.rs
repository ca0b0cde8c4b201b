//! Strangers, and pages that misbehave.

use tungstenite::Message;

use super::LATCH;
use super::page::Server;
use crate::support::*;

fn inner() -> (Bench, Server) {
    let bench = Bench::with("secret.nb", "circuit secret(a) -> (b) { b = a }");
    bench.file("inner/latch.nb", LATCH);
    let server = Server::start(&bench.path().join("inner"), &["latch.nb"]);
    (bench, server)
}

#[test]
fn only_the_page_with_the_token_comes_in() {
    let (_folder, server) = inner();
    let host = format!("Host: {}\r\n", server.host());
    let own = format!("/{}/", server.token());
    let (head, body) = server.get(&own, &host);
    assert!(head.starts_with("HTTP/1.1 200"), "{head}");
    for header in ["content-security-policy: default-src 'none'", "referrer-policy: no-referrer", "nosniff"] {
        assert!(head.to_lowercase().contains(header), "{head}");
    }
    assert!(String::from_utf8(body).unwrap().contains("<title>"));
    for (path, headers, status) in [
        ("/", host.clone(), 404),
        ("/wrong/", host.clone(), 404),
        (&own, "Host: evil.example\r\n".to_owned(), 403),
        (&own, format!("{host}Origin: http://evil.example\r\n"), 403),
        (&own, format!("{host}Host: evil.example\r\n"), 403),
        (&own, format!("Host: evil.example\r\n{host}"), 403),
        (&format!("http://evil.example{own}"), host.clone(), 403),
        (&format!("{own}take/1/a.csv"), host.clone(), 404),
        (&format!("{own}../../etc/passwd"), host.clone(), 404),
        (&format!("{own}nothing"), host.clone(), 404),
    ] {
        let (head, _) = server.get(path, &headers);
        assert!(head.starts_with(&format!("HTTP/1.1 {status}")), "{path}: {head}");
    }
    for socket in ["live", "language"] {
        assert_eq!(server.socket(socket, "http://evil.example").err(), Some(403));
        assert!(server.socket(socket, &format!("http://{}", server.host())).is_ok());
    }
}

#[test]
fn nothing_outside_of_the_folder_is_read_or_written() {
    let (folder, server) = inner();
    let mut page = server.page();
    for path in ["../secret.nb", "/etc/passwd", "inner/../../secret.nb"] {
        let refused = page.ask(json!({ "do": "read", "path": path })).unwrap_err();
        assert!(refused["message"].as_str().unwrap().ends_with("it is outside of the folder"), "{refused}");
    }
    let refused = page.ask(json!({ "do": "save", "path": "../new.nb", "text": "", "stamp": null })).unwrap_err();
    assert!(refused["message"].as_str().unwrap().contains("outside"), "{refused}");
    assert!(!folder.path().join("new.nb").exists());
    for path in ["a\u{1b}[2J.nb", "a\n.nb", "\u{202e}a.nb", "\0.nb", "a\u{200b}.nb"] {
        let refused = page.ask(json!({ "do": "save", "path": path, "text": "", "stamp": null })).unwrap_err();
        assert!(refused["message"].as_str().unwrap().ends_with("has characters that cannot be seen"), "{refused}");
    }
    let text = "use \"../secret.nb\"";
    let program = page.done(json!({ "do": "program", "path": "a.nb", "text": text }));
    assert!(program["diagnostics"][0]["message"].as_str().unwrap().contains("outside"), "{program}");
    fs::write(
        folder.path().join("inner/a.v"),
        "`include \"../secret.nb\"\nmodule a(input b, output c); assign c = b; endmodule\n",
    )
    .unwrap();
    let program = page.done(json!({ "do": "program", "path": "a.nb", "text": "use \"a.v\"" }));
    let installed = program["diagnostics"][0]["message"].as_str().unwrap();
    let expected = ["'../secret.nb': No such file or directory", "which is not installed"];
    assert!(expected.iter().any(|words| installed.contains(words)), "{program}");
}

#[test]
fn a_page_that_sends_too_much_is_disconnected_and_others_go_on() {
    let (_folder, server) = inner();
    let mut other = server.page();
    let mut large = server.page();
    // The server may close before all is written.
    let _ = large.socket.send(Message::text("x".repeat(2 << 20)));
    assert!((0..10).any(|_| large.socket.read().is_err()));
    let mut many = server.page();
    let request = Message::text(json!({ "id": 1, "do": "reset" }).to_string());
    let flooded = (0..20_000).any(|_| {
        many.socket.send(request.clone()).is_err() || { matches!(many.socket.read(), Err(_) | Ok(Message::Close(_))) }
    });
    assert!(flooded);
    assert_eq!(other.done(json!({ "do": "files" })).as_array().unwrap().len(), 1);
}

#[test]
fn small_texts_that_would_make_much_are_refused_and_the_page_goes_on() {
    let (_folder, server) = inner();
    let mut page = server.page();
    for (name, text) in crate::budget::rows() {
        let program = page.done(json!({ "do": "program", "path": "small.nb", "text": text }));
        let codes: Vec<&Value> = program["diagnostics"].as_array().unwrap().iter().map(|one| &one["code"]).collect();
        assert_eq!(codes, ["too-large"], "{name}");
        let test = page.ask(json!({ "do": "test", "path": "small.nb", "test": 0, "level": "logic" }));
        assert!(test.unwrap_err()["diagnostics"].to_string().contains("too-large"), "{name}");
    }
    page.compile("latch.nb", LATCH);
}

#[test]
fn work_is_limited_and_can_be_stopped() {
    let (_folder, server) = inner();
    let mut page = server.page();
    let evolve = json!({ "do": "evolve", "body": null, "box": [3, 2], "generations": 1000, "seed": 1 });
    let running: Vec<u64> = (0..4).map(|_| page.begin(evolve.clone())).collect();
    let refused = page.ask(evolve).unwrap_err();
    assert_eq!(refused["code"], "busy");
    for id in running {
        page.done(json!({ "do": "cancel", "of": id }));
        assert_eq!(page.wait(id).unwrap_err()["code"], "cancelled");
    }
    page.compile("latch.nb", LATCH);
}
