//! Evolution runs through the real program: the same bits on any number of threads and after any interruption; images
//! that are exact.

use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

use nbc_base::model::{Body, Evolution, Palette, Pattern, Schedule, Setting, Spell, Trial};

use nbc_session::store::lock_folder;
use nbc_sim::Simulator;
use nbc_swarm::evolve::{Search, recodings};
use nbc_swarm::{evaluate, evaluate_bodies};
use proptest::prelude::*;

use crate::support::*;

/// Two small runs, one for each objective.
const RUNS: &str = "
evolution walks {
    box:         3 x 2
    variable:    short
    fixed:       1 cycles
    batch:       6
    generations: 12
    seed:        3
}

evolution turns {
    from:        walks
    objective:   gate
    symmetry:    npn
    niche:       pareto(3)
    as:          code
    batch:       2
    generations: 2
}
";

const CHECKPOINTS: [&str; 2] = ["walks/seed-3/checkpoint.nbc", "turns/seed-3/checkpoint.nbc"];

fn bench() -> Bench {
    let bench = Bench::new();
    bench.runs("runs.nb", RUNS);
    bench
}

fn straight(bench: &Bench, threads: &str) -> Vec<Vec<u8>> {
    let out = format!("threads-{threads}");
    let mut command = bench.command(&["evolve", "runs.nb", "--out", &out]);
    let ended = command.env("RAYON_NUM_THREADS", threads).output_in_time();
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    read(bench, &out)
}

fn read(bench: &Bench, out: &str) -> Vec<Vec<u8>> {
    CHECKPOINTS.map(|path| fs::read(bench.path().join(out).join(path)).unwrap()).into()
}

/// The command with a limit on the size of files, in blocks of 512 bytes. A write beyond it kills the program, unless
/// `before` ignores the signal.
#[cfg(unix)]
fn limited(bench: &Bench, blocks: u32, before: &str, arguments: &[&str]) -> Command {
    let program = bench.command(&[]).get_program().to_owned();
    let mut command = Command::new("sh");
    let script = format!("ulimit -c 0; ulimit -f {blocks}; {before} exec \"$@\"");
    command.args(["-c", &script, "sh"]).arg(program).args(arguments).current_dir(bench.path());
    command
}

#[test]
fn the_same_seed_gives_the_same_archive_on_any_number_of_threads() {
    let bench = bench();
    let one = straight(&bench, "1");
    assert_eq!(straight(&bench, "2"), one);
    assert_eq!(straight(&bench, "8"), one);
}

#[test]
#[cfg(unix)]
fn the_same_seed_gives_the_same_archive_after_being_killed() {
    use std::os::unix::process::ExitStatusExt;

    let bench = bench();
    let one = straight(&bench, "1");
    let resume = ["evolve", "runs.nb", "--out", "killed", "--resume", "--checkpoint-every", "0"];
    let mut generations = Vec::new();
    for blocks in [4, 8, 16, 24] {
        let ended = limited(&bench, blocks, "", &resume).output_in_time();
        assert!(ended.status.signal().is_some(), "{blocks}: {ended:?}");
        let checkpoint = fs::read(bench.path().join("killed").join(CHECKPOINTS[0])).unwrap_or_default();
        generations.push(checkpoint.len());
    }
    assert!(generations.is_sorted_by(|before, after| before < after), "{generations:?}");
    // The first run prints its table when it is finished; then the second one is killed.
    let mut child = bench.command(&resume).stdout(Stdio::piped()).spawn().unwrap();
    let limit = Limit::of(&child);
    let first = BufReader::new(child.stdout.take().unwrap()).lines().next();
    assert_eq!(first.unwrap().unwrap(), "walks, seed 3");
    child.kill().unwrap();
    child.wait().unwrap();
    drop(limit);
    bench.ok("evolve runs.nb --out killed --resume");
    assert_eq!(read(&bench, "killed"), one);
    let progress = |out: &str| fs::read_to_string(bench.path().join(out).join("walks/seed-3/progress.jsonl")).unwrap();
    assert_eq!(progress("killed"), progress("threads-1"), "each generation has one line");
}

#[test]
fn seeds_that_advance_together_leave_the_files_of_each_alone() {
    let bench = bench();
    bench.runs(
        "runs.nb",
        RUNS.replace("seed:        3", "seed:        1..3").replace("generations: 12", "generations: 5"),
    );
    let evolve = |arguments: &[&str]| {
        let ended = bench.ok(&[&["evolve", "runs.nb"], arguments].concat());
        ended.out
    };
    evolve(&["--out", "together"]);
    // One of them is ahead of the others when they continue.
    evolve(&["--run", "walks", "--seed", "2", "--generations", "2", "--out", "late"]);
    let said = evolve(&["--run", "walks", "--out", "late", "--resume"]);
    let order: Vec<&str> = said.lines().filter(|line| line.starts_with("walks, seed")).collect();
    assert_eq!(order, ["walks, seed 1", "walks, seed 2", "walks, seed 3"]);
    for seed in ["1", "2", "3"] {
        evolve(&["--seed", seed, "--out", "alone"]);
        for run in ["walks", "turns"] {
            let read = |out: &str, name: &str| {
                fs::read_to_string(bench.path().join(out).join(run).join(format!("seed-{seed}")).join(name)).unwrap()
            };
            // A checkpoint also has the seeds that were declared.
            let contents = |out: &str| {
                let text = read(out, "checkpoint.nbc");
                let whole: Value = serde_json::from_str(text.split_once('\n').unwrap().1).unwrap();
                let parts = ["state", "env_steps", "left_out"].map(|part| whole[part].to_string());
                (parts, read(out, "progress.jsonl"))
            };
            assert!(contents("together") == contents("alone"), "{run}, seed {seed}");
            if run == "walks" {
                assert!(contents("late") == contents("alone"), "seed {seed}");
            }
        }
    }
}

#[test]
#[cfg(unix)]
fn a_signal_ends_a_run_with_a_checkpoint() {
    let bench = bench();
    for name in ["TERM", "USR1", "INT"] {
        let arguments = ["evolve", "runs.nb", "--out", name, "--generations", "1000000"];
        let mut child = bench.command(&arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        let _limit = Limit::of(&child);
        // The program watches signals before it estimates the time of a long run.
        let estimate = BufReader::new(child.stderr.take().unwrap()).lines().next().unwrap().unwrap();
        assert!(estimate.starts_with("at most about ") && estimate.contains(" hours on this machine"), "{estimate}");
        signal(name, child.id());
        assert_eq!(child.wait().unwrap().code(), Some(4));
        assert!(bench.path().join(name).join(CHECKPOINTS[0]).exists());
    }
}

#[test]
fn a_checkpoint_that_does_not_fit_is_rejected_and_unchanged() {
    let bench = bench();
    let first = ["evolve", "runs.nb", "--run", "walks", "--generations", "2", "--out", "out"];
    bench.ok(&first);
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
    check(&whole[..whole.len() / 2], &resume, "is damaged: its checksum does not match");
    check(b"PK\x03\x04 something else\n", &resume, "is not a checkpoint");
    for format in ["0", "3"] {
        let header = format!("nbc-checkpoint {format} ");
        let other = String::from_utf8(whole.clone()).unwrap().replacen("nbc-checkpoint 2 ", &header, 1);
        check(other.as_bytes(), &resume, &format!("is a checkpoint of format {format}, expected format 2"));
    }
    bench.runs("runs.nb", RUNS.replace("batch:       6", "batch:       7"));
    check(&whole, &resume, "was made by a different declaration of `walks`");
    bench.runs("runs.nb", RUNS);
    let other = bench.path().join("out/walks/seed-4");
    fs::create_dir_all(&other).unwrap();
    fs::copy(&path, other.join("checkpoint.nbc")).unwrap();
    check(&whole, &[&resume[..], &["--seed", "4"]].concat(), "belongs to seed 3, expected seed 4");
}

#[test]
fn a_folder_in_use_is_unchanged_and_its_process_reported() {
    let bench = bench();
    let arguments = ["evolve", "runs.nb", "--run", "walks", "--resume"];
    bench.ok(&[&arguments[..], &["--generations", "2"]].concat());
    let folder = bench.path().join("out/walks/seed-3");
    let contents = || ["checkpoint.nbc", "progress.jsonl"].map(|name| fs::read(folder.join(name)).unwrap());
    let (before, lock) = (contents(), lock_folder(&folder).unwrap());
    let said = format!("`out/walks/seed-3` is in use by process {}", std::process::id());
    bench.run(&arguments).expect_fault(&["unwritable", &said]);
    assert_eq!(contents(), before);
    drop(lock);
    bench.ok(&arguments);
    assert_ne!(contents(), before);
}

#[test]
fn a_damaged_history_is_reported_and_set_aside() {
    let bench = bench();
    let arguments = ["evolve", "runs.nb", "--run", "walks", "--resume"];
    bench.ok(&[&arguments[..], &["--generations", "6"]].concat());
    let path = bench.path().join("out/walks/seed-3/progress.jsonl");
    let whole = fs::read_to_string(&path).unwrap();
    let mut lines: Vec<&[u8]> = whole.lines().map(str::as_bytes).collect();
    lines[2] = b"\xff\0 nothing";
    let damaged = lines.join(&b'\n');
    fs::write(&path, &damaged).unwrap();
    let said = "`out/walks/seed-3/progress.jsonl` has no readable line for 1 of 6 generations, the first of";
    let drawn = bench.run("draw out/walks --as progress -o a.svg");
    assert!(drawn.status == 0 && drawn.err.contains(said), "{}", drawn.err);
    let resumed = bench.run(&arguments);
    assert!(resumed.status == 0 && resumed.err.contains(said), "{}", resumed.err);
    assert!(resumed.err.contains("progress.jsonl.damaged"), "{}", resumed.err);
    assert_eq!(fs::read(path.with_extension("jsonl.damaged")).unwrap(), damaged);
    let text = fs::read_to_string(&path).unwrap();
    let kept: Vec<&str> = text.lines().collect();
    let before: Vec<&str> = whole.lines().collect();
    assert_eq!((kept.len(), &kept[..2], &kept[2..5]), (11, &before[..2], &before[3..]));
}

#[test]
fn the_same_run_is_not_counted_twice() {
    let bench = bench();
    bench.ok("evolve runs.nb --run walks --generations 2");
    let (own, copy) = (bench.path().join("out/walks/seed-3"), bench.path().join("out/walks/seed-4"));
    fs::create_dir_all(&copy).unwrap();
    fs::copy(own.join("checkpoint.nbc"), copy.join("checkpoint.nbc")).unwrap();
    let ran = bench.run("draw out/walks --as comparison -o a.svg");
    ran.expect_fault(&["`out/walks/seed-4/checkpoint.nbc` has seed 3, like another run in the folder"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_reported() {
    let bench = bench();
    bench.file("taken", "a file");
    let ran = bench.run("evolve runs.nb --run walks --out taken");
    ran.expect_fault(&["unwritable", "cannot write `taken/walks/seed-3`"]);
    fs::create_dir_all(bench.path().join("out").join(CHECKPOINTS[0])).unwrap();
    let ran = bench.run("evolve runs.nb --run walks");
    ran.expect_fault(&["cannot read `out/walks/seed-3/checkpoint.nbc`"]);
}

/// A limit on the size of files is like a full disk: a write fails in the middle.
#[test]
#[cfg(unix)]
fn a_run_continues_from_its_last_checkpoint_after_a_full_disk() {
    let bench = bench();
    let arguments = ["evolve", "runs.nb", "--run", "walks", "--checkpoint-every", "0"];
    let ran = limited(&bench, 16, "trap '' XFSZ;", &arguments).output_in_time();
    let told = String::from_utf8(ran.stderr).unwrap();
    assert_eq!(ran.status.code(), Some(2), "{told}");
    assert!(told.contains("cannot write `out/walks/seed-3/"), "{told}");
    let path = bench.path().join("out").join(CHECKPOINTS[0]);
    assert!(path.exists(), "some generations had room");
    bench.ok(&[&arguments[..], &["--resume"]].concat());
    bench.ok(&[&arguments[..], &["--out", "roomy"]].concat());
    assert_eq!(fs::read(path).unwrap(), fs::read(bench.path().join("roomy").join(CHECKPOINTS[0])).unwrap());
    let left: Vec<_> = fs::read_dir(bench.path().join("out/walks/seed-3")).unwrap().collect();
    assert_eq!(left.len(), 3, "no half-written files stay: {left:?}");
}

#[test]
fn each_generation_writes_a_line_and_the_run_prints_a_table() {
    let bench = bench();
    let ran = bench.run("evolve runs.nb --run walks");
    let text = bench.read("out/walks/seed-3/progress.jsonl");
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 12);
    let mut fields: Vec<&str> = lines[0].as_object().unwrap().keys().map(String::as_str).collect();
    fields.sort_unstable();
    assert_eq!(
        fields.join(" "),
        "behaviors best coverage env_steps evaluations faults filled generation improved inconsistent left_out new \
         qd_score surpassed undeveloped"
    );
    for (generation, two) in (1..).zip(lines.windows(2)) {
        assert_eq!(two[0]["generation"], generation);
        for rising in ["evaluations", "coverage", "qd_score", "behaviors", "env_steps"] {
            assert!(two[0][rising].as_f64() <= two[1][rising].as_f64(), "{rising} falls after {generation}");
        }
    }
    let last = &lines[11];
    let best = last["best"].as_object().unwrap();
    assert_eq!(last["behaviors"], best.len());
    for (behavior, fitness) in best {
        let line = ran.out.lines().find(|line| line.starts_with(behavior)).unwrap_or_else(|| panic!("{}", ran.out));
        let numbers: Vec<&str> = line.split_whitespace().collect();
        let shown = [0, 1].map(|i| format!("{:.3}", fitness[i].as_f64().unwrap()));
        assert_eq!(numbers[3..], shown, "{line}");
    }
    let counted = format!("12 generations, {} evaluations", last["evaluations"]);
    assert!(ran.out.contains(&counted) && ran.out.contains("left out"), "{}", ran.out);
}

fn declared(name: &str) -> Evolution {
    checked(format!("{SHORT}{RUNS}")).program.evolution(name).unwrap().clone()
}

#[test]
fn bodies_are_evaluated_as_candidates_of_an_empty_archive_are() {
    for name in ["walks", "turns"] {
        let search = Search::new(&Evolution { generations: 1, ..declared(name) }, 4);
        let candidates = search.ask();
        let bodies = candidates.iter().map(|candidate| candidate.body.clone()).collect();
        let (expected, _) = evaluate(&Simulator::default(), &search, &candidates);
        assert_eq!(evaluate_bodies(&Simulator::default(), search.evolution(), bodies), expected, "{name}");
    }
}

#[test]
fn a_run_is_reported_as_text_and_as_json() {
    let bench = bench();
    let arguments = ["evolve", "runs.nb", "--run", "walks", "--generations", "3"];
    let text = bench.run(&[&arguments[..], &["--out", "a"]].concat());
    assert!(text.out.contains("walks, seed 3") && text.out.contains("3 generations"), "{}", text.out);
    assert_eq!(text.err, "", "nothing but the terminal hears of progress");
    let json = bench.run(&[&arguments[..], &["--out", "b", "--format", "json"]].concat());
    let ended = &json.expect_json()["runs"][0];
    assert_eq!((&ended["run"], &ended["generation"]), (&"walks".into(), &3.into()));
    let unknown = bench.run("evolve runs.nb --run walk");
    assert_eq!(unknown.status, 2);
    assert!(unknown.err.contains("no evolution is called `walk`"), "{}", unknown.err);
}

#[test]
fn a_file_runs_its_own_evolutions_and_others_by_name() {
    let bench = bench();
    bench.file("user.nb", "use \"runs.nb\"\n\nevolution strolls { from: walks, generations: 2 }\n");
    bench.file("idle.nb", "use \"runs.nb\"\n");
    let runs = |arguments: &[&str]| {
        let json = bench.run(&[&["evolve", "--format", "json"], arguments].concat()).expect_json();
        json["runs"].as_array().unwrap().iter().map(|run| run["run"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(runs(&["user.nb", "--out", "a"]), ["strolls"]);
    assert_eq!(runs(&["user.nb", "--run", "walks", "--generations", "2", "--out", "b"]), ["walks"]);
    let idle = bench.run("evolve idle.nb");
    assert_eq!(idle.status, 2);
    assert!(idle.err.contains("`idle.nb` declares no evolution"), "{}", idle.err);
    assert!(idle.err.contains("run one that it uses with `--run`: `gates`, `walks` or `turns`"), "{}", idle.err);
}

#[test]
fn several_runs_are_compared_as_text_and_as_json() {
    let bench = bench();
    bench.runs("three.nb", RUNS.replace("seed:        3", "seed:        1..3"));
    let arguments = ["evolve", "three.nb", "--run", "walks", "--generations", "8"];
    let text = bench.run(&[&arguments[..], &["--out", "a"]].concat()).out;
    assert!(text.contains("walks, 3 runs: ") && text.contains("adjusted by Holm for"), "{text}");
    assert!(text.contains("cannot reach p < 0.05, whatever the values"), "{text}");
    let json = bench.run(&[&arguments[..], &["--out", "b", "--format", "json"]].concat()).expect_json();
    let comparison = &json["comparisons"][0];
    assert_eq!((json["runs"].as_array().unwrap().len(), &comparison["seeds"]), (3, &3.into()));
    let groups = comparison["groups"].as_array().unwrap();
    let found = groups.iter().filter(|group| group["values"][0].is_number()).count();
    let pairs = comparison["pairs"].as_array().unwrap();
    assert!(found > 1 && pairs.len() == found * (found - 1) / 2, "{pairs:?}");
    assert!(pairs.iter().all(|pair| pair["p_adjusted"].as_f64() >= pair["p"].as_f64()));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..ProptestConfig::default() })]

    #[test]
    fn exchanging_sensors_is_exact_to_the_bit(
        codes in prop::collection::vec(0u8..9, 12),
        order in Just([0, 1, 2, 3]).prop_shuffle(),
    ) {
        let mut codes = codes;
        codes[10] = 3;
        let body = Body::new(4, 3, codes, Palette::paper());
        let setting = Setting::default();
        let spells = |patterns: [Pattern; 4]| patterns.map(|pattern| Spell::of(pattern, 60)).to_vec();
        let schedule = |patterns: [Pattern; 4]| Schedule { spells: spells(patterns) };
        let after = order.map(|i| Pattern::PAIRS[i]);
        for recoding in recodings(body.palette()) {
            let before = after.map(|pattern| recoding.before(pattern));
            let trials = [
                Trial { body: body.clone(), schedule: schedule(before) },
                Trial { body: recoding.body(&body), schedule: schedule(after) },
            ];
            let both = Simulator::default().run_trials(&setting, &trials);
            prop_assert_eq!(&both[0], &both[1]);
        }
    }
}
