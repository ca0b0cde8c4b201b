//! Pages of their own. `tests/it/page.rs` opens the page of results in a browser.

use super::LATCH;
use super::page::Server;

use crate::support::*;

const TWO: &str = "\
circuit one(a) -> (q) {
    q = not a
}
circuit two(a, b) -> (q) {
    q = a xor b
}
circuit untested(a) -> (q) {
    q = a
}
test one {
    a | q
    0 | 1
}
test two {
    a b | q
    1 0 | 0
}
";

#[test]
fn the_recorded_page_is_that_of_a_run_and_the_command_says_so() {
    let bench = Bench::with("latch.nb", LATCH);
    let ran = bench.ok("play latch.nb --export latch.html");
    let page = bench.read("latch.html");
    let size = page.len().div_ceil(1000);
    assert_eq!(ran.out, format!("wrote latch.html: d_latch with 5 robots, {size} kB; a browser opens it\n"));
    bench.ok("run latch.nb");
    assert!(bench.read("out/latch/report.html") == page, "the page of the run");
    let again = bench.run("play latch.nb --export again.html --format json");
    let written = validate("player", &again.out);
    assert_eq!(
        written,
        json!({
            "schema": "urn:nbc:player:1", "file": "again.html", "circuit": "d_latch", "robots": 5, "bytes": page.len(),
        })
    );
}

#[test]
fn another_circuit_can_be_chosen_and_mistakes_are_told() {
    let bench = Bench::with("two.nb", TWO);
    let ran = bench.run("play two.nb --export one.html --circuit one");
    assert!(ran.out.contains("one with 1 robot,"), "{}{}", ran.out, ran.err);
    let page = |name: &str| bench.read(name);
    assert!(page("one.html").contains("pass: 1 of 1 test passed"));
    let failing = bench.run("play two.nb --export two.html");
    assert!(failing.status == 0 && failing.out.contains("two with "), "{}{}", failing.out, failing.err);
    assert!(page("two.html").contains("FAIL: 1 of 2 tests passed"));
    bench
        .run("play two.nb --export x.html --circuit untested")
        .expect_fault(&["`untested` has no test and no simulation to record", "`--live`"]);
    let wrong = bench.run("play two.nb --export x.html --circuit onn");
    wrong.expect_fault(&["onn", "one"]);
    bench.run("play none.nb --export x.html").expect_fault(&["none.nb"]);
    bench.run("play --export x.html").expect_fault(&["FILE"]);
    bench.run("play two.nb --circuit one").expect_fault(&["--export"]);
    bench.run("play two.nb --export x.html --port 8000").expect_fault(&["--port"]);
    bench.run("play two.nb --export x.html --live --effort fast").expect_fault(&["--live"]);
    // A build of this source alone has no page for it.
    bench.run("play two.nb --export x.html --live").expect_fault(&["without the page of `--live`"]);
    bench.run("play two.nb --export no/such/x.html").expect_fault(&["no/such/x.html"]);
    assert!(!bench.has("x.html"));
}

#[test]
fn a_page_exports_its_program_as_it_is_edited() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("two.nb"), LATCH).unwrap();
    let server = Server::start(folder.path(), &["two.nb"]);
    let mut page = server.page();
    page.done(json!({ "do": "program", "path": "two.nb", "text": TWO }));
    let export =
        |circuit: &str| json!({ "do": "export", "path": "two.nb", "circuit": circuit, "swarm": null, "live": false });
    let made = page.done(export("two"));
    assert_eq!(made["name"], "two.html");
    assert!(made["url"].as_str().unwrap().starts_with("take/"), "{made}");
    for (circuit, message) in [("d_latch", "d_latch"), ("untested", "no test and no simulation")] {
        let refused = page.ask(export(circuit)).unwrap_err();
        assert!(refused["message"].as_str().unwrap().contains(message), "{refused}");
    }
}
