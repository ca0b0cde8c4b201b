//! Materials of a program's own, wherever a body goes: archive, checkpoint, robot file, picture, swarm.

use std::fs;

use crate::cli::Bench;
use crate::language::root;

/// A folder with a run of format 1 in `out/hearts/seed-1`, whose third material is not the paper's.
fn first_format() -> Bench {
    let bench = Bench::new();
    let golden = root().join("tests/golden/checkpoint_1");
    bench.file("own.nb", fs::read(golden.join("own.nb")).unwrap());
    fs::create_dir_all(bench.path().join("out/hearts/seed-1")).unwrap();
    bench.file("out/hearts/seed-1/checkpoint.nbc", fs::read(golden.join("checkpoint.nbc")).unwrap());
    bench
}

#[test]
fn a_checkpoint_of_format_1_goes_on_and_becomes_one_of_format_2() {
    let bench = first_format();
    let evolve = |out: &str, more: &[&str]| {
        let arguments = [&["evolve", "own.nb", "--generations", "4", "--out", out], more].concat();
        let ran = bench.run(&arguments);
        assert_eq!(ran.status, 0, "{}", ran.err);
        fs::read_to_string(bench.path().join(out).join("hearts/seed-1/checkpoint.nbc")).unwrap()
    };
    let (resumed, straight) = (evolve("out", &["--resume"]), evolve("straight", &[]));
    assert!(resumed.starts_with("nbc-checkpoint 2 "), "{resumed:.40}");
    assert_eq!(resumed, straight);
    assert_eq!(evolve("out", &["--resume"]), straight, "format 2 goes on too");
}

#[test]
fn a_checkpoint_of_format_1_is_compared_with_its_declaration() {
    let bench = first_format();
    let own = fs::read_to_string(bench.path().join("own.nb")).unwrap();
    bench.file("own.nb", own.replace("0.98..1.02", "0.98..1.03"));
    let ran = bench.run(&["evolve", "own.nb", "--resume"]);
    ran.expect_fault(&["was made by another declaration than `hearts` is now"]);
}

#[test]
fn robot_files_are_rewritten_in_the_newest_format_and_say_the_same() {
    let bench = Bench::new();
    fs::create_dir(bench.path().join("robots")).unwrap();
    let first = fs::read_to_string(root().join("tests/golden/robot_1.yaml")).unwrap();
    let path = bench.file("robots/old.yaml", &first);
    let rewrite = || {
        let ran = bench.run(&["library", "rewrite", "robots", "--format", "json"]);
        ran.expect_json()["files"][0]["changed"].as_bool().unwrap()
    };
    assert!(rewrite());
    let second = fs::read_to_string(&path).unwrap();
    let before_genotype = |text: &str| text.split_once("genotype:").unwrap().0.to_owned();
    assert_eq!(
        before_genotype(&second),
        before_genotype(&first).replace("format: 1", "format: 2").replace(": 0.2.0", ": '0.2.0'")
    );
    assert!(!rewrite(), "the newest format is left alone");
    assert_eq!(fs::read_to_string(&path).unwrap(), second);
}

#[test]
fn robot_files_have_no_tags() {
    for entry in fs::read_dir(root().join("library/robots")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "yaml") {
            let text = fs::read_to_string(&path).unwrap();
            assert!(text.starts_with("format: 2\n"), "{}: `nbc library rewrite` writes format 2", path.display());
            assert!(!text.contains('!'), "{} has a tag, which other readers refuse", path.display());
        }
    }
}

#[test]
fn a_run_is_drawn_with_the_materials_of_its_checkpoint() {
    let bench = first_format();
    for format in [1, 2] {
        let ran = bench.run(&["draw", "out/hearts", "--as", "sprite", "-o", "a.svg"]);
        assert_eq!(ran.status, 0, "{}", ran.err);
        let svg = fs::read_to_string(bench.path().join("a.svg")).unwrap();
        assert!(svg.contains("3 heart: 0.98..1.02 in 84 steps, 0°"), "format {format}: {svg}");
        assert!(svg.contains("2 muscle") && !svg.contains("3 muscle"), "format {format}: {svg}");
        let ran = bench.run(&["evolve", "own.nb", "--resume"]);
        assert_eq!(ran.status, 0, "{}", ran.err);
    }
}

/// A checkpoint whose header fits its text.
fn sealed(text: &str) -> String {
    format!("nbc-checkpoint 2 {:08x} {}\n{text}\n", crc32fast::hash(text.as_bytes()), text.len())
}

#[test]
fn a_foreign_checkpoint_with_the_right_checksum_is_refused() {
    let bench = first_format();
    assert_eq!(bench.run(&["evolve", "own.nb", "--resume"]).status, 0);
    let path = bench.path().join("out/hearts/seed-1/checkpoint.nbc");
    let whole = fs::read_to_string(&path).unwrap();
    let (_, text) = whole.trim_end().split_once('\n').unwrap();
    let (before, niches) = text.split_once("\"niches\":[[[").unwrap();
    let (_, after) = niches.split_once(']').unwrap();
    let with_key = |key: &str| format!("{before}\"niches\":[[[{key}]{after}");
    let check = |text: &str, expected: &str| {
        fs::write(&path, sealed(text)).unwrap();
        for kind in ["heatmap", "report", "sprite"] {
            let file = if kind == "report" { "a.html" } else { "a.svg" };
            let ran = bench.run(&["draw", "out/hearts", "--as", kind, "-o", file]);
            ran.expect_fault(&["checkpoint", expected]);
        }
    };
    check(&with_key(""), "the archive has no niche []");
    check(&with_key("0,0,0,16"), "the archive has no niche [0, 0, 0, 16]");
    check(&with_key("4,0,0,0"), "the archive has no niche [4, 0, 0, 0]");
    check(&text.replacen("\"batch\":3,", "", 1), "missing field `batch`");
    check(&text.replacen("\"batch\":", "\"stack\":", 1), "unknown field `stack`");
    check(&text.replacen("\"kind\":\"rigid\"", "\"kind\":\"gas\"", 1), "unknown variant `gas`");
    check(&text.replacen("\"bins\":4", "\"bins\":0", 1), "an axis of 0 bins");
}
