//! Output for programs: with `--format json`, every command prints what its schema in `docs/schema` describes.

use std::collections::BTreeSet;

use nbc_session::report::Schema;

use crate::support::*;

const FLIP: &str = "circuit flip(a) -> (y) {\n    y = not a\n}\n\ntest flip {\n    a | y\n    0 | 1\n}\n";

const WAVES: &str = "\
circuit bit(clk) -> (y) {
    y = register(not y, clk)
}
swarm wave { circuit: bit, registers: waves }
test bit {
    clk | y
    0   | 0
    ^   | 1
    ^   | 0
}
";

#[track_caller]
fn check(bench: &Bench, word: &str, status: i32, arguments: &[&str]) -> Value {
    let ran = bench.run(&[arguments, &["--format", "json"]].concat());
    assert_eq!(ran.status, status, "{arguments:?}: {}", ran.err);
    validate(word, &ran.out)
}

fn bench() -> Bench {
    let bench = Bench::with("flip.nb", FLIP);
    bench.file("wrong.nb", FLIP.replace("not a", "not b"));
    bench.file("waves.nb", WAVES);
    bench.file("walker.yaml", "body: [\"00345\", \"33333\"]\n");
    bench
}

#[test]
fn every_schema_has_its_file() {
    for found in Schema::ALL {
        let schema = schema(found.word());
        assert_eq!(
            (&schema["$id"], &schema["properties"]["schema"]["const"]),
            (&found.id().into(), &found.id().into())
        );
    }
    assert_eq!(fs::read_dir(root().join("docs/schema")).unwrap().count(), Schema::ALL.len(), "files without a schema");
}

#[test]
fn a_schema_rejects_unknown_fields() {
    let schema = schema("drawn");
    let drawn = json!({ "schema": "urn:nbc:drawn:1", "file": "a.svg", "kind": "sprite" });
    assert_eq!(faults(&schema, &schema, &drawn), [] as [String; 0]);
    for (key, value) in [("more", Value::Null), ("file", 3.into()), ("schema", "urn:nbc:drawn:2".into())] {
        let mut other = drawn.clone();
        other[key] = value;
        assert_ne!(faults(&schema, &schema, &other), [] as [String; 0], "{other}");
    }
}

#[test]
fn every_command_prints_valid_json_or_rejects_the_option() {
    let (bench, latch) = (bench(), root().join("circuits/latch.nb"));
    assert_eq!(check(&bench, "diagnostics", 0, &["check", "flip.nb"])["diagnostics"], Value::Array(Vec::new()));
    check(&bench, "diagnostics", 2, &["check", "flip.nb", "wrong.nb"]);
    check(&bench, "build", 0, &["build", "flip.nb"]);
    let found = check(&bench, "robustness", 0, &["test", "flip.nb", "--vary", "all=5%", "--worlds", "3"]);
    assert_eq!(found["tests"][0]["yield"]["worlds"], 3);
    check(&bench, "build", 0, &["build", latch.to_str().unwrap()]);
    let waves = check(&bench, "build", 0, &["build", "waves.nb", "--swarm", "wave"])["waves"].clone();
    assert!(waves["threads"].as_u64() > Some(0), "{waves}");
    let rows = check(&bench, "test", 0, &["test", "waves.nb", "--physics"])["tests"][0]["rows"].clone();
    assert_eq!(rows[0]["thread"], 0);
    check(&bench, "run", 0, &["run", "waves.nb", "--no-report"]);
    let counter = root().join("circuits/counter.nb");
    let ports = &check(&bench, "build", 0, &["build", counter.to_str().unwrap()])["ports"];
    let port = |name: &str, width: usize| json!([{ "name": name, "width": width }]);
    assert_eq!((&ports["inputs"], &ports["outputs"]), (&port("clk", 1), &port("count", 3)));
    let both = bench.run("build flip.nb --emit blif --format json");
    assert!(both.status == 2 && both.err.contains("ask for two formats"), "{}", both.err);
    check(&bench, "drawn", 0, &["draw", "walker.yaml", "--as", "sprite", "-o", "a.svg"]);
    #[cfg(feature = "play")]
    check(&bench, "player", 0, &["play", "flip.nb", "--export", "flip.html"]);
    check(&bench, "explain", 0, &["explain"]);
    check(&bench, "explain", 0, &["explain", "width"]);
    check(&bench, "explain", 0, &["explain", "prelude"]);
    check(&bench, "robots", 0, &["export", "shipped"]);
    check(&bench, "prove", 0, &["prove", root().join("circuits/computer.nb").to_str().unwrap()]);
    bench.file("claimed.nb", "circuit f(a) -> (q) {\n    q = a\n}\n\nprove f {\n    never q\n}\n");
    check(&bench, "prove", 1, &["prove", "claimed.nb", "--physics"]);
    bench.file("model.aag", "aag 1 1 0 0 0 1\n2\n2\n");
    check(&bench, "prove", 1, &["prove", "model.aag"]);
    check(&bench, "formatted", 0, &["fmt", "flip.nb"]);
    check(&bench, "library", 0, &["library", "list"]);
    check(&bench, "robot", 0, &["library", "show", "nand"]);
    let robot = root().join("library/robots/zero_5x5.yaml");
    check(&bench, "verify", 0, &["library", "verify", robot.to_str().unwrap()]);
    fs::copy(&robot, bench.path().join("zero.yaml")).unwrap();
    check(&bench, "run", 0, &["run", "flip.nb", "--no-report"]);
    validate("run", &bench.read("out/flip/result.json"));
    bench.file("failing.nb", FLIP.replace("0 | 1", "0 | 0\n    1 | 0"));
    check(&bench, "run", 1, &["run", "failing.nb", "--no-report"]);
    let simulation = "swarm own { circuit: flip }\n\nsimulate own with schedule (a) {\n    0 for 3 cycles\n}\n";
    bench.file("simulated.nb", FLIP.to_owned() + simulation);
    let simulated = check(&bench, "run", 0, &["run", "simulated.nb", "--no-report"]);
    assert_eq!(simulated["simulations"].as_array().unwrap().len(), 1);
    check(&bench, "simulate", 0, &["simulate", "walker.yaml", "--schedule", "00*1"]);
    let blif = root().join("tests/benchmarks/fa.blif");
    check(&bench, "synth", 0, &["synth", blif.to_str().unwrap(), "--what-if", "xor"]);
    let bench_file = root().join("tests/benchmarks/s27.bench");
    check(&bench, "synth", 0, &["synth", bench_file.to_str().unwrap()]);
    let votes: String = (0..8).map(|row: u32| format!("{row},{}\n", row.count_ones())).collect();
    bench.file("votes.csv", format!("votes,count\n{votes}"));
    let learned = check(&bench, "learn", 0, &["learn", "votes.csv", "--hold-out", "0"]);
    assert_eq!((&learned["training"]["rows"], &learned["confusion"]["output"]), (&8.into(), &"count".into()));
    check(&bench, "learn", 0, &["learn", "votes.csv", "-o", "count.blif"]);
    check(&bench, "test", 0, &["test", "flip.nb", "--logic"]);
    check(&bench, "test", 1, &["test", "failing.nb", "flip.nb", "--logic"]);
    check(&bench, "test", 1, &["test", "failing.nb", "--physics"]);
    check(&bench, "bug-report", 0, &["bug-report"]);
    for arguments in [["completions", "bash"], ["manual", "pages"]] {
        let rejected = bench.run(&[&arguments[..], &["--format", "json"]].concat());
        assert_eq!(rejected.status, 2);
        validate("diagnostics", &rejected.out);
    }
}

#[test]
fn runs_and_archives_match_their_schemas() {
    let bench = Bench::with(
        "small.nb",
        "evolution small { box: 3 x 2, fixed: 1 cycles, batch: 4, generations: 3, seed: 1..2 }\n",
    );
    let evolved = check(&bench, "evolve", 0, &["evolve", "small.nb"]);
    let elites = check(&bench, "elites", 0, &["export", "out/small"]);
    let seeds: BTreeSet<u64> =
        elites["elites"].as_array().unwrap().iter().map(|e| e["seed"].as_u64().unwrap()).collect();
    assert_eq!(seeds, BTreeSet::from([1, 2]));
    let filled: u64 = evolved["runs"].as_array().unwrap().iter().map(|run| run["filled"].as_u64().unwrap()).sum();
    assert_eq!(elites["elites"].as_array().unwrap().len() as u64, filled, "a niche has one elite here");
}

#[test]
fn every_error_has_the_same_shape() {
    let bench = bench();
    for arguments in [
        &["run", "wrong.nb"][..],
        &["build", "wrong.nb"],
        &["test", "wrong.nb"],
        &["fmt", "none.nb"],
        &["evolve", "wrong.nb"],
        &["export", "none"],
        &["draw", "walker.yaml", "--as", "gif", "-o", "a.svg"],
        &["library", "show", "none"],
        &["simulate", "walker.yaml", "--schedule", "02*1"],
        &["synth", "none.blif"],
        &["explain", "none"],
    ] {
        let found = check(&bench, "diagnostics", 2, arguments);
        assert!(!found["diagnostics"].as_array().unwrap().is_empty(), "{arguments:?}");
    }
    let places = check(&bench, "diagnostics", 2, &["run", "wrong.nb"]);
    let start = &places["diagnostics"][0]["labels"][0]["start"];
    assert_eq!((&start["line"], &start["column"]), (&2.into(), &13.into()), "{places}");
}
