//! Evolution on several machines, against a real NATS server on this machine.

mod access;
mod answers;
mod commands;
mod fake_workers;
mod kills;
mod listing;
mod many_workers;
mod outages;
mod recipes;
mod server;
mod wire;

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Condvar, Mutex, OnceLock};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crate::cluster::server::Server;
use crate::support::bench::{Bench, Ran};
use crate::support::limits::PATIENCE;
use crate::support::tools;

const SMALL: &str = "\
evolution small { box: 3 x 3, variable: short, fixed: 1 cycles, batch: 8, generations: 12, seed: 1..3 }
evolution gated { from: small, objective: gate, batch: 2, generations: 2, seed: 5 }
";
/// Env steps of an evaluation of `small`.
const SMALL_STEPS: u64 = 8 * 84;

/// A program in the background, which is killed when it is dropped.
struct Running {
    child: Child,
    /// What it has written to standard error, and a signal for each line.
    log: Arc<(Mutex<String>, Condvar)>,
    out: Receiver<String>,
    reader: Option<JoinHandle<()>>,
}

impl Running {
    fn start(bench: &Bench, arguments: &[&str]) -> Self {
        Self::spawn(&mut bench.command(arguments))
    }

    fn spawn(command: &mut Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let (mut stdout, stderr) = (child.stdout.take().unwrap(), child.stderr.take().unwrap());
        let (sender, out) = mpsc::channel();
        let log = Arc::new((Mutex::new(String::new()), Condvar::new()));
        let written = Arc::clone(&log);
        let reader = thread::spawn(move || {
            for line in BufReader::new(stderr).lines().map_while(Result::ok) {
                *written.0.lock().unwrap() += &(line + "\n");
                written.1.notify_all();
            }
        });
        thread::spawn(move || {
            let mut text = String::new();
            stdout.read_to_string(&mut text).unwrap();
            sender.send(text)
        });
        Self { child, log, out, reader: Some(reader) }
    }

    /// Waits until a line of standard error has the text.
    #[track_caller]
    fn wait_for(&self, text: &str) {
        let (log, changed) = &*self.log;
        let waiting = |log: &mut String| !log.contains(text);
        let (log, waited) = changed.wait_timeout_while(log.lock().unwrap(), PATIENCE, waiting).unwrap();
        assert!(!waited.timed_out(), "{text:?} is not in\n{log}");
    }

    fn signal(&self, name: &str) {
        tools::signal(name, self.child.id());
    }

    /// `kill -9`.
    fn kill(self) {
        drop(self);
    }

    /// Waits until it ends.
    #[track_caller]
    fn end(self) -> Ran {
        self.end_within(PATIENCE)
    }

    /// Waits for so long until it ends.
    #[track_caller]
    fn end_within(mut self, patience: Duration) -> Ran {
        let out = self.out.recv_timeout(patience);
        let log = || self.log.0.lock().unwrap().clone();
        let out = out.unwrap_or_else(|_| panic!("the program did not end\n{}", log()));
        let status = self.child.wait().unwrap().code().expect("a status");
        self.reader.take().unwrap().join().unwrap();
        Ran { status, out, err: log() }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn worker(bench: &Bench, server: &Server, name: &str) -> Running {
    Running::start(bench, &["worker", "--nats", &server.url(), "--threads", "1", "--name", name])
}

fn evolve(bench: &Bench, server: &Server, more: &[&str]) -> Running {
    let arguments = ["evolve", "small.nb", "--checkpoint-every", "0", "--nats", &server.url()];
    Running::start(bench, &[&arguments, more].concat())
}

/// A folder with the declarations.
fn bench() -> Bench {
    let bench = Bench::new();
    bench.runs("small.nb", SMALL);
    bench
}

/// The files below a folder of results, without the locks.
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
