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
        ran.expect_json()[0]["changed"].as_bool().unwrap()
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
