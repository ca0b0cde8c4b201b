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
