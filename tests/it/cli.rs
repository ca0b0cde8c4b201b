//! The command line of the real program: its output and its exit status.

use std::process::{Command, Stdio};

use nbc_base::model::CYCLE_STEPS;
use nbc_sim::Constants;

use crate::support::*;

#[test]
fn simulate_prints_every_env_step_as_json() {
    let bench = Bench::with("walker.yaml", WALKER);
    let arguments = ["simulate", "walker.yaml", "--schedule", "00*1 01*56steps", "--format", "json"];
    let found = bench.run(&arguments).expect_json();
    let com_x: Vec<f64> = found["com_x"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    assert_eq!(com_x.len(), 84 + 56 + 1);
    let walked: Vec<f64> = found["displacement"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    assert_eq!(walked, [com_x[84] - com_x[0], com_x[140] - com_x[84]]);
    assert_eq!(found["unstable_at"], Value::Null);
    assert_eq!(bench.run(&arguments).expect_json(), found, "the same run gives the same numbers");
}

#[test]
fn simulate_reads_json_and_places_the_body() {
    let bench = Bench::with("walker.json", r#"{"name": "x", "body": [[3]]}"#);
    let found = bench.run("simulate walker.json --schedule 00*1steps --start-x 30 --world-width 60 --format json");
    // One voxel's first env step, docs/physics.md 13.
    let second = (29.972641329456213 + 30.996388239344416) / 2.0;
    for (i, expected) in [30.5, second].into_iter().enumerate() {
        assert!((found.expect_json()["com_x"][i].as_f64().unwrap() - expected).abs() < 1e-9);
    }
}

#[test]
fn an_unstable_body_is_a_result_that_fails() {
    let bench = Bench::with("wild.yaml", "body: ['57070', '73873', '00304', '00001', '00861']");
    let place = ["--start-x", "28", "--world-width", "60"];
    let arguments = [&["simulate", "wild.yaml", "--schedule", "11*60steps 00*60steps"], &place[..]].concat();
    let ran = bench.run(&[&arguments[..], &["--format", "json"]].concat());
    assert_eq!(ran.status, 1, "{}", ran.err);
    let found = validate("simulate", &ran.out);
    assert_eq!(found["unstable_at"], 72);
    assert_eq!(found["com_x"].as_array().unwrap().len(), 72);
    assert!(found["displacement"][0].is_number() && found["displacement"][1].is_null());
    let ran = bench.run(&arguments);
    assert_eq!(ran.status, 1);
    assert!(ran.out.ends_with("FAIL: the robot became unstable in env step 72\n"), "{}", ran.out);
}

#[test]
fn a_body_must_stand_on_the_ground() {
    let bench = Bench::with("walker.yaml", WALKER);
    let simulate = |more: &[&str]| bench.run(&[&["simulate", "walker.yaml", "--schedule", "00*1"], more].concat());
    simulate(&["--start-x", "496"]).expect_fault(&["`--start-x 496` is off the ground", "at most 495"]);
    simulate(&["--world-width", "4"]).expect_fault(&["too narrow for a body of 5"]);
    simulate(&["--world-width", "99999999"]).expect_fault(&["too wide"]);
    assert_eq!(simulate(&["--start-x", "495"]).status, 0);
}

#[test]
fn usage_errors_end_with_status_2() {
    let bench = Bench::new();
    for arguments in [&["simulat"][..], &["simulate"], &["simulate", "x"], &["--format", "xml"], &[]] {
        assert_eq!(bench.run(arguments).status, 2, "{arguments:?}");
    }
    bench.ok("--help");
    assert!(bench.run("--version").out.starts_with("nbc "));
}

#[test]
fn every_command_has_help_with_an_example() {
    let bench = Bench::new();
    let help = bench.run("--help").out;
    let listed = help.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let commands: Vec<&str> = listed.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(commands.len() > 3);
    for command in commands.iter().filter(|command| **command != "help") {
        let help = bench.run(&[command, "--help"]).out;
        assert!(help.contains("Example"), "`nbc {command} --help` has no example:\n{help}");
    }
}

#[test]
fn colors_are_used_only_on_request() {
    let bench = Bench::new();
    let color =
        |when| bench.run(&["simulate", "none.yaml", "--schedule", "00*1", "--color", when]).err.contains('\u{1b}');
    assert!(color("always"));
    assert!(!color("never") && !color("auto"));
}

/// A file whose test of `flip` passes or fails.
pub fn flip(passes: bool) -> String {
    let low = u8::from(passes);
    format!("circuit flip(a) -> (y) {{\n    y = not a\n}}\n\ntest flip {{\n    a | y\n    0 | {low}\n}}\n")
}

/// The exit status and standard error of the program if its standard output is closed from the start.
fn unread(bench: &Bench, line: &str) -> (Option<i32>, String) {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = end(bench.command(line).stdout(writer).stderr(Stdio::piped()).spawn().unwrap());
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_closed_pipe_does_not_change_the_verdict() {
    let bench = Bench::with("failing.nb", flip(false));
    bench.file("passing.nb", flip(true));
    bench.file("wide.nb", flip(true).replace("not a", "not  a"));
    bench.file("wrong.nb", "circuit");
    bench.file("walker.yaml", WALKER);
    for (line, status) in [
        ("test --logic failing.nb failing.nb", 1),
        ("test --logic failing.nb passing.nb --format json", 1),
        ("test --logic passing.nb", 0),
        ("run failing.nb --no-report", 1),
        ("run passing.nb --no-report", 0),
        ("fmt --check wide.nb passing.nb", 1),
        ("check wrong.nb --format json", 2),
        ("simulate walker.yaml --schedule 00*60 --format json", 0),
    ] {
        assert_eq!(unread(&bench, line), (Some(status), String::new()), "{line}");
    }
}

#[test]
fn a_closed_pipe_does_not_stop_the_work() {
    let small = "evolution small { box: 3 x 2, fixed: 1 cycles, batch: 4, generations: 2, seed: 1..3 }\n";
    let bench = Bench::with("small.nb", small);
    assert_eq!(unread(&bench, "evolve small.nb").0, Some(0));
    for seed in 1..=3 {
        let progress = bench.read(format!("out/small/seed-{seed}/progress.jsonl"));
        assert_eq!(progress.lines().count(), 2, "seed {seed} was run");
    }
}

#[test]
fn a_full_disk_is_reported() {
    let bench = Bench::new();
    for line in ["completions bash", "--help", "--version", "evolve --help", "explain"] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let ran = Ran::from(end(bench.command(line).stdout(full).stderr(Stdio::piped()).spawn().unwrap()));
        assert!(ran.status == 2 && ran.err.contains("cannot write the output"), "{line}: {}", ran.err);
    }
}

/// The program, run by a user who may not start more threads. Root has no such limit, so root becomes nobody.
#[cfg(target_os = "linux")]
fn without_threads(prlimit: &Path, bench: &Bench, arguments: &[&str]) -> Ran {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    fs::set_permissions(bench.path(), fs::Permissions::from_mode(0o777)).unwrap();
    let program = bench.path().join("nbc");
    fs::copy(env!("CARGO_BIN_EXE_nbc"), &program).unwrap();
    let is_root = fs::metadata("/proc/self").unwrap().uid() == 0;
    let mut command = Command::new(if is_root { "setpriv" } else { "env" });
    command.args(if is_root { &["--reuid=65534", "--clear-groups"][..] } else { &[] });
    command.arg(prlimit).arg("--nproc=1").arg(program).args(arguments);
    command.current_dir(bench.path()).env("RAYON_NUM_THREADS", "8").ran()
}

#[test]
#[cfg(target_os = "linux")]
fn fewer_threads_do_the_work_if_the_system_refuses_some() {
    let Some(prlimit) = PRLIMIT.find() else { return };
    let bench = Bench::with("walker.yaml", WALKER);
    bench.file("passing.nb", flip(true));
    let arguments = ["simulate", "walker.yaml", "--schedule", "00*1", "--format", "json"];
    let alone = without_threads(&prlimit, &bench, &arguments);
    assert!(alone.status == 0 && alone.err.contains("1 of 8 threads"), "{}", alone.err);
    assert_eq!(alone.out, bench.run(&arguments).out);
    let tests = without_threads(&prlimit, &bench, &["test", "--physics", "passing.nb", "passing.nb"]);
    assert_eq!(tests.status, 0, "{}", tests.err);
}

#[test]
fn completions_name_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        let script = Bench::new().run(&["completions", shell]).out;
        assert!(script.contains("simulate") && script.contains("library"), "{shell}");
    }
}

#[test]
fn a_report_of_a_defect_names_the_program_and_the_machine_but_no_person() {
    let told = Bench::new().run("bug-report").out;
    for word in ["features", "system", "processor", "kernel", "threads", "yosys"] {
        assert!(told.contains(&format!("\n{word} ")), "{told}");
    }
    assert!(told.starts_with(&format!("nbc        {}\n", env!("CARGO_PKG_VERSION"))), "{told}");
    if let Ok(home) = std::env::var("HOME") {
        assert!(home == "/" || !told.contains(&home), "{told}");
    }
}

#[test]
fn each_command_has_a_page_for_man() {
    let bench = Bench::new();
    bench.ok("manual pages");
    for (page, words) in
        [("nbc", "Circuits made of soft robots"), ("nbc-run", "SYNOPSIS"), ("nbc-library-add", "robot")]
    {
        let text = bench.read(format!("pages/{page}.1"));
        assert!(text.contains(&page.replace('-', "\\-")) && text.contains(words), "{text}");
    }
}

#[test]
fn robot_files_are_read_from_a_pipe() {
    assert_eq!(Bench::new().with_input("simulate /dev/stdin --schedule 00*1", WALKER).status, 0);
}

#[test]
fn every_picture_of_a_robot_is_drawn() {
    let bench = Bench::with("walker.yaml", WALKER);
    let walk = "--schedule '00*1 11*1'";
    for (kind, file, schedule, start) in [
        ("sprite", "a.svg", "", &b"<svg"[..]),
        ("sprite", "a.png", "", b"\x89PNG"),
        ("strip", "b.svg", walk, b"<svg"),
        ("spacetime", "a.PNG", walk, b"\x89PNG"),
        ("gif", "a.gif", walk, b"GIF89a"),
        ("apng", "b.png", walk, b"\x89PNG"),
    ] {
        assert_eq!(bench.ok(&format!("draw walker.yaml --as {kind} -o {file} {schedule}")).out, "");
        assert!(bench.bytes(file).starts_with(start), "{kind} in {file}");
    }
}

#[test]
fn bench_prints_the_speed_as_json() {
    let ran = Bench::new().run("bench --swarm --format json");
    assert_eq!(ran.status, 0, "{}", ran.err);
    let figures = validate("bench", &ran.out);
    assert!(figures["machine"].is_string() && [4, 8].contains(&figures["width"].as_u64().unwrap()));
    let boxes: Vec<_> = figures["cases"].as_array().unwrap().iter().map(|case| case["box"].as_str().unwrap()).collect();
    assert_eq!(boxes, ["5x5", "7x7", "10x10"]);
    let swarm = &figures["swarm"];
    assert!(
        swarm["robots"] == 28
            && ["one_core", "different", "all_threads"].iter().all(|at| swarm[at].as_f64() > Some(0.0))
    );
    let evaluation = 80.0 * f64::from(CYCLE_STEPS * Constants::default().substeps);
    for case in figures["cases"].as_array().unwrap() {
        let speed = |name: &str| case[name].as_f64().unwrap();
        assert!(speed("scalar") > 0.0 && speed("lanes") > speed("scalar"), "{case}");
        assert!((speed("evaluations") * evaluation / speed("lanes") - 1.0).abs() < 1e-9);
    }
}

fn timings(told: &str) -> std::collections::BTreeMap<&str, f64> {
    let rows = told.lines().skip_while(|line| !line.starts_with("stage ")).skip(1);
    let rows = rows.map(|line| line.split_whitespace().collect::<Vec<_>>()).take_while(|row| row.len() == 4);
    rows.map(|row| (row[0], row[1].parse().unwrap())).collect()
}

#[test]
fn timings_do_not_change_results() {
    let bench = Bench::new();
    let file =
        "circuit flip(a) -> (y) {\n    y = not a\n}\ntest flip \"inverts\" {\n    a | y\n    0 | 1\n    1 | 0\n}\n";
    bench.file("flip.nb", file);
    let arguments = ["run", "flip.nb", "--no-report", "--format", "json"];
    let untimed = bench.run(&arguments);
    let timed = bench.run(&[&arguments[..], &["--timings"]].concat());
    assert_eq!((untimed.status, &untimed.out), (timed.status, &timed.out));
    assert!(timings(&untimed.err).is_empty());
    let seconds = timings(&timed.err);
    let stages: Vec<&str> = seconds.keys().copied().collect();
    assert_eq!(stages, ["bookkeeping", "contact", "limits", "output", "springs"], "{}", timed.err);
    assert!(seconds["springs"] > seconds["bookkeeping"], "{}", timed.err);
    assert!(timed.err.contains("lane-substeps per second and thread"), "{}", timed.err);
}

#[test]
fn timings_of_an_evolution_include_archive_and_development() {
    let bench = Bench::new();
    let small = "evolution small { box: 3 x 2, variable: short, fixed: 1 cycles, batch: 4, generations: 2, seed: 1 }";
    bench.runs("small.nb", small);
    let told = bench.ok("evolve small.nb --timings").err;
    assert!(["archive", "development", "output", "springs"].iter().all(|at| timings(&told).contains_key(at)), "{told}");
}

#[test]
#[cfg(feature = "cluster")]
fn workers_and_a_device_cannot_both_simulate() {
    let bench = Bench::new();
    for command in [&["evolve"][..], &["library", "verify"], &["library", "add", "run", "--into", "robots"]] {
        let both = [command, &["--nats", "nats://localhost:4222", "--device", "gpu"]].concat();
        bench.run(&both).expect_fault(&["'--nats <URL>' cannot be used with '--device <DEVICE>'"]);
    }
}

#[test]
fn logic_needs_no_place_where_robots_are_simulated() {
    let bench = Bench::with("gate.nb", "circuit gate(a) -> (y) { y = not a }\ntest gate { a | y\n 0 | 1 }\n");
    let places: &[([&str; 2], &str)] = &[
        (["--device", "gpu"], "--device <DEVICE>"),
        #[cfg(feature = "cluster")]
        (["--nats", "nats://localhost:4222"], "--nats <URL>"),
    ];
    for &(place, name) in places {
        let ran = bench.run(&[&["test", "gate.nb", "--logic"][..], &place].concat());
        ran.expect_fault(&["'--logic'", "cannot be used with", name]);
    }
}

#[test]
fn what_is_looked_up_by_name_offers_the_nearest_one() {
    let bench = Bench::with("passing.nb", flip(true));
    let meant = |line: &str, name: &str| bench.run(line).expect_fault(&[&format!("did you mean `{name}`?")]);
    meant("library show nnad", "nand");
    meant("library show nand5x5", "nand_5x5");
    meant("simulate nnad --schedule 00*1", "nand");
    for command in ["run", "test", "check", "fmt", "build", "evolve"] {
        meant(&format!("{command} pasing.nb"), "passing.nb");
        meant(&format!("{command} passing"), "passing.nb");
    }
    meant("build passing.nb --circuit flop", "flip");
    meant("test passing.nb --only flp", "flip");
    meant("run passing.nb --only flp", "flip");
    meant("evolve --run gaets", "gates");
    meant("draw passing.nb --as schematic --test flp -o x.svg", "flip");
    meant("build passing.nb --cells nnad", "nand");
    meant("explain unknwn", "unknown");
    bench.file("user.nb", "use \"./pasing.nb\"\n");
    meant("check user.nb", "./passing.nb");
    for (line, tip) in [("buld", "'build'"), ("build passing.nb --emit vrilog", "'verilog'")] {
        let ran = bench.run(line);
        assert!(ran.status == 2 && ran.err.contains(tip), "{}", ran.err);
    }
}

#[test]
fn a_circuit_with_parameters_is_built_with_numbers_for_them() {
    let bench = Bench::with("wide.nb", "circuit wide[n, m](a[n], b[m]) -> (q) {\n    q = any(a) nand any(b)\n}\n");
    for arguments in [&["build", "wide.nb"][..], &["build", "wide.nb", "--circuit", "wide[2]"]] {
        let parameter = if arguments.len() == 2 { "n" } else { "m" };
        let message = format!("the parameter `{parameter}` of `wide` has no number");
        bench.run(arguments).expect_fault(&[&message, "such as `--circuit 'wide[4, 4]'`"]);
    }
    bench.ok(&["build", "wide.nb", "--circuit", "wide[4, 4]", "--cells", "nand,not"]);
}

#[test]
fn standard_input_is_formatted_to_standard_output() {
    let bench = Bench::new();
    let (wide, canonical) = (flip(true).replace("not a", "not  a"), flip(true));
    assert_eq!(bench.with_input("fmt -", &wide).out, canonical);
    let check = |text: &str| bench.with_input("fmt --check -", text).status;
    assert_eq!((check(&wide), check(&canonical)), (1, 0));
    let broken = bench.with_input("fmt -", "circuit f(");
    assert_eq!((broken.status, broken.out.as_str()), (2, ""));
    assert_eq!(bench.with_input("fmt - --format json", &wide).status, 2);
}

#[test]
fn an_evolution_that_finds_no_robot_says_so_and_fails() {
    let bench = Bench::new();
    let none = "evolution none { box: 3 x 2, variable: short, fixed: 1 cycles, batch: 1, generations: 1, seed: 2 }\n";
    bench.runs("none.nb", none);
    let ran = bench.run("evolve none.nb");
    assert_eq!(ran.status, 1, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("0 of 16 behaviors") && ran.err.contains("no run found a robot"), "{}", ran.err);
}

#[test]
fn folders_without_robots_are_errors() {
    let bench = Bench::new();
    fs::create_dir(bench.path().join("empty")).unwrap();
    for command in ["list", "verify"] {
        bench.run(&["library", command, "empty"]).expect_fault(&["`empty` contains no robot files"]);
    }
    bench.run("library show nand empty").expect_fault(&["`empty` contains no robot files"]);
}
