//! The promises of README and `circuits/`, checked with the real program.

use crate::support::*;

#[test]
fn the_latch_prints_what_the_readme_shows() {
    let bench = Bench::new();
    let ran = bench.ok(&["run", root().join("circuits/latch.nb").to_str().unwrap(), "--out", "out"]);
    let readme = text_of("README.md");
    let table: Vec<&str> = ran.out.lines().take_while(|line| !line.starts_with("picture")).collect();
    for line in table.iter().filter(|line| !line.is_empty()) {
        assert!(readme.contains(&format!("    {line}\n")), "README.md shows `{line}`");
    }
    let out = bench.path().join("out");
    for file in ["d_latch-spacetime.svg", "d_latch-spacetime.png", "d_latch-waves.vcd", "report.html", "result.json"] {
        assert!(out.join(file).is_file(), "{file} was written");
    }
    let result: Value = serde_json::from_str(&fs::read_to_string(out.join("result.json")).unwrap()).unwrap();
    assert_eq!(result["passed"], true);
}
