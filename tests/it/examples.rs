//! What README and `circuits/` promise, done by the program itself.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn run(circuit: &str, out: &Path) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_nbc"));
    command.current_dir(root()).args(["run", circuit, "--out"]).arg(out).output().unwrap()
}

#[test]
fn the_latch_prints_what_the_readme_shows() {
    let folder = tempfile::tempdir().unwrap();
    let output = run("circuits/latch.nb", folder.path());
    assert_eq!(output.status.code(), Some(0));
    let readme = std::fs::read_to_string(root().join("README.md")).unwrap();
    let found = String::from_utf8(output.stdout).unwrap();
    let table: Vec<&str> = found.lines().take_while(|line| !line.starts_with("picture")).collect();
    for line in table.iter().filter(|line| !line.is_empty()) {
        assert!(readme.contains(&format!("    {line}\n")), "README.md shows `{line}`");
    }
    for file in ["d_latch-spacetime.svg", "d_latch-spacetime.png", "d_latch-waves.vcd", "report.html", "result.json"] {
        assert!(folder.path().join(file).is_file(), "{file} was written");
    }
    let result: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("result.json")).unwrap()).unwrap();
    assert_eq!(result["passed"], true);
}

#[test]
fn a_test_that_fails_ends_with_status_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wrong.nb");
    std::fs::write(
        &file,
        "circuit inverter(a) -> (q) { q = not a }\ntest inverter \"is wrong\" {\n    a | q\n    1 | 1\n}\n",
    )
    .unwrap();
    let output = run(file.to_str().unwrap(), &folder.path().join("out"));
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stdout).unwrap().contains("FAIL"));
}

#[test]
fn a_file_with_errors_ends_with_status_two_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("broken.nb");
    std::fs::write(&file, "circuit inverter(a) -> (q) { q = not b }\n").unwrap();
    let out = folder.path().join("out");
    let output = run(file.to_str().unwrap(), &out);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("`b`"));
    assert!(!out.exists());
}

#[test]
fn the_adder_of_nine_robots_adds() {
    nbc::run_file(root().join("circuits/full_adder.nb"), &nbc::Options::default()).unwrap().assert_passed();
}
