//! ABC, which other programs are compared with.

use std::path::Path;
use std::process::Command;

use crate::limits::InTime;
use crate::tools::ABC;

/// The output of a script of ABC in a folder; `None` without ABC, whose proof is then skipped.
pub fn abc(folder: &Path, script: &str) -> Option<String> {
    let output = Command::new(ABC.find()?).args(["-c", script]).current_dir(folder).output_in_time();
    Some(String::from_utf8_lossy(&output.stdout).into_owned())
}
