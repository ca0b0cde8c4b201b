//! Models of other tools, each with one property, decided by `nbc prove` and by ABC's `pdr` and `bmc3`, in CPU time:
//! `cargo bench --bench properties -- FOLDER [SECONDS]`. FOLDER has files in AIGER's format; docs/always.md says which
//! were measured. Each program has SECONDS (60) for a model; `bmc3` is tried only where `pdr` decides nothing.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use aims::Aims;

mod aims;

/// What a program says of a model.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Decided {
    Proved,
    /// The number of steps of the run.
    Refuted(usize),
    Open,
}

impl std::fmt::Display for Decided {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Proved => f.pad("proved"),
            Self::Refuted(steps) => f.pad(&format!("refuted ({steps})")),
            Self::Open => f.pad("-"),
        }
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let Some(folder) = arguments.first() else {
        println!("skipped: name a folder of models, `cargo bench --bench properties -- FOLDER [SECONDS]`");
        return ExitCode::SUCCESS;
    };
    let seconds = arguments.get(1).map_or(60, |text| text.parse().expect("a number of seconds"));
    let mut models: Vec<PathBuf> = fs::read_dir(folder).expect("a folder").map(|entry| entry.unwrap().path()).collect();
    models.retain(|path| path.extension().is_some_and(|ending| ending == "aig" || ending == "aag"));
    models.sort();
    println!("{:<24} {:>6} {:>6}  {:<16} {:>8}  {:<16} {:>8}", "model", "gates", "bits", "nbc", "s", "ABC", "s");
    let (mut nbc, mut abc, mut wrong, mut more) = (0, 0, 0, 0);
    for model in &models {
        let name = model.file_stem().unwrap_or_default().to_string_lossy();
        let [gates, bits] = sizes(model);
        let own = by_nbc(model, seconds);
        let other = match by_abc(model, "pdr", seconds) {
            (Decided::Open, spent) => {
                let (found, more) = by_abc(model, "bmc3", seconds);
                (found, spent + more)
            }
            found => found,
        };
        println!("{name:<24} {gates:>6} {bits:>6}  {:<16} {:>8.2}  {:<16} {:>8.2}", own.0, own.1, other.0, other.1);
        nbc += usize::from(own.0 != Decided::Open);
        abc += usize::from(other.0 != Decided::Open);
        let kind = |decided: Decided| std::mem::discriminant(&decided);
        wrong += usize::from(own.0 != Decided::Open && other.0 != Decided::Open && kind(own.0) != kind(other.0));
        more += usize::from(own.0 != Decided::Open && other.0 == Decided::Open);
    }
    println!("{nbc} of {} decided by nbc, {abc} by ABC, {more} by nbc alone", models.len());
    let mut aims = Aims::default();
    aims.check(wrong == 0, format!("{wrong} models are decided differently"));
    aims.check(nbc >= abc, "nbc decides as many models as ABC");
    aims.end()
}

/// The gates of a model, and the bits of its state.
fn sizes(model: &Path) -> [usize; 2] {
    let bytes = fs::read(model).unwrap();
    let head = bytes.split(|&byte| byte == b'\n').next().unwrap_or_default();
    let numbers: Vec<usize> =
        String::from_utf8_lossy(head).split(' ').skip(1).map(|word| word.parse().unwrap_or(0)).collect();
    [numbers[4], numbers[2]]
}

fn by_nbc(model: &Path, seconds: u32) -> (Decided, f64) {
    let path = model.to_string_lossy();
    // The time of the processor ends it, and not that of a clock.
    let (said, spent) = run(&[env!("CARGO_BIN_EXE_nbc"), "prove", &path, "--seconds", "1000000"], seconds);
    let line = said.lines().nth(1).unwrap_or_default().trim();
    let decided = match line.split_whitespace().next() {
        Some("proved") => Decided::Proved,
        Some("refuted") => Decided::Refuted(number_after(line, "(after ")),
        _ => Decided::Open,
    };
    (decided, spent)
}

fn by_abc(model: &Path, command: &str, seconds: u32) -> (Decided, f64) {
    let script = format!("read {}; {command}", model.display());
    let (said, spent) = run(&["berkeley-abc", "-q", &script], seconds);
    let decided = if said.contains("asserted in frame") {
        Decided::Refuted(number_after(&said, "asserted in frame ") + 1)
    } else if said.contains("Property proved") {
        Decided::Proved
    } else {
        Decided::Open
    };
    (decided, spent)
}

/// The number that follows these words.
fn number_after(text: &str, words: &str) -> usize {
    let rest = text.split_once(words).map_or("", |(_, rest)| rest);
    rest.split(|letter: char| !letter.is_ascii_digit()).next().and_then(|word| word.parse().ok()).unwrap_or(0)
}

/// What a program prints in so much time of the processor, and the time that it took.
fn run(command: &[&str], seconds: u32) -> (String, f64) {
    let script = format!("ulimit -t {seconds}; \"$0\" \"$@\" 2>/dev/null; times");
    let output = Command::new("bash").args(["-c", &script]).args(command).output().expect("a shell runs");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let seconds = |minutes: &str| {
        let (minutes, seconds) = minutes.trim_end_matches('s').split_once('m')?;
        Some(minutes.parse::<f64>().ok()? * 60.0 + seconds.parse::<f64>().ok()?)
    };
    // The last line is about the shell's children: seconds in the program and in the system.
    let spent = said.lines().last().unwrap_or_default().split(' ').filter_map(seconds).sum();
    (said, spent)
}
