//! `nbc library verify`, `nbc library add` and `nbc test` with workers: what they print and write is what they print
//! and write alone.

use crate::cluster::server::Server;
use crate::cluster::wire::{Wire, subject_of};
use crate::cluster::{Running, files, worker};
use crate::support::*;

/// A circuit with a test that it passes, one that it fails, and one at the level of logic.
const LATCH: &str = "\
circuit sr_latch(ns, nr) -> (q, nq) {
    q init 0  = nand(ns, nq)
    nq init 1 = nand(nr, q)
}

test sr_latch \"remembers\" {
    ns nr | q nq
    1  1  | 0 1
    0  1  | 1 0
    1  1  | 1 0
}

world rough { friction: 0.8, missed: 0.1, weak: 0.1, seed: 3 }

test sr_latch \"is told what is wrong\" in rough {
    ns nr | q nq
    1  1  | 0 1
    0  1  | 0 1
}
";

const WALKS: &str = "\
evolution walks { box: 3 x 1, variable: short, fixed: 1 cycles, batch: 6, generations: 4, seed: 3 }
";

/// Runs a command alone and with workers of which one is killed; both must do and print the same.
#[track_caller]
fn compare(bench: &Bench, command: &[&str], status: i32) -> Ran {
    let Some(server) = Server::start(&[]) else { return Ran { status, out: String::new(), err: String::new() } };
    let alone = bench.run(command);
    assert_eq!(alone.status, status, "{}{}", alone.out, alone.err);
    let mut wire = Wire::open(&server);
    let working = Running::start(bench, &[command, &["--nats", &server.url()]].concat());
    wire.wait_for(|message| message.subject.starts_with(&subject_of("task.")));
    let first = worker(bench, &server, "first");
    wire.wait_for(|message| message.subject == subject_of("worker"));
    first.kill();
    let second = worker(bench, &server, "second");
    let together = working.end();
    assert_eq!((together.status, &together.out), (status, &alone.out), "{}", together.err);
    // Progress counts those that are refused.
    assert!(!together.err.contains("refused worker"), "{}", together.err);
    second.kill();
    together
}

#[test]
fn robots_are_selected_measured_and_verified_by_workers() {
    let bench = Bench::new();
    bench.runs("walks.nb", WALKS);
    bench.ok("evolve walks.nb");
    let add = ["library", "add", "out/walks/seed-3", "--tries", "1", "--finalists", "1", "--max-error", "1", "--into"];
    let behaviors = ["--behavior", "LLLL"];
    let alone = bench.run(&[&add[..], &["alone"], &behaviors].concat());
    let Some(server) = Server::start(&[]) else { return };
    let _worker = worker(&bench, &server, "steady");
    let together = bench.run(&[&add[..], &["together"], &behaviors, &["--nats", &server.url()]].concat());
    let same = together.out.replace("together", "alone");
    assert_eq!((together.status, &*same), (alone.status, &*alone.out), "{}", together.err);
    let written = files(&bench.path().join("alone"));
    assert!(!written.is_empty(), "{}", alone.out);
    assert_eq!(files(&bench.path().join("together")), written);
    let path = bench.path().join("alone").join(written.keys().next().unwrap());
    let text = fs::read_to_string(&path).unwrap();
    let clock = text.lines().find(|line| line.trim_start().starts_with("clock:")).unwrap();
    fs::write(&path, text.replacen(clock, &clock.replace(char::is_numeric, "7"), 1)).unwrap();
    compare(&bench, &["library", "verify", "alone", "--format", "json"], 1);
}

#[test]
fn swarms_are_tested_by_workers() {
    let bench = Bench::with("latch.nb", LATCH);
    let ran = compare(&bench, &["test", "latch.nb", "--physics", "--format", "json"], 1);
    assert!(ran.out.is_empty() || ran.out.contains("\"lapses\""), "{}", ran.out);
}

#[test]
fn a_signal_stops_what_workers_do() {
    let bench = Bench::with("latch.nb", LATCH);
    // Without workers, nothing is ever done.
    for (command, out) in [
        (&["test", "latch.nb", "--physics"][..], "0 passed, 0 failed, 2 interrupted or not begun\n"),
        (&["library", "verify"], ""),
    ] {
        let Some(server) = Server::start(&[]) else { return };
        let mut wire = Wire::open(&server);
        let working = Running::start(&bench, &[command, &["--nats", &server.url()]].concat());
        wire.wait_for(|message| message.subject.starts_with(&subject_of("task.")));
        working.signal("TERM");
        let ran = working.end();
        assert_eq!((ran.status, &*ran.out), (4, out), "{}", ran.err);
    }
}

#[test]
fn a_server_that_is_not_there_is_named() {
    let bench = Bench::new();
    bench.file("latch.nb", LATCH);
    for command in ["test latch.nb --physics", "library verify"] {
        let arguments: Vec<&str> = command.split(' ').chain(["--nats", "nats://127.0.0.1:1"]).collect();
        bench.run(&arguments[..]).expect_fault(&["cannot use the NATS server `nats://127.0.0.1:1`"]);
    }
}
