//! Proofs by ABC.

use std::process::Command;

use crate::support::*;

pub fn abc_agrees(bench: &Bench, command: &str, one: &str, two: &str) {
    let Some(said) = abc(bench.path(), &format!("{command} {one} {two}")) else { return };
    assert!(said.contains("Networks are equivalent"), "{said}");
}

/// The output of a script of ABC in a folder; `None` without ABC, whose proof is then skipped.
pub fn abc(folder: &Path, script: &str) -> Option<String> {
    let output = Command::new(ABC.find()?).args(["-c", script]).current_dir(folder).output_in_time();
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}
