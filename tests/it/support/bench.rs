//! Runs of the program, each in a folder of its own.

use std::io::Write;
use std::process::{Command, Output, Stdio};

use crate::support::*;

/// A schedule with every pattern for one cycle.
pub const SHORT: &str = "\
schedule short(s1, s2) {
    0 0 for 1 cycles
    0 1 for 1 cycles
    1 0 for 1 cycles
    1 1 for 1 cycles
}

";

/// A robot file of a sound body, and of one that becomes unstable.
pub const WALKER: &str = "body: [\"00345\", \"33333\"]\n";
pub const WILD: &str = "body: ['57070', '73873', '00304', '00001', '00861']\n";

/// The program, or that of another machine with what runs it: the words of `NBC_FOREIGN`, such as `wine64 nbc.exe`. It
/// has one thread, because tests run side by side.
pub fn program() -> Command {
    let foreign = std::env::var("NBC_FOREIGN");
    let mut words = foreign.as_deref().unwrap_or(env!("CARGO_BIN_EXE_nbc")).split(' ');
    let mut command = Command::new(words.next().expect("a text has a first word"));
    command.args(words).env("RAYON_NUM_THREADS", "1");
    command
}

/// The arguments of a program: a list, or a text of words, in which one with spaces is in single quotes.
pub trait Words {
    fn words(&self) -> Vec<String>;
}

impl Words for str {
    fn words(&self) -> Vec<String> {
        let parts = self.split('\'').enumerate();
        parts
            .flat_map(|(at, part)| if at % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
            .map(str::to_owned)
            .collect()
    }
}

impl Words for String {
    fn words(&self) -> Vec<String> {
        self.as_str().words()
    }
}

impl Words for [&str] {
    fn words(&self) -> Vec<String> {
        self.iter().map(|&word| word.to_owned()).collect()
    }
}

impl Words for Vec<&str> {
    fn words(&self) -> Vec<String> {
        self[..].words()
    }
}

impl<const N: usize> Words for [&str; N] {
    fn words(&self) -> Vec<String> {
        self[..].words()
    }
}

pub struct Bench {
    folder: tempfile::TempDir,
}

pub struct Ran {
    pub status: i32,
    pub out: String,
    pub err: String,
}

impl Bench {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub fn with(name: &str, bytes: impl AsRef<[u8]>) -> Self {
        let bench = Self::new();
        bench.file(name, bytes);
        bench
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn has(&self, name: impl AsRef<Path>) -> bool {
        self.path().join(name).exists()
    }

    #[track_caller]
    pub fn read(&self, name: impl AsRef<Path>) -> String {
        text_of(self.path().join(name))
    }

    #[track_caller]
    pub fn bytes(&self, name: impl AsRef<Path>) -> Vec<u8> {
        fs::read(self.path().join(name)).unwrap()
    }

    /// Writes a program into the folder, with the schedule `short` in front: every pattern for one cycle.
    pub fn runs(&self, name: &str, text: impl std::fmt::Display) -> PathBuf {
        self.file(name, format!("{SHORT}{text}"))
    }

    /// Writes a file into the folder, and the folders around it.
    pub fn file(&self, name: impl AsRef<Path>, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, bytes).unwrap();
        path
    }

    pub fn command(&self, words: &(impl Words + ?Sized)) -> Command {
        let mut command = program();
        command.args(words.words()).current_dir(self.path()).env_remove("NO_COLOR");
        command
    }

    pub fn run(&self, words: &(impl Words + ?Sized)) -> Ran {
        self.command(words).ran()
    }

    #[track_caller]
    pub fn ok(&self, words: &(impl Words + ?Sized)) -> Ran {
        let ran = self.run(words);
        assert_eq!(ran.status, 0, "{:?}: {}{}", words.words(), ran.out, ran.err);
        ran
    }

    pub fn with_input(&self, words: &(impl Words + ?Sized), text: &str) -> Ran {
        let mut command = self.command(words);
        let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
        end(child).into()
    }

    /// Runs the program within limits such as `ulimit -t 5`.
    pub fn limited(&self, limits: &str, words: &(impl Words + ?Sized)) -> Ran {
        let script = format!("{limits}; exec \"$0\" \"$@\"");
        let mut command = Command::new("sh");
        command.args(["-c", &script, env!("CARGO_BIN_EXE_nbc")]).args(words.words()).current_dir(self.path()).ran()
    }
}

impl From<Output> for Ran {
    /// A program that a signal ended has the status -1.
    fn from(Output { status, stdout, stderr }: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("the program prints text");
        Self { status: status.code().unwrap_or(-1), out: text(stdout), err: text(stderr) }
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
