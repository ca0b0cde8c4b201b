//! Programs in the background.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Condvar, Mutex};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crate::support::*;

/// A program in the background, which is killed when it is dropped.
pub struct Running {
    pub child: Child,
    /// What it has written to standard error, and a signal for each line.
    log: Arc<(Mutex<String>, Condvar)>,
    out: Receiver<String>,
    reader: Option<JoinHandle<()>>,
}

impl Running {
    pub fn start(bench: &Bench, arguments: &[&str]) -> Self {
        Self::spawn(&mut bench.command(arguments))
    }

    pub fn spawn(command: &mut Command) -> Self {
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

    #[track_caller]
    pub fn wait_for(&self, text: &str) {
        let (log, changed) = &*self.log;
        let waiting = |log: &mut String| !log.contains(text);
        let (log, waited) = changed.wait_timeout_while(log.lock().unwrap(), PATIENCE, waiting).unwrap();
        assert!(!waited.timed_out(), "{text:?} is not in\n{log}");
    }

    pub fn signal(&self, name: &str) {
        tools::signal(name, self.child.id());
    }

    /// `kill -9`.
    pub fn kill(self) {
        drop(self);
    }

    #[track_caller]
    pub fn end(self) -> Ran {
        self.end_within(PATIENCE)
    }

    #[track_caller]
    pub fn end_within(mut self, patience: Duration) -> Ran {
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
