//! The speed of the language, in CPU time: `cargo bench --bench language`. It takes half a minute.

// Files of the tests have more than this needs.
#![allow(dead_code, unused_imports)]

use std::fs;
use std::process::{Command, ExitCode};

use nbc_base::source::{MemoryWorld, Sources};
use nbc_circuit::elaborate;
use nbc_lang::check;

use aims::Aims;
use long_program::long_program;
use processor::processor_seconds;
use support::bench::Bench;
use support::limits::InTime;
use support::programs::programs;

mod aims;
#[path = "../tests/it/long_program.rs"]
mod long_program;
mod processor;
#[path = "../tests/it/support/mod.rs"]
mod support;

fn main() -> ExitCode {
    let mut aims = Aims::default();
    check_long_program(&mut aims);
    elaborate_gates(&mut aims);
    start_commands(&mut aims);
    aims.end()
}

/// The most memory that this process has held, in megabytes.
fn peak_megabytes() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    peak.trim().trim_end_matches(" kB").parse::<f64>().unwrap() / 1024.0
}

/// The smallest CPU time of several runs of the program.
fn program_seconds(bench: &Bench, arguments: &[&str], runs: usize) -> f64 {
    let seconds = |minutes: &str| {
        let (minutes, seconds) = minutes.trim_end_matches('s').split_once('m').unwrap();
        minutes.parse::<f64>().unwrap() * 60.0 + seconds.parse::<f64>().unwrap()
    };
    let run = |_| {
        let script = "\"$0\" \"$@\" >/dev/null 2>&1; times";
        let mut command = Command::new("sh");
        command.args(["-c", script, env!("CARGO_BIN_EXE_nbc")]).args(arguments).current_dir(bench.path());
        let said = String::from_utf8(command.output_in_time().stdout).unwrap();
        // The second line is about the shell's children: seconds in the program and in the system.
        said.lines().nth(1).unwrap().split(' ').map(seconds).sum::<f64>()
    };
    (0..runs).map(run).fold(f64::INFINITY, f64::min)
}

fn check_long_program(aims: &mut Aims) {
    let bench = Bench::new();
    bench.file("long.nb", long_program());
    let ran = bench.run(&["check", "long.nb"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let seconds = program_seconds(&bench, &["check", "long.nb"], 10);
    println!("nbc check of 10,000 lines: {:.0} ms", seconds * 1e3);
    let format = program_seconds(&bench, &["fmt", "--check", "long.nb"], 10);
    println!("nbc fmt --check of 10,000 lines: {:.0} ms", format * 1e3);
    aims.check(seconds < 0.2, "10,000 lines are checked in a fifth of a second");
}

fn elaborate_gates(aims: &mut Aims) {
    // Twenty thousand full adders of five gates, twice: one net after the other, and a hierarchy of circuits.
    let text = "
        circuit row[n](a[n], b[n], cin) -> (s[n], cout) {
            net c[n + 1]
            c[0] = cin
            for i in 0..n { (s[i], c[i + 1]) = full_adder(a[i], b[i], c[i]) }
            cout = c[n]
        }
        circuit square[n](a[n], b[n]) -> (s[n * n]) {
            for i in 0..n { (s[i * n + n - 1..i * n], _) = row(a, b, a[i]) }
        }
        circuit large(a[200], b[200]) -> (s[40000]) { s = square(a, b) }";
    let mut sources = Sources::default();
    let file = sources.add("large.nb", text);
    let before = processor_seconds();
    let checked = check::check(&MemoryWorld::default(), &mut sources, file);
    assert!(!checked.has_errors(), "{:?}", checked.diagnostics);
    let between = processor_seconds();
    let netlist = elaborate(&checked.program, &"large".into()).unwrap();
    let seconds = processor_seconds() - between;
    let gates = netlist.cells().count();
    assert!(gates >= 200_000);
    println!("check {:.2} s, elaboration of {gates} gates {seconds:.2} s", between - before);
    aims.check(seconds < 2.0, "200,000 gates are elaborated in two seconds");
    println!("peak {:.0} MB", peak_megabytes());
    aims.check(peak_megabytes() < 1024.0, "they take less than a gigabyte");
}

fn start_commands(aims: &mut Aims) {
    let bench = Bench::new();
    let help = bench.run(&["--help"]).out;
    let listed = help.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let commands: Vec<&str> = listed.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let latch = programs("circuits").into_iter().find(|path| path.ends_with("latch.nb")).unwrap();
    let latch = latch.to_str().unwrap();
    let starts = commands.iter().map(|&command| vec![command, "--help"]);
    let work = [
        vec!["check", latch],
        vec!["fmt", "--check", latch],
        vec!["test", "--logic", latch],
        vec!["explain", "width"],
        vec!["library", "list"],
        vec!["completions", "bash"],
        vec!["build", latch],
    ];
    let mut longest = 0.0f64;
    for arguments in starts.chain(work) {
        let seconds = program_seconds(&bench, &arguments, 10);
        println!("nbc {}: {:.0} ms", arguments.join(" "), seconds * 1e3);
        longest = longest.max(seconds);
    }
    aims.check(longest < 0.02, "every command starts in a fiftieth of a second");
}
