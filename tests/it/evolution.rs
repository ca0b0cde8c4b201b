//! Evolution runs through the real program: the same bits on any number of threads and after any interruption; images that
//! are exact.

use std::fs;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use nbc::evolve::{Search, recodings};
use nbc::model::{Body, Evolution, Pattern, Schedule, Setting, Spell, Trial};
use nbc::pipeline;
use nbc::sim::run_trials;
use nbc::source::MemoryWorld;
use nbc::swarm::evaluate;
use proptest::prelude::*;

use crate::cli::Bench;

/// Two small runs, one for each objective.
const RUNS: &str = "
schedule short(s1, s2) {
    0 0 for 1 cycles
    1 1 for 1 cycles
}

evolution walks {
    box:         4 x 3
    variable:    short
    fixed:       1 cycles
    batch:       8
    generations: 14
    seed:        3
}

evolution turns {
    from:        walks
    objective:   gate
    symmetry:    npn
    niche:       pareto(3)
    as:          code
    generations: 5
}
";

const CHECKPOINTS: [&str; 2] = ["walks/seed-3/checkpoint.nbc", "turns/seed-3/checkpoint.nbc"];

fn bench() -> Bench {
    let bench = Bench::new();
    bench.file("runs.nb", RUNS);
    bench
}

/// The runs' checkpoints after they went through in one go, on that many threads.
fn straight(bench: &Bench, threads: &str) -> Vec<Vec<u8>> {
    let out = format!("threads-{threads}");
    let mut command = bench.command(&["evolve", "runs.nb", "--out", &out]);
    let ended = command.env("RAYON_NUM_THREADS", threads).output().unwrap();
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    read(bench, &out)
}

fn read(bench: &Bench, out: &str) -> Vec<Vec<u8>> {
    CHECKPOINTS.map(|path| fs::read(bench.path().join(out).join(path)).unwrap()).into()
}

/// Starts the runs and waits until a file has grown to that many lines.
fn start(bench: &Bench, out: &str, more: &[&str], file: &str, lines: usize) -> Child {
    let resume = [&["evolve", "runs.nb", "--out", out, "--resume", "--checkpoint-every", "0"], more].concat();
    let mut child = bench.command(&resume).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let path = bench.path().join(out).join(file);
    let patience = Instant::now() + Duration::from_secs(60);
    while fs::read_to_string(&path).unwrap_or_default().lines().count() < lines {
        assert!(Instant::now() < patience, "the run goes on");
        if child.try_wait().unwrap().is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child
}

#[test]
fn the_same_seed_gives_the_same_archive_on_any_number_of_threads_and_after_being_killed() {
    let bench = bench();
    let one = straight(&bench, "1");
    assert_eq!(straight(&bench, "2"), one);
    assert_eq!(straight(&bench, "8"), one);
    for (file, lines) in
        [("walks/seed-3/progress.jsonl", 2), ("walks/seed-3/progress.jsonl", 9), ("turns/seed-3/progress.jsonl", 3)]
    {
        let mut child = start(&bench, "killed", &[], file, lines);
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let resumed = bench.run(&["evolve", "runs.nb", "--out", "killed", "--resume"]);
    assert_eq!(resumed.status, 0, "{}", resumed.err);
    assert_eq!(read(&bench, "killed"), one);
    let progress = |out: &str| fs::read_to_string(bench.path().join(out).join("walks/seed-3/progress.jsonl")).unwrap();
    assert_eq!(progress("killed"), progress("threads-1"), "each generation has one line");
}

#[test]
#[cfg(unix)]
fn a_signal_ends_a_run_in_good_order() {
    let bench = bench();
    for signal in ["TERM", "USR1", "INT"] {
        let mut child = start(&bench, signal, &["--generations", "1000000"], "walks/seed-3/progress.jsonl", 1);
        let sent = std::process::Command::new("kill").args(["-s", signal, &child.id().to_string()]).status().unwrap();
        assert!(sent.success());
        assert_eq!(child.wait().unwrap().code(), Some(4));
        assert!(bench.path().join(signal).join(CHECKPOINTS[0]).exists());
    }
}

#[test]
fn a_checkpoint_that_does_not_fit_is_refused_and_left_alone() {
    let bench = bench();
    let first = ["evolve", "runs.nb", "--run", "walks", "--generations", "2", "--out", "out"];
    assert_eq!(bench.run(&first).status, 0);
    let path = bench.path().join("out").join(CHECKPOINTS[0]);
    let whole = fs::read(&path).unwrap();
    let check = |bytes: &[u8], arguments: &[&str], expected: &str| {
        fs::write(&path, bytes).unwrap();
        let ran = bench.run(arguments);
        assert_eq!(ran.status, 2, "{expected}");
        assert!(ran.err.contains(expected), "{}", ran.err);
        assert_eq!(fs::read(&path).unwrap(), bytes);
    };
    let resume = [&first[..], &["--resume"]].concat();
    check(&whole, &first, "holds a run already");
    let mut damaged = whole.clone();
    damaged[whole.len() / 2] ^= 4;
    check(&damaged, &resume, "is damaged");
    check(b"", &resume, "is no checkpoint");
    let foreign = RUNS.replace("batch:       8", "batch:       9");
    bench.file("runs.nb", foreign);
    check(&whole, &resume, "made by another declaration");
}

fn declared(name: &str) -> Evolution {
    let mut world = MemoryWorld::default();
    world.insert("runs.nb", RUNS);
    let evolutions = pipeline::load(&world, "runs.nb").checked.program.evolutions;
    evolutions.into_iter().find(|evolution| evolution.name == name).unwrap()
}

#[test]
fn what_is_left_out_changes_no_archive() {
    for name in ["walks", "turns"] {
        let evolution = declared(name);
        let empty = Search::new(&evolution, 3);
        let (mut staged, mut full) = (empty.clone(), empty.clone());
        for _ in 0..evolution.generations {
            let candidates = staged.ask();
            assert_eq!(candidates, full.ask());
            staged.tell(&candidates, &evaluate(&staged, &candidates).0);
            // An empty archive could take everything, so nothing is left out.
            full.tell(&candidates, &evaluate(&empty, &candidates).0);
            assert_eq!(staged.archive(), full.archive());
        }
        assert_eq!(full.counts().surpassed, 0);
        assert!(staged.counts().surpassed > 0, "something was left out of `{name}`");
    }
}

#[test]
fn a_run_is_told_in_words_and_in_json() {
    let bench = bench();
    let arguments = ["evolve", "runs.nb", "--run", "walks", "--generations", "3"];
    let text = bench.run(&[&arguments[..], &["--out", "a"]].concat());
    assert!(text.out.contains("walks, seed 3") && text.out.contains("3 generations"), "{}", text.out);
    assert_eq!(text.err, "", "nothing but the terminal hears of progress");
    let json = bench.run(&[&arguments[..], &["--out", "b", "--format", "json"]].concat());
    let ended: serde_json::Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!((&ended[0]["run"], &ended[0]["generation"]), (&"walks".into(), &3.into()));
    let unknown = bench.run(&["evolve", "runs.nb", "--run", "walk"]);
    assert_eq!(unknown.status, 2);
    assert!(unknown.err.contains("no evolution is called `walk`"), "{}", unknown.err);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..ProptestConfig::default() })]

    #[test]
    fn exchanging_sensors_is_exact_to_the_bit(codes in prop::collection::vec(0u8..9, 12), order in Just([0, 1, 2, 3]).prop_shuffle()) {
        let mut codes = codes;
        codes[10] = 3;
        let body = Body::new(4, 3, codes);
        let setting = Setting::paper();
        let schedule = |patterns: [Pattern; 4]| Schedule { spells: patterns.map(|pattern| Spell { pattern, steps: 60 }).to_vec() };
        let after = order.map(|i| Pattern::PAIRS[i]);
        for recoding in recodings(&setting.palette) {
            let before = after.map(|pattern| recoding.before(pattern));
            let trials = [
                Trial { body: body.clone(), schedule: schedule(before) },
                Trial { body: recoding.body(&body), schedule: schedule(after) },
            ];
            let both = run_trials(&setting, &trials);
            prop_assert_eq!(&both[0], &both[1]);
        }
    }
}
