//! Evolution on several machines, against a real NATS server on this machine.

mod access;
mod answers;
mod commands;
mod keys;
mod kills;
mod listing;
mod many_workers;
mod outages;
mod recipes;
mod running;
mod server;
mod wire;

use std::collections::BTreeMap;
use std::sync::OnceLock;

use crate::cluster::running::Running;
use crate::cluster::server::Server;
use crate::support::*;

const SMALL: &str = "\
evolution small { box: 3 x 3, variable: short, fixed: 1 cycles, batch: 8, generations: 6, seed: 1..3 }
evolution gated { from: small, objective: gate, batch: 2, generations: 2, seed: 5 }
";
/// Env steps of an evaluation of `small`.
const SMALL_STEPS: u64 = 8 * 84;

fn worker(bench: &Bench, server: &Server, name: &str) -> Running {
    Running::start(bench, &["worker", "--nats", &server.url(), "--threads", "1", "--name", name])
}

fn evolve(bench: &Bench, server: &Server, more: &[&str]) -> Running {
    let arguments = ["evolve", "small.nb", "--checkpoint-every", "0", "--nats", &server.url()];
    Running::start(bench, &[&arguments, more].concat())
}

fn bench() -> Bench {
    let bench = Bench::new();
    bench.runs("small.nb", SMALL);
    bench
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if entry.path().is_dir() {
            found.extend(files(&entry.path()).into_iter().map(|(below, bytes)| (format!("{name}/{below}"), bytes)));
        } else if name != "lock" {
            found.insert(name, fs::read(entry.path()).unwrap());
        }
    }
    found
}

/// The results of the declarations on one thread of this machine.
fn alone() -> &'static BTreeMap<String, Vec<u8>> {
    static FILES: OnceLock<BTreeMap<String, Vec<u8>>> = OnceLock::new();
    FILES.get_or_init(|| {
        let bench = bench();
        let ran = Running::start(&bench, &["evolve", "small.nb"]).end();
        assert_eq!(ran.status, 0, "{}", ran.err);
        let found = files(&bench.path().join("out"));
        assert_eq!(found.len(), 8, "a checkpoint and a history for each of four runs: {:?}", found.keys());
        found
    })
}

/// Checks that files are those of a run alone, byte for byte.
#[track_caller]
fn assert_equal(found: &BTreeMap<String, Vec<u8>>, expected: &BTreeMap<String, Vec<u8>>) {
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (name, bytes) in expected {
        assert!(found[name] == *bytes, "`{name}` differs from that of one thread");
    }
}

#[track_caller]
fn assert_same(bench: &Bench, ran: &Ran) {
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert_equal(&files(&bench.path().join("out")), alone());
}
