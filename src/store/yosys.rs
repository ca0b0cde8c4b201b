//! Verilog through Yosys, which flattens it to gates, latches and flip-flops.
//!
//! Yosys runs a fixed script in a temporary folder, where the source has a fixed name, and so has a link to the folder
//! of `include` lines. No name chosen by a user becomes part of the script or of a shell command.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::diag::io_words;
use crate::source::{VerilogError, VerilogModules};

/// The names in the temporary folder.
const SOURCE: &str = "source.v";
const INCLUDED: &str = "included";
/// The modules as written, and with their registers.
const WRITTEN: &str = "written.il";
const PROCESSED: &str = "processed.il";
const FLAT: &str = "flat.blif";

/// What a script does to the modules of the source before they become gates, for the top module that Yosys finds.
const TOP: &str = "hierarchy -check -auto-top";
/// The same for all modules.
const ALL: &str = "write_rtlil written.il; hierarchy -check";

/// The registers of Yosys that change without their clock.
const ASYNCHRONOUS: &[&str] =
    &["$adff", "$adffe", "$adlatch", "$aldff", "$aldffe", "$dffsr", "$dffsre", "$dlatchsr", "$sr"];

/// The top module of a Verilog source, which was read from `path`, as BLIF.
///
/// # Errors
/// When Yosys is missing or rejects the source.
pub(super) fn flatten(path: &Path, source: &str) -> Result<String, VerilogError> {
    let folder = run(path, source, TOP)?;
    result(&folder, FLAT)
}

/// All modules of a Verilog source, which was read from `path`.
///
/// # Errors
/// As [`flatten`].
pub(super) fn modules(path: &Path, source: &str) -> Result<VerilogModules, VerilogError> {
    let folder = run(path, source, ALL)?;
    Ok(VerilogModules { blif: result(&folder, FLAT)?, tops: tops(&result(&folder, WRITTEN)?) })
}

/// The script, with the names above.
fn script(modules: &str) -> String {
    format!(
        "read_verilog -sv -Iincluded source.v; {modules}; proc; write_rtlil processed.il; \
         flatten; opt; memory; opt; techmap; \
         dfflegalize -cell $_DFF_P_ 01 -cell $_DFF_N_ 01 -cell $_DLATCH_P_ 01 -cell $_DLATCH_N_ 01; simplemap; \
         opt_clean; setattr -unset src; write_blif -attr flat.blif"
    )
}

/// The folder in which Yosys ran the script.
fn run(path: &Path, source: &str, modules: &str) -> Result<tempfile::TempDir, VerilogError> {
    let folder = prepare(path, source).map_err(|error| VerilogError::NoFolder(io_words(&error)))?;
    let output = Command::new("yosys").args(["-q", "-p", &script(modules)]).current_dir(folder.path()).output();
    let output = output.map_err(|_| VerilogError::NoYosys)?;
    if output.status.success() {
        return Ok(folder);
    }
    let processed = fs::read_to_string(folder.path().join(PROCESSED)).unwrap_or_default();
    Err(asynchronous(&processed).unwrap_or_else(|| rejected(path, &String::from_utf8_lossy(&output.stderr))))
}

fn result(folder: &tempfile::TempDir, name: &str) -> Result<String, VerilogError> {
    fs::read_to_string(folder.path().join(name)).map_err(|_| VerilogError::NoResult)
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

/// The modules that no other module contains, in a text of Yosys (RTLIL). A module without outputs, such as a test
/// bench, does not count.
fn tops(rtlil: &str) -> Vec<String> {
    let mut tops: Vec<&str> = Vec::new();
    let mut inside: BTreeSet<&str> = BTreeSet::new();
    for module in rtlil.split("\nmodule \\").skip(1) {
        let lines = || module.lines().map(str::trim_start);
        if lines().any(|line| line.starts_with("wire ") && line.contains(" output ")) {
            tops.extend(module.lines().next());
            inside.extend(lines().filter_map(|line| line.strip_prefix("cell \\")?.split(' ').next()));
        }
    }
    tops.into_iter().filter(|module| !inside.contains(module)).map(str::to_owned).collect()
}

/// The first register with an asynchronous set or reset in a text of Yosys (RTLIL).
fn asynchronous(rtlil: &str) -> Option<VerilogError> {
    let mut place = "";
    for line in rtlil.lines().map(str::trim_start) {
        if let Some(source) = line.strip_prefix("attribute \\src \"") {
            place = source;
        }
        let cell = line.strip_prefix("cell ").and_then(|cell| cell.split(' ').next());
        if cell.is_some_and(|cell| ASYNCHRONOUS.contains(&cell)) {
            let number = place.strip_prefix(SOURCE).and_then(|place| place.strip_prefix(':')?.split('.').next());
            return Some(VerilogError::Asynchronous { line: number.and_then(|number| number.parse().ok()) });
        }
    }
    None
}

/// The error message of Yosys, with the line of the user's file.
fn rejected(path: &Path, said: &str) -> VerilogError {
    let said = said.lines().find(|line| line.contains("ERROR")).unwrap_or("no reason given").trim();
    match place(said) {
        Some((line, reason)) => VerilogError::Rejected { reason: reason.to_owned(), line: Some(line) },
        None => {
            let parent = path.parent().unwrap_or(Path::new("")).join("").display().to_string();
            let reason = said.trim_start_matches("ERROR: ").replace(&format!("{INCLUDED}/"), &parent);
            VerilogError::Rejected { reason, line: None }
        }
    }
}

/// The line of the source and the reason of a message such as `source.v:3: ERROR: syntax error`.
fn place(said: &str) -> Option<(usize, &str)> {
    let (number, reason) = said.strip_prefix(SOURCE)?.strip_prefix(':')?.split_once(": ")?;
    Some((number.parse().ok()?, reason.trim_start_matches("ERROR: ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scripts_have_the_names_of_the_folder_and_no_others() {
        for name in [SOURCE, INCLUDED, PROCESSED, FLAT] {
            assert!([TOP, ALL].iter().all(|modules| script(modules).contains(name)));
        }
        assert!(script(ALL).contains(WRITTEN));
    }

    #[test]
    fn errors_of_yosys_have_the_line_of_the_users_file() {
        let said = "\nsource.v:2: ERROR: syntax error, unexpected TOK_ENDMODULE\n";
        let reason = "syntax error, unexpected TOK_ENDMODULE".to_owned();
        assert_eq!(rejected(Path::new("my file.v"), said), VerilogError::Rejected { reason, line: Some(2) });
    }

    #[test]
    fn errors_of_yosys_in_an_included_file_have_its_path() {
        let said = "included/part.vh:7: ERROR: syntax error";
        let reason = "folder/part.vh:7: ERROR: syntax error".to_owned();
        assert_eq!(rejected(Path::new("folder/a.v"), said), VerilogError::Rejected { reason, line: None });
    }

    #[test]
    fn modules_inside_others_are_not_offered() {
        let module = |name: &str, wire: &str, cell: &str| {
            format!("module \\{name}\n  wire {wire} \\q\n  cell {cell}\n  end\nend\n")
        };
        let modules = [
            module("add", "output 1", "$and $1"),
            module("alu", "width 4 output 3", "\\add \\u"),
            module("bench", "width 4", "\\b \\u"),
            module("b", "output 1", "$or $2"),
        ];
        assert_eq!(tops(&format!("autoidx 3\n{}", modules.concat())), ["alu", "b"]);
    }

    #[test]
    fn an_asynchronous_reset_is_found_with_its_line() {
        let cell = "  attribute \\src \"source.v:11.1-12.35\"\n  cell $adff $procdff$15\n";
        assert_eq!(asynchronous(cell), Some(VerilogError::Asynchronous { line: Some(11) }));
        assert_eq!(asynchronous(&cell.replace("$adff", "$dff")), None);
        assert_eq!(
            asynchronous(&cell.replace("source.v", "included/x.vh")),
            Some(VerilogError::Asynchronous { line: None })
        );
    }
}
