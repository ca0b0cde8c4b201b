//! Verilog through Yosys, which flattens it to gates, latches and flip-flops.
//!
//! Yosys runs a fixed script in a temporary folder, where the source has a fixed name, and so has a link to the folder
//! of `include` lines. No name chosen by a user becomes part of the script or of a shell command.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::diag::{Diagnostic, Diagnostics};
use crate::source::{Sources, Span};
use crate::store::wording::StoreError;

/// The names in the temporary folder.
const SOURCE: &str = "source.v";
const INCLUDED: &str = "included";
const FLAT: &str = "flat.blif";

/// The script, with the names above.
const SCRIPT: &str = "read_verilog -sv -Iincluded source.v; hierarchy -check -auto-top; proc; flatten; opt; memory; \
    opt; techmap; \
                      dfflegalize -cell $_DFF_P_ 01 -cell $_DFF_N_ 01 -cell $_DLATCH_P_ 01 -cell $_DLATCH_N_ 01; \
                      simplemap; \
                      opt_clean; write_blif flat.blif";

/// The BLIF of a Verilog source that was read from `path`.
///
/// # Errors
/// When Yosys is missing or rejects the source.
pub(super) fn flatten(path: &Path, source: String) -> Result<String, Diagnostics> {
    let folder = prepare(path, &source).map_err(|error| Diagnostic::from(StoreError::TemporaryFolder(error)))?;
    let output = Command::new("yosys").args(["-q", "-p", SCRIPT]).current_dir(folder.path()).output();
    let output = output.map_err(|_| Diagnostic::from(StoreError::YosysMissing))?;
    if !output.status.success() {
        return Err(fault(path, source, &String::from_utf8_lossy(&output.stderr)));
    }
    fs::read_to_string(folder.path().join(FLAT))
        .map_err(|_| Diagnostic::from(StoreError::YosysSilent { file: path.display().to_string() }).into())
}

/// A folder with the source and a link to its includes.
fn prepare(path: &Path, source: &str) -> std::io::Result<tempfile::TempDir> {
    let folder = tempfile::tempdir()?;
    fs::write(folder.path().join(SOURCE), source)?;
    let parent = path.parent().filter(|parent| *parent != Path::new("")).unwrap_or(Path::new("."));
    link(&fs::canonicalize(parent)?, &folder.path().join(INCLUDED))?;
    Ok(folder)
}

#[cfg(unix)]
fn link(folder: &Path, at: &Path) -> std::io::Result<()> {
    std::os::unix::fs::symlink(folder, at)
}

#[cfg(windows)]
fn link(folder: &Path, at: &Path) -> std::io::Result<()> {
    std::os::windows::fs::symlink_dir(folder, at)
}

/// The error message of Yosys, at the line of the user's file.
fn fault(path: &Path, source: String, said: &str) -> Diagnostics {
    let line = said.lines().find(|line| line.contains("ERROR")).unwrap_or("no reason given").trim();
    let name = path.display().to_string();
    let mut sources = Sources::default();
    let file = sources.add(name.as_str(), source);
    let (reason, place) = match place(line) {
        Some((number, reason)) => {
            let text = &sources.file(file).text;
            let start = text.split_inclusive('\n').take(number.saturating_sub(1)).map(str::len).sum::<usize>();
            let width = text[start..].lines().next().map_or(0, |line| line.trim_end().len());
            (reason.to_owned(), Some(Span::new(file, start, start + width)))
        }
        None => {
            let parent = path.parent().unwrap_or(Path::new("")).join("").display().to_string();
            (line.replace(&format!("{INCLUDED}/"), &parent), None)
        }
    };
    let diagnostic = StoreError::Yosys { file: name, reason, place }.into();
    Diagnostics { list: vec![diagnostic], sources }
}

/// The line of the source and the reason of a message such as `source.v:3: ERROR: syntax error`.
fn place(line: &str) -> Option<(usize, &str)> {
    let (number, reason) = line.strip_prefix(SOURCE)?.strip_prefix(':')?.split_once(": ")?;
    Some((number.parse().ok()?, reason.trim_start_matches("ERROR: ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_script_has_the_names_of_the_folder_and_no_others() {
        for name in [SOURCE, INCLUDED, FLAT] {
            assert!(SCRIPT.contains(name));
        }
    }

    #[test]
    fn errors_of_yosys_are_shown_at_the_line_of_the_users_file() {
        let source = "module a;\nwrong\nendmodule\n".to_owned();
        let Diagnostics { list: diagnostics, sources } =
            fault(Path::new("my file.v"), source, "\nsource.v:2: ERROR: syntax error, unexpected TOK_ENDMODULE\n");
        let label = &diagnostics[0].labels[0];
        assert_eq!(sources.text(label.span), "wrong");
        assert_eq!(label.text, "syntax error, unexpected TOK_ENDMODULE");
        assert_eq!(diagnostics[0].message, "yosys cannot read `my file.v`");
    }

    #[test]
    fn errors_of_yosys_in_an_included_file_show_its_path() {
        let said = "included/part.vh:7: ERROR: syntax error";
        let Diagnostics { list: diagnostics, .. } = fault(Path::new("folder/a.v"), String::new(), said);
        assert_eq!(diagnostics[0].message, "yosys cannot read `folder/a.v`: folder/part.vh:7: ERROR: syntax error");
    }
}
