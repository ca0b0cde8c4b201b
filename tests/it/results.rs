//! What a run says and writes: its timing in a line, and its folder of results.

use serde_json::Value;

use crate::cli::{Bench, flip};

#[test]
fn a_ring_of_inverters_never_settles() {
    let bench = Bench::new();
    bench.file("ring.nb", "circuit ring() -> (q) {\n    q init 0 = not not not q\n}\n");
    let built = bench.run(&["build", "ring.nb", "--emit", "timing"]).out;
    let first = built.lines().next().unwrap_or_default();
    let nets = first.strip_prefix("timing   never settles, because these inverters form a ring: ");
    assert_eq!(nets.map(|nets| nets.split(' ').count()), Some(3), "{built}");
    let timing = serde_json::from_str::<Value>(&bench.run(&["build", "ring.nb", "--emit", "json"]).out).unwrap();
    assert_eq!(timing["rings"].as_array().unwrap().len(), 3, "{timing}");
}

#[test]
fn a_run_says_in_one_line_how_long_rows_are_held_and_a_build_says_why() {
    let bench = Bench::new();
    bench.file("passing.nb", flip(true));
    let ran = bench.run(&["run", "passing.nb"]);
    let timing: Vec<&str> = ran.out.lines().skip_while(|line| !line.starts_with("timing ")).collect();
    assert_eq!(timing.len(), 4, "{}", ran.out);
    assert!(timing[0].starts_with("timing   hold each row for "), "{}", ran.out);
    assert!(timing[1].starts_with("report ") && timing[2].starts_with("results ") && timing[3] == "pass");
    let page = std::fs::read_to_string(bench.path().join("out/passing/report.html")).unwrap();
    let built = bench.run(&["build", "passing.nb", "--emit", "timing"]).out;
    assert!(built.contains("settles within ") && built.contains("fan-out  "), "{built}");
    assert!(page.contains("settles within ") && page.contains("fan-out  "));
}

#[test]
#[cfg(unix)]
fn links_in_folders_of_results_are_not_followed() {
    use std::os::unix::fs::symlink;
    let bench = Bench::new();
    bench.file("passing.nb", flip(true));
    let mine = bench.file("mine.txt", "mine");
    std::fs::create_dir_all(bench.path().join("out/passing")).unwrap();
    for file in ["report.html", "result.json"] {
        symlink(&mine, bench.path().join("out/passing").join(file)).unwrap();
    }
    assert_eq!(bench.run(&["run", "passing.nb"]).status, 0);
    assert_eq!(std::fs::read_to_string(&mine).unwrap(), "mine");
    assert!(std::fs::read_to_string(bench.path().join("out/passing/report.html")).unwrap().starts_with("<!"));
    // A folder that is a link is refused, unless the user names it.
    std::fs::remove_dir_all(bench.path().join("out")).unwrap();
    std::fs::create_dir(bench.path().join("elsewhere")).unwrap();
    symlink("elsewhere", bench.path().join("out")).unwrap();
    bench.run(&["run", "passing.nb"]).expect_fault(&["`out` is a link"]);
    assert_eq!(std::fs::read_dir(bench.path().join("elsewhere")).unwrap().count(), 0);
    assert_eq!(bench.run(&["run", "passing.nb", "--out", "out"]).status, 0);
    let small = "evolution small { box: 3 x 1, variable: short, fixed: 1 cycles, batch: 6, generations: 4, seed: 3 }\n";
    bench.runs("small.nb", small);
    bench.run(&["evolve", "small.nb"]).expect_fault(&["`out` is a link"]);
    std::fs::create_dir_all(bench.path().join("runs/small/seed-3")).unwrap();
    let progress = bench.path().join("runs/small/seed-3/progress.jsonl");
    symlink(&mine, &progress).unwrap();
    assert_eq!(bench.run(&["evolve", "small.nb", "--out", "runs"]).status, 0);
    assert_eq!(std::fs::read_to_string(&mine).unwrap(), "mine");
    assert!(std::fs::read_to_string(&progress).unwrap().contains("generation"));
}
