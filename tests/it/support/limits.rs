//! Limits of time: a test that waits for a program ends, whatever the program does.

use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

use nbc_base::diag::Code;

use crate::support::*;

/// The most time that a program may take. A busy machine needs a small part of it.
pub const PATIENCE: Duration = Duration::from_secs(300);

/// Ends a program that takes too long. What a test reads from the program ends then, too.
pub struct Limit {
    /// The thread that waits ends when this is dropped.
    _running: Sender<()>,
}

impl Limit {
    pub fn of(program: &Child) -> Self {
        Self::within(program, PATIENCE)
    }

    fn within(program: &Child, patience: Duration) -> Self {
        let (running, ended) = mpsc::channel();
        let process = program.id();
        let test = thread::current().name().unwrap_or("a test").to_owned();
        thread::spawn(move || {
            if ended.recv_timeout(patience) == Err(RecvTimeoutError::Timeout) {
                eprintln!("{test}: a program is killed after {} s", patience.as_secs());
                signal("KILL", process);
            }
        });
        Self { _running: running }
    }
}

pub fn end(program: Child) -> Output {
    end_within(program, PATIENCE)
}

fn end_within(program: Child, patience: Duration) -> Output {
    let _limit = Limit::within(&program, patience);
    program.wait_with_output().unwrap()
}

pub trait InTime {
    fn output_within(&mut self, patience: Duration) -> Output;

    fn output_in_time(&mut self) -> Output {
        self.output_within(PATIENCE)
    }

    fn ran(&mut self) -> Ran {
        self.output_in_time().into()
    }
}

impl InTime for Command {
    fn output_within(&mut self, patience: Duration) -> Output {
        let program = self.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
        end_within(program.unwrap(), patience)
    }
}

/// The most that a refusal of hostile input may take: a build for tests is several times slower than one for users.
pub const BOUNDS: &str = "ulimit -t 5; ulimit -v 1048576";

/// The program rejects its second argument with this code, within these bounds.
#[track_caller]
pub fn refused_by(bench: &Bench, arguments: &[&str], code: Code) {
    let (file, ran) = (arguments[1], bench.limited(BOUNDS, arguments));
    assert_eq!(ran.status, 2, "{file}: {:.500}", ran.err);
    assert!(
        ran.err.contains(code.word()) && !ran.err.contains("panicked"),
        "{file}: {code} is not in {:.500}",
        ran.err
    );
    assert!(ran.err.len() < 100_000, "{file}: {} bytes of messages", ran.err.len());
}

#[track_caller]
pub fn until(fault: &str, holds: impl Fn() -> bool) {
    let end = Instant::now() + PATIENCE;
    while !holds() {
        assert!(Instant::now() < end, "{fault}");
        thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn every_wait_for_a_program_has_a_limit() {
    let files = files();
    for (path, text) in files.iter().filter(|(path, _)| !path.ends_with("limits.rs")) {
        for word in [".output()", ".wait_with_output()"] {
            assert!(!text.contains(word), "{}: use those of limits.rs, not `{word}`", path.display());
        }
        let has_limit = ["Limit::", "end(", "PATIENCE", "recv_timeout"].iter().any(|word| text.contains(word));
        assert!(has_limit || !text.contains(".spawn()"), "{}: its programs have no limit", path.display());
    }
}
