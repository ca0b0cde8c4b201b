//! What a run says and writes: its timing in a line, and its folder of results.

use crate::cli::flip;

use crate::support::*;

#[test]
fn a_ring_of_inverters_never_settles() {
    let bench = Bench::with("ring.nb", "circuit ring() -> (q) {\n    q init 0 = not not not q\n}\n");
    let built = bench.run("build ring.nb --emit timing").out;
    let first = built.lines().next().unwrap_or_default();
    let nets = first.strip_prefix("timing   never settles, because these inverters form a ring: ");
    assert_eq!(nets.map(|nets| nets.split(' ').count()), Some(3), "{built}");
    let timing = serde_json::from_str::<Value>(&bench.run("build ring.nb --emit json").out).unwrap();
    assert_eq!(timing["rings"].as_array().unwrap().len(), 3, "{timing}");
}

#[test]
fn a_run_says_in_one_line_how_long_rows_are_held_and_a_build_says_why() {
    let bench = Bench::with("passing.nb", flip(true));
    let ran = bench.run("run passing.nb");
    let timing: Vec<&str> = ran.out.lines().skip_while(|line| !line.starts_with("timing ")).collect();
    assert_eq!(timing.len(), 4, "{}", ran.out);
    assert!(timing[0].starts_with("timing   hold each row for "), "{}", ran.out);
    assert!(timing[1].starts_with("report ") && timing[2].starts_with("results ") && timing[3] == "pass");
    let page = bench.read("out/passing/report.html");
    let built = bench.run("build passing.nb --emit timing").out;
    assert!(built.contains("settles within ") && built.contains("fan-out  "), "{built}");
    assert!(page.contains("settles within ") && page.contains("fan-out  "));
}

#[test]
fn the_hold_that_a_run_names_is_long_enough() {
    let bench = Bench::new();
    let text = text_of("circuits/full_adder.nb");
    bench.file("adder.nb", &text);
    let ran = bench.run("run adder.nb --no-report");
    let (_, named) = ran.out.rsplit_once("timing   hold each row for ").expect("the hold in a line");
    let cycles: u32 = named.split(' ').next().unwrap().parse().unwrap();
    let test = |cycles: u32| {
        bench.file("held.nb", format!("{text}\nswarm held {{ circuit: full_adder, hold: {cycles} cycles }}\n"));
        bench.run("test held.nb --physics")
    };
    let enough = test(cycles);
    assert!(enough.status == 0 && enough.err.is_empty(), "{}{}", enough.out, enough.err);
    let message = format!("a hold of {} cycles is too short, expected at least {cycles}", cycles - 1);
    assert!(test(cycles - 1).err.contains(&message));
}

#[test]
#[cfg(unix)]
fn links_in_folders_of_results_are_not_followed() {
    use std::os::unix::fs::symlink;
    let bench = Bench::with("passing.nb", flip(true));
    let mine = bench.file("mine.txt", "mine");
    fs::create_dir_all(bench.path().join("out/passing")).unwrap();
    for file in ["report.html", "result.json"] {
        symlink(&mine, bench.path().join("out/passing").join(file)).unwrap();
    }
    bench.ok("run passing.nb");
    assert_eq!(fs::read_to_string(&mine).unwrap(), "mine");
    assert!(bench.read("out/passing/report.html").starts_with("<!"));
    // A folder that is a link is refused, unless the user names it.
    fs::remove_dir_all(bench.path().join("out")).unwrap();
    fs::create_dir(bench.path().join("elsewhere")).unwrap();
    symlink("elsewhere", bench.path().join("out")).unwrap();
    bench.run("run passing.nb").expect_fault(&["`out` is a link"]);
    assert_eq!(fs::read_dir(bench.path().join("elsewhere")).unwrap().count(), 0);
    bench.ok("run passing.nb --out out");
    let small = "evolution small { box: 3 x 1, variable: short, fixed: 1 cycles, batch: 6, generations: 4, seed: 3 }\n";
    bench.runs("small.nb", small);
    bench.run("evolve small.nb").expect_fault(&["`out` is a link"]);
    fs::create_dir_all(bench.path().join("runs/small/seed-3")).unwrap();
    let progress = bench.path().join("runs/small/seed-3/progress.jsonl");
    symlink(&mine, &progress).unwrap();
    bench.ok("evolve small.nb --out runs");
    assert_eq!(fs::read_to_string(&mine).unwrap(), "mine");
    assert!(fs::read_to_string(&progress).unwrap().contains("generation"));
}
