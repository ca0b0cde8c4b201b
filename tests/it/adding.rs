//! `nbc library add`: every requested behavior has a result, and robots with errors are left out.

use crate::support::*;

/// A small archive of small bodies with few behaviors, all of robots that err.
const RUN: &str = "
evolution walks {
    box:         3 x 1
    variable:    short
    fixed:       1 cycles
    batch:       6
    generations: 4
    seed:        3
}
";

fn bench() -> Bench {
    let bench = Bench::new();
    bench.runs("runs.nb", RUN);
    bench.ok("evolve runs.nb");
    bench
}

fn add(bench: &Bench, more: &[&str]) -> Ran {
    let usual = ["library", "add", "out/walks/seed-3", "--into", "robots", "--tries", "1", "--finalists", "1"];
    bench.run(&[&usual[..], more].concat())
}

fn written(bench: &Bench) -> Vec<String> {
    let entries = fs::read_dir(bench.path().join("robots")).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn every_requested_behavior_has_a_result_and_robots_with_errors_are_left_out() {
    let bench = bench();
    let strict = add(&bench, &["--behavior", "LLLL", "--behavior", "LRRL", "--format", "json"]);
    assert_eq!(strict.status, 1, "a behavior that was asked for has no robot: {}", strict.err);
    let found = validate("added", &strict.out);
    let [zero, xor] = &found["answers"].as_array().unwrap()[..] else { panic!("{found}") };
    assert!(xor["outcome"] == "missing" && xor["reason"] == "no elite of this behavior", "{xor}");
    assert!(zero["outcome"] == "left_out" && zero["robot"]["error_rate"].as_f64() > Some(0.0), "{zero}");
    let reason = zero["reason"].as_str().unwrap();
    assert!(reason.contains(" of 1024 switches wrong (") && reason.ends_with(", at most 0 % accepted"), "{reason}");
    assert!(!bench.has("robots"), "no robot was added, so there is no library");
}

#[test]
fn the_accepted_error_rate_is_between_0_and_1() {
    for share in ["2", "-0.1", "x", "NaN"] {
        let ran = add(&Bench::new(), &[&format!("--max-error={share}")]);
        assert!(ran.status == 2 && ran.err.contains("expected a number from 0 to 1"), "{}", ran.err);
    }
}

#[test]
fn a_failed_addition_leaves_nothing() {
    let bench = Bench::new();
    let missing = add(&bench, &[]);
    missing.expect_fault(&["there is no checkpoint `out/walks/seed-3/checkpoint.nbc`", "`out/gates/seed-1`"]);
    assert!(!bench.has("robots"));
    let bench = self::bench();
    let none = add(&bench, &["--behavior", "xor"]);
    assert_eq!(none.status, 1, "{}", none.err);
    assert!(!bench.has("robots"), "no robot was added, so there is no library");
    bench.file("robots", "a file");
    assert_eq!(add(&bench, &["--behavior", "xor"]).status, 2, "checked before anything is measured");
}

#[test]
fn the_folder_of_a_run_stands_for_its_seeds_and_a_function_for_its_behavior() {
    let bench = bench();
    let whole = ["library", "add", "out/walks", "--into", "robots", "--tries", "1", "--finalists", "1"];
    let ran = bench.ok(&[&whole[..], &["--behavior", "zero", "--max-error", "0.8"]].concat());
    assert!(ran.out.starts_with("LLLL  zero        added     zero_3x1, clock "), "{}", ran.out);
    assert!(ran.out.ends_with("\n1 of 1 behavior has a robot in robots\n"), "{}", ran.out);
    assert_eq!(written(&bench), ["zero_3x1.yaml"]);
    add(&bench, &["--behavior", "nnad"])
        .expect_fault(&["expected four or eight letters such as `RRRL`", "did you mean `nand`?"]);
    let listed = bench.run("library list robots");
    assert!(listed.status == 0 && listed.out.contains("zero_3x1") && !listed.out.contains("nand"), "{}", listed.out);
    for arguments in [&["zero_3x1", "robots"][..], &["zero", "robots"], &["robots/zero_3x1.yaml"]] {
        let shown = bench.run(&[&["library", "show"], arguments].concat());
        assert!(shown.status == 0 && shown.out.contains("zero_3x1"), "{arguments:?}: {}{}", shown.out, shown.err);
    }
    bench.run("library show nand robots").expect_fault(&["no robot of the library is called `nand`"]);
}
