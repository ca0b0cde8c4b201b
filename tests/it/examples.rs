//! The promises of README and `circuits/`, checked with the real program.

use std::path::Path;

use crate::support::bench::{Bench, Ran};
use crate::support::root;

/// Runs a circuit in full physics, with its results in the bench's folder `out`.
fn run(bench: &Bench, circuit: &Path) -> Ran {
    bench.run(&["run", circuit.to_str().unwrap(), "--out", "out"])
}

#[test]
fn the_latch_prints_what_the_readme_shows() {
    let bench = Bench::new();
    let ran = run(&bench, &root().join("circuits/latch.nb"));
    assert_eq!(ran.status, 0, "{}", ran.err);
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let table: Vec<&str> = ran.out.lines().take_while(|line| !line.starts_with("picture")).collect();
    for line in table.iter().filter(|line| !line.is_empty()) {
        assert!(readme.contains(&format!("    {line}\n")), "README.md shows `{line}`");
    }
    let out = bench.path().join("out");
    for file in ["d_latch-spacetime.svg", "d_latch-spacetime.png", "d_latch-waves.vcd", "report.html", "result.json"] {
        assert!(out.join(file).is_file(), "{file} was written");
    }
    let result: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(out.join("result.json")).unwrap()).unwrap();
    assert_eq!(result["passed"], true);
}

#[test]
fn a_test_that_fails_ends_with_status_one() {
    let bench = Bench::new();
    let file = bench.file(
        "wrong.nb",
        "circuit inverter(a) -> (q) { q = not a }\ntest inverter \"is wrong\" {\n    a | q\n    1 | 1\n}\n",
    );
    let ran = run(&bench, &file);
    assert_eq!(ran.status, 1, "{}", ran.err);
    assert!(ran.out.contains("FAIL"), "{}", ran.out);
}

#[test]
fn a_file_with_errors_ends_with_status_two_and_writes_nothing() {
    let bench = Bench::new();
    let file = bench.file("broken.nb", "circuit inverter(a) -> (q) { q = not b }\n");
    run(&bench, &file).expect_fault(&["`b`"]);
    assert!(!bench.path().join("out").exists());
}

#[test]
fn the_adder_of_nine_robots_adds() {
    nbc::run_file(root().join("circuits/full_adder.nb"), &nbc::CompileOptions::default()).unwrap().assert_passed();
}
