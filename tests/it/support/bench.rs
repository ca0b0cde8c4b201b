//! Runs of the program, each in a folder of its own.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

use crate::support::limits::InTime;

/// A schedule with every pattern for one cycle.
pub const SHORT: &str = "\
schedule short(s1, s2) {
    0 0 for 1 cycles
    0 1 for 1 cycles
    1 0 for 1 cycles
    1 1 for 1 cycles
}

";

/// The program, or that of another machine with what runs it: the words of `NBC_FOREIGN`, such as `wine64 nbc.exe`. It
/// has one thread, because tests run side by side.
pub fn program() -> Command {
    let foreign = std::env::var("NBC_FOREIGN");
    let mut words = foreign.as_deref().unwrap_or(env!("CARGO_BIN_EXE_nbc")).split(' ');
    let mut command = Command::new(words.next().expect("a text has a first word"));
    command.args(words).env("RAYON_NUM_THREADS", "1");
    command
}

/// A folder of its own for one test, with the program run inside it.
pub struct Bench {
    folder: tempfile::TempDir,
}

/// The output and exit status of a run of the program.
pub struct Ran {
    pub status: i32,
    pub out: String,
    pub err: String,
}

impl Bench {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Writes a program into the folder, with the schedule `short` in front: every pattern for one cycle.
    pub fn runs(&self, name: &str, text: impl std::fmt::Display) -> PathBuf {
        self.file(name, format!("{SHORT}{text}"))
    }

    /// Writes a file into the folder.
    pub fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    pub fn run(&self, arguments: &[&str]) -> Ran {
        let Output { status, stdout, stderr } = self.command(arguments).output_in_time();
        let text = |bytes| String::from_utf8(bytes).expect("the program prints text");
        Ran { status: status.code().expect("the program ends by itself"), out: text(stdout), err: text(stderr) }
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = program();
        command.args(arguments).current_dir(self.path()).env_remove("NO_COLOR");
        command
    }
}

impl Ran {
    /// Checks for an error on standard error only, with status 2 and without a panic.
    #[track_caller]
    pub fn expect_fault(&self, parts: &[&str]) {
        assert_eq!(self.status, 2, "{}{}", self.out, self.err);
        for part in parts {
            assert!(self.err.contains(part), "{part:?} is not in\n{}", self.err);
        }
        assert!(!self.err.contains("panicked") && !self.err.contains('\u{1b}'), "{}", self.err);
        assert_eq!(self.out, "");
    }

    #[track_caller]
    pub fn expect_json(&self) -> Value {
        assert_eq!(self.status, 0, "{}", self.err);
        serde_json::from_str(&self.out).expect("standard output is JSON")
    }
}
