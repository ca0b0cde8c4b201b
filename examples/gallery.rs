//! Makes every picture of README.md and docs/ again, by the commands that docs/pictures.md shows, or those of another
//! page by its commands:
//!
//!     cargo run --release --example gallery
//!     cargo run --release --example gallery docs/paper.md

use std::path::Path;
use std::process::{Command, ExitCode};

fn main() -> ExitCode {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    std::env::set_current_dir(root).expect("the package is a folder");
    let page = std::env::args().nth(1);
    if page.is_none() {
        // The runs are deleted, because their pictures must come from this version.
        let _ = std::fs::remove_dir_all("out/gallery");
    }
    let page = std::fs::read_to_string(page.as_deref().unwrap_or("docs/pictures.md")).expect("the page is a text");
    for line in page.lines().filter_map(|line| line.strip_prefix("    nbc ")) {
        eprintln!("nbc {line}");
        let ended = Command::new(env!("CARGO")).args(["run", "--release", "--quiet", "--"]).args(words(line)).status();
        if !ended.is_ok_and(|status| status.success()) {
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// The words of a command; a quoted text is one word.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('\'').enumerate();
    parts.flat_map(|(i, part)| if i % 2 == 1 { vec![part] } else { part.split_whitespace().collect() }).collect()
}
