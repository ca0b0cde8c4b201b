//! Arguments of the real program: those that are refused, names of files, and what it says of the files that it writes.

use crate::cli::flip;

use crate::support::*;

fn bench() -> Bench {
    let bench = Bench::with("walker.yaml", WALKER);
    bench.file("flip.nb", flip(true));
    bench
}

#[test]
fn a_negative_number_after_an_option_is_its_value() {
    let bench = bench();
    let simulate = ["simulate", "walker.yaml", "--schedule", "00*1"];
    let whole = "expected a whole number from 0 to 18446744073709551615";
    for (arguments, message) in [
        ([&simulate[..], &["--start-x", "-1"]].concat(), format!("'-1' for '--start-x <COLUMN>': {whole}")),
        ([&simulate[..], &["--world-width", "-7"]].concat(), format!("'-7' for '--world-width <VOXELS>': {whole}")),
        (vec!["evolve", "--seed", "-1"], format!("'-1' for '--seed <SEED>': {whole}")),
        (vec!["evolve", "--seed", "18446744073709551616"], format!("for '--seed <SEED>': {whole}")),
        (vec!["evolve", "--generations", "-5"], "'-5' for '--generations <N>': -5 is not in 1..".to_owned()),
        (vec!["build", "flip.nb", "--circuit", "-1"], "circuit".to_owned()),
    ] {
        let ran = bench.run(&arguments);
        ran.expect_fault(&[&message]);
        assert!(!ran.err.contains("unexpected argument") && !ran.err.contains("tip:"), "{}", ran.err);
    }
}

/// Checks that a command line is refused with one object on standard output that says what standard error says.
#[track_caller]
fn check_json(bench: &Bench, arguments: &[&str], message: &str) {
    let ran = bench.run(arguments);
    assert_eq!(ran.status, 2, "{arguments:?}: {}", ran.err);
    let found = validate("diagnostics", &ran.out);
    let [fault] = &found["diagnostics"].as_array().unwrap()[..] else { panic!("{found}") };
    assert_eq!((&fault["message"], &fault["code"]), (&message.into(), &"bad-value".into()));
    assert!(fault["help"].as_str().is_some_and(|help| help.contains("--help")), "{fault}");
    assert!(!ran.err.is_empty(), "people read it, too");
}

#[test]
fn usage_errors_are_json_if_json_is_asked_for() {
    let bench = bench();
    let unknown = "unrecognized subcommand 'rum'";
    check_json(&bench, &["rum", "--format", "json"], unknown);
    check_json(&bench, &["--format=json", "rum"], unknown);
    check_json(
        &bench,
        &["simulate", "walker.yaml", "--format", "json"],
        "the following required arguments were not provided: --schedule <SCHEDULE>",
    );
    check_json(
        &bench,
        &["build", "flip.nb", "--emit", "vrilog", "--format", "json"],
        "invalid value 'vrilog' for '--emit <EMIT>' [possible values: netlist, passes, blif, verilog, dot, timing, \
         json]",
    );
    check_json(&bench, &["--format", "json"], "the command is missing");
    // Nobody asked for JSON here.
    for arguments in [&["rum"][..], &["rum", "--", "--format", "json"], &["--format", "xml"]] {
        bench.run(arguments).expect_fault(&["error: "]);
    }
    assert!(bench.run("run --help --format json").out.contains("Usage: nbc run"));
}

#[test]
fn names_with_control_characters_are_refused_where_files_are_made() {
    let bench = bench();
    let refused = "a name cannot have control characters";
    for arguments in [
        &["build", "flip.nb", "-o", "a\u{1b}[2Jb.txt"][..],
        &["draw", "walker.yaml", "--as", "sprite", "-o", "a\nb.svg"],
        &["export", "shipped", "-o", "a\rb.csv"],
        &["synth", "a.blif", "-o", "a\u{7}.nb"],
        &["run", "flip.nb", "--out", "a\u{202e}b"],
        &["evolve", "--out", "a\nb"],
        &["new", "a\u{1b}b"],
        &["library", "add", "out/gates", "--into", "a\tb"],
        &["completions", "bash", "-o", "a\nb"],
        &["manual", "a\nb"],
    ] {
        bench.run(arguments).expect_fault(&[refused]);
    }
    assert_eq!(fs::read_dir(bench.path()).unwrap().count(), 2, "nothing was written");
}

#[cfg(unix)]
mod not_text {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    use super::*;

    fn name(ending: &str) -> std::ffi::OsString {
        OsStr::from_bytes(&[b"caf\xe9", ending.as_bytes()].concat()).to_owned()
    }

    fn run(bench: &Bench, arguments: &[&str], last: &OsStr) -> Ran {
        bench.command(arguments).arg(last).ran()
    }

    #[test]
    fn the_name_of_a_source_that_is_not_utf8_is_refused_and_no_other_file_is_used() {
        let bench = bench();
        fs::write(bench.path().join(name(".nb")), flip(true)).unwrap();
        // What such a name looks like as text is the name of another file.
        bench.file("caf\u{fffd}.nb", "circuit");
        for command in ["check", "test", "run", "build", "evolve", "fmt", "watch"] {
            let ran = run(&bench, &[command], &name(".nb"));
            ran.expect_fault(&["the name `caf\u{fffd}.nb` is not valid UTF-8"]);
            let ran = run(&bench, &["--format", "json", command], &name(".nb"));
            assert_eq!(ran.status, 2, "{}", ran.err);
            let message = &validate("diagnostics", &ran.out)["diagnostics"][0]["message"];
            assert_eq!(*message, "the name `caf\u{fffd}.nb` is not valid UTF-8");
        }
    }

    #[test]
    fn a_file_is_written_under_a_name_that_is_not_utf8() {
        let bench = bench();
        for (arguments, ending) in [
            (&["draw", "walker.yaml", "--as", "sprite", "--format", "json", "-o"][..], ".svg"),
            (&["build", "flip.nb", "--emit", "blif", "-o"], ".blif"),
            (&["export", "shipped", "-o"], ".csv"),
        ] {
            let ran = run(&bench, arguments, &name(ending));
            assert_eq!((ran.status, &*ran.err), (0, &*format!("wrote caf\u{fffd}{ending}\n")), "{}", ran.out);
            assert!(bench.has(name(ending)));
        }
    }

    #[test]
    fn results_in_folders_that_are_not_utf8_are_complete() {
        let bench = Bench::new();
        bench.runs(
            "small.nb",
            "evolution small { box: 3 x 2, variable: short, fixed: 1 cycles, batch: 4, generations: 2 }\n",
        );
        let ran = run(&bench, &["evolve", "small.nb", "--format", "json", "--out"], &name(""));
        assert_eq!(ran.status, 0, "{}", ran.err);
        let found = validate("evolve", &ran.out);
        assert_eq!(found["runs"][0]["folder"], "caf\u{fffd}/small/seed-1");
        assert!(bench.path().join(name("")).join("small/seed-1/checkpoint.nbc").exists());
    }
}

#[test]
fn files_that_are_written_are_named_on_standard_error() {
    let bench = bench();
    bench.file("a.blif", ".model a\n.inputs x\n.outputs y\n.names x y\n0 1\n.end\n");
    for (arguments, file) in [
        (&["build", "flip.nb", "--emit", "verilog"][..], "a.v"),
        (&["synth", "a.blif"], "a.nb"),
        (&["draw", "walker.yaml", "--as", "sprite"], "a.svg"),
        (&["export", "shipped"], "a.csv"),
        (&["export", "shipped"], "a.json"),
        (&["completions", "bash"], "deep/inside/nbc"),
    ] {
        let ran = bench.run(&[arguments, &["-o", file]].concat());
        assert_eq!((ran.status, &*ran.err), (0, &*format!("wrote {file}\n")), "{arguments:?}");
        assert!(bench.path().join(file).is_file());
    }
    let script = bench.read("deep/inside/nbc");
    assert_eq!(script, bench.run("completions bash").out);
}

#[test]
fn outputs_in_a_netlist_are_no_cells() {
    let bench = bench();
    let ran = bench.run("build flip.nb");
    assert_eq!(ran.out, "netlist flip(a) -> (y) {\n    y = not(a)\n}\n", "one robot, one line");
    bench.file("two.nb", "circuit two(a) -> (y, z) {\n    y = not a\n    z = y\n}\n");
    let ran = bench.run("build two.nb");
    assert_eq!(ran.out, "netlist two(a) -> (y, z) {\n    y = not(a)\n    z = y\n}\n");
}

#[test]
fn texts_in_tables_are_no_formulas() {
    let bench = bench();
    let robot = text_of("library/robots/nand_5x5.yaml");
    let line = robot.lines().find(|line| line.starts_with("  evolution:")).unwrap();
    bench.file("evil.yaml", robot.replace(line, "  evolution: '=HYPERLINK(1,2)'"));
    let ran = bench.run("export evil.yaml --to csv");
    assert!(ran.out.contains(",\"'=HYPERLINK(1,2)\","), "{}", ran.out);
    // Negative numbers stay numbers.
    assert!(ran.out.contains(",-") && !ran.out.contains("'-"), "{}", ran.out);
}

#[cfg(not(feature = "cluster"))]
#[test]
fn commands_and_options_of_features_that_are_not_there_are_unknown() {
    let bench = bench();
    for command in [&["evolve"][..], &["test"], &["library", "add"], &["library", "verify"]] {
        let help = bench.run(&[command, &["--help"]].concat()).out;
        for option in ["--nats", "--creds", "--tls-ca", "--trust-workers"] {
            assert!(!help.contains(option), "{command:?}: {help}");
        }
        assert_eq!(help.contains("--device"), cfg!(feature = "gpu"), "{command:?}: {help}");
    }
    let listed = bench.run("--help").out;
    for command in ["worker", "workers"] {
        assert!(!listed.contains(&format!("\n  {command} ")), "{listed}");
        bench.run(&[command]).expect_fault(&["unrecognized subcommand"]);
    }
    bench.run("test flip.nb --nats nats://localhost").expect_fault(&["unexpected argument '--nats'"]);
}

#[test]
fn every_digit_of_a_seed_counts() {
    let bench = Bench::new();
    let (seed, most) = ("9007199254740993", "18446744073709551615");
    let text = format!(
        "evolution small {{ box: 3 x 1, variable: short, fixed: 1 cycles, batch: 6, generations: 4, \
         seed: [{seed}, {most}] }}\n"
    );
    bench.runs("small.nb", &text);
    let ran = bench.ok("evolve small.nb --format json");
    let runs: Value = validate("evolve", &ran.out);
    assert_eq!((&runs["runs"][0]["seed"], &runs["runs"][1]["seed"]), (&seed.parse().unwrap(), &most.parse().unwrap()));
    assert!(bench.has(format!("out/small/seed-{seed}/checkpoint.nbc")));
    bench.ok("evolve small.nb --resume");
    // The same seed on the command line is the same run.
    bench.ok(&["evolve", "small.nb", "--seed", seed, "--out", "other"]);
    let read = |folder: &str| fs::read(bench.path().join(folder).join(format!("small/seed-{seed}/progress.jsonl")));
    assert!(read("out").unwrap() == read("other").unwrap());
    let exported = bench.run("export out/small --to csv").out;
    assert!(exported.contains(&format!(",{seed},")) && exported.contains(&format!(",{most},")), "{exported}");
    let robot = text_of("library/robots/nand_5x5.yaml");
    let line = robot.lines().rfind(|line| line.starts_with("  seed:")).unwrap();
    bench.file("robot.yaml", robot.replace(line, &format!("  seed: {most}")));
    let shown = bench.run("library show robot.yaml --format json").expect_json();
    assert_eq!(shown["provenance"]["seed"], most.parse::<Value>().unwrap());
    bench.runs("large.nb", text.replace(most, "18446744073709551616"));
    bench.run("check large.nb").expect_fault(&["`18446744073709551616`", "0 to 18446744073709551615"]);
}

const TWO: &str = "\
evolution small { box: 3 x 1, variable: short, fixed: 1 cycles, batch: 1, newcomers: 0, generations: 3, seed: 1..5 }
evolution other { from: small, batch: 2 }
";

#[test]
fn what_the_command_line_replaces_is_told() {
    let bench = Bench::new();
    bench.runs("two.nb", TWO);
    let ran = bench.run("evolve two.nb --quick --out quick");
    let told =
        "`--quick` runs `small` with 3 seeds of 5 and 200 generations instead of 3\n`--quick` leaves out `other`\n";
    assert!(ran.err.starts_with(told), "{}", ran.err);
}

#[test]
fn a_robot_of_ones_own_is_measured_and_used() {
    let bench = bench();
    let page = text_of("docs/tutorial.md");
    let block = page.split("```yaml file=mine.yaml\n").nth(1).unwrap().split("```").next().unwrap();
    bench.file("mine.yaml", block);
    let ran = bench.ok("library add mine.yaml --into robots");
    let line = ran.out.starts_with("LLLL  zero        added     mine, clock ")
        && ran.out.contains(" % of the switches wrong\n");
    assert!(line && ran.out.ends_with("1 of 1 robot was added to robots\n"), "{}", ran.out);
    let shown = bench.run("library show mine robots --format json").expect_json();
    assert_eq!((&shown["name"], &shown["provenance"]["evolution"]), (&"mine".into(), &"by hand".into()));
}

#[test]
fn bodies_that_cannot_become_robots_are_named() {
    let bench = bench();
    let add = |file: &str| bench.run(&["library", "add", file, "--into", "robots"]);
    bench.file("my robot.yaml", WALKER);
    add("my robot.yaml").expect_fault(&["no robot can have the name of `my robot.yaml`"]);
    bench.file("ragged.yaml", "body: [\"33\", \"3\"]\n");
    add("ragged.yaml").expect_fault(&["row 2 has 1 voxel", "ragged.yaml:1:"]);
    bench.file("wild.yaml", WILD);
    add("wild.yaml").expect_fault(&["the body in `wild.yaml` is unstable at env step "]);
    bench.file("other/walker.yaml", WALKER);
    bench
        .run("library add walker.yaml other/walker.yaml --into robots")
        .expect_fault(&["two robots would be called `walker`"]);
    bench
        .run("library add walker.yaml --behavior nand --into robots")
        .expect_fault(&["`--behavior` chooses among the robots of runs"]);
    assert!(!bench.path().join("robots").join("walker.yaml").exists());
}

#[test]
fn what_library_add_has_measured_is_kept_when_it_is_stopped() {
    let bench = Bench::new();
    // Small bodies that make no errors at the first clock are measured in the shortest time.
    bench.file("left.yaml", "body: [\"33\", \"43\"]\n");
    bench.file("right.yaml", "body: [\"33\", \"34\"]\n");
    bench.file("other.yaml", "body: [\"44\", \"34\"]\n");
    let add = ["library", "add", "left.yaml", "right.yaml", "other.yaml", "--into", "robots"];
    // One after the other, so that the last is left.
    let mut command = bench.command(&add);
    let command = command.env("RAYON_NUM_THREADS", "1").stdout(std::process::Stdio::null());
    let child = command.stderr(std::process::Stdio::piped()).spawn().unwrap();
    let kept = bench.path().join("robots/measured.jsonl");
    until("nothing is measured", || fs::read_to_string(&kept).is_ok_and(|text| text.ends_with('\n')));
    signal("INT", child.id());
    let stopped = limits::end(child);
    let told = String::from_utf8(stopped.stderr).unwrap();
    assert_eq!(stopped.status.code(), Some(4), "{told}");
    assert!(told.contains("complete; the same command goes on from here\n"), "{told}");
    let resumed = bench.run(&add);
    assert!(resumed.err.contains(" known from an earlier command\n"), "{}", resumed.err);
    assert_eq!(resumed.status, 0, "{}", resumed.out);
    assert!(resumed.out.ends_with("3 of 3 robots were added to robots\n") && !kept.exists(), "{}", resumed.out);
}
