//! Makes every picture of README.md and docs/ again, by the commands that docs/pictures.md shows:
//!
//!     cargo run --release --example gallery

use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    std::env::set_current_dir(root).expect("the package is a folder");
    let manual = std::fs::read_to_string("docs/pictures.md").expect("docs/pictures.md is a text");
    // The runs are deleted, because their pictures must come from this version.
    let _ = std::fs::remove_dir_all("out/gallery");
    for line in manual.lines().filter_map(|line| line.strip_prefix("    nbc ")) {
        eprintln!("nbc {line}");
        let ended = nbc::cli::run(words(&format!("nbc {line}")));
        if ended != ExitCode::SUCCESS {
            return ended;
        }
    }
    ExitCode::SUCCESS
}

/// The words of a command; a quoted text is one word.
fn words(line: &str) -> Vec<OsString> {
    let parts = line.split('\'').enumerate();
    parts
        .flat_map(|(i, part)| if i % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
        .map(OsString::from)
        .collect()
}
