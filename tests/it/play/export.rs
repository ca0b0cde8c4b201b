//! Circuits as pages of their own. `web/test/player.test.mjs` opens them in a browser.

use std::fs;

use serde_json::json;

use super::LATCH;
use super::page::Server;
use crate::support::bench::Bench;
use crate::support::schema::validate;

const TWO: &str = "circuit one(a) -> (q) {\n    q = not a\n}\n\ncircuit two(a, b) -> (q) {\n    q = a xor b\n}\n";

#[test]
fn a_circuit_is_written_as_one_file_and_the_command_says_so() {
    let bench = Bench::new();
    bench.file("latch.nb", LATCH);
    let ran = bench.run(&["play", "latch.nb", "--export", "latch.html"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let page = fs::read_to_string(bench.path().join("latch.html")).unwrap();
    let size = page.len().div_ceil(1000);
    assert_eq!(ran.out, format!("wrote latch.html: d_latch with 5 robots, {size} kB; a browser opens it\n"));
    assert!(page.starts_with("<!doctype html>") && page.contains("<title>d_latch – nbc</title>"));
    assert!(page.contains("default-src 'none'; script-src 'sha256-"), "a page that loads nothing");
    assert!(page.len() < 500_000, "{} bytes", page.len());
    let again = bench.run(&["play", "latch.nb", "--export", "again.html", "--format", "json"]);
    let written = validate("player", &again.out);
    assert_eq!(
        written,
        json!({
            "schema": "urn:nbc:player:1", "file": "again.html", "circuit": "d_latch", "robots": 5, "bytes": page.len(),
        })
    );
    assert!(fs::read_to_string(bench.path().join("again.html")).unwrap() == page, "the same file again");
}

#[test]
fn another_circuit_can_be_chosen_and_mistakes_are_told() {
    let bench = Bench::new();
    bench.file("two.nb", TWO);
    let ran = bench.run(&["play", "two.nb", "--export", "one.html", "--circuit", "one"]);
    assert!(ran.out.contains("one with 1 robot,"), "{}{}", ran.out, ran.err);
    let wrong = bench.run(&["play", "two.nb", "--export", "x.html", "--circuit", "onn"]);
    wrong.expect_fault(&["onn", "one"]);
    bench.run(&["play", "none.nb", "--export", "x.html"]).expect_fault(&["none.nb"]);
    bench.run(&["play", "--export", "x.html"]).expect_fault(&["FILE"]);
    bench.run(&["play", "two.nb", "--circuit", "one"]).expect_fault(&["--export"]);
    bench.run(&["play", "two.nb", "--export", "x.html", "--port", "8000"]).expect_fault(&["--port"]);
    bench.run(&["play", "two.nb", "--export", "x.html", "--live", "--effort", "fast"]).expect_fault(&["--live"]);
    // A build of this source alone has no page for it.
    bench.run(&["play", "two.nb", "--export", "x.html", "--live"]).expect_fault(&["without the page of `--live`"]);
    bench.run(&["play", "two.nb", "--export", "no/such/x.html"]).expect_fault(&["no/such/x.html"]);
    assert!(!bench.path().join("x.html").exists());
}

#[test]
fn a_page_exports_its_program_as_it_is_edited() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("two.nb"), LATCH).unwrap();
    let server = Server::start(folder.path(), &["two.nb"]);
    let mut page = server.page();
    page.done(json!({ "do": "program", "path": "two.nb", "text": TWO }));
    let made = page.done(json!({ "do": "export", "path": "two.nb", "circuit": "two", "swarm": null, "live": false }));
    assert_eq!(made["name"], "two.html");
    assert!(made["url"].as_str().unwrap().starts_with("take/"), "{made}");
    let other = json!({ "do": "export", "path": "two.nb", "circuit": "d_latch", "swarm": null, "live": false });
    let refused = page.ask(other);
    assert!(refused.unwrap_err()["message"].as_str().unwrap().contains("d_latch"));
}
