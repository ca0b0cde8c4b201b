//! The script that Yosys runs. It translates Verilog to gates, latches and flip-flops.
//!
//! The script is fixed, and so are the names of its files. No name chosen by a user becomes part of the script or of a
//! shell command.

use std::collections::BTreeSet;
use std::fs;

use crate::store::disk;
use crate::store::verilog::listing::VerilogListing;
use crate::store::verilog::process::{self, Limits};
use nbc_base::diag::io_words;
use nbc_base::source::{FileError, SourceWorld, VerilogError, VerilogModules};
use nbc_circuit::CancelFlag;

/// The names in the temporary folder.
const SOURCE: &str = "source.v";
/// The modules as written, and with their registers.
const WRITTEN: &str = "written.il";
const PROCESSED: &str = "processed.il";
const FLAT: &str = "flat.blif";

/// The commands before the modules become gates, for the top module that Yosys finds.
const TOP: &str = "hierarchy -check -auto-top";
/// The same for all modules.
const ALL: &str = "write_rtlil written.il; hierarchy -check";

/// The registers of Yosys that change without their clock.
const ASYNCHRONOUS: &[&str] =
    &["$adff", "$adffe", "$adlatch", "$aldff", "$aldffe", "$dffsr", "$dffsre", "$dlatchsr", "$sr"];

/// A world whose Verilog may include files.
pub trait VerilogFiles: SourceWorld {
    /// The text of a file that the Verilog file at `main` includes.
    fn included(&self, main: &str, path: &str) -> Result<String, FileError>;
}

/// A Verilog file to be translated.
pub(in crate::store) struct Verilog<'a, W> {
    pub(in crate::store) world: &'a W,
    pub(in crate::store) path: &'a str,
    pub(in crate::store) text: &'a str,
    /// Ends the translation.
    pub(in crate::store) cancel: &'a CancelFlag,
}

impl<W: VerilogFiles> Verilog<'_, W> {
    /// The top module as BLIF.
    ///
    /// # Errors
    /// When Yosys is missing, or the text is refused.
    pub(in crate::store) fn flatten(&self) -> Result<String, VerilogError> {
        result(&self.run(TOP)?, FLAT)
    }

    /// All modules.
    ///
    /// # Errors
    /// As [`Verilog::flatten`].
    pub(in crate::store) fn modules(&self) -> Result<VerilogModules, VerilogError> {
        let folder = self.run(ALL)?;
        Ok(VerilogModules { blif: result(&folder, FLAT)?, tops: tops(&result(&folder, WRITTEN)?) })
    }

    /// The folder in which Yosys ran the script.
    fn run(&self, modules: &str) -> Result<tempfile::TempDir, VerilogError> {
        let listing = VerilogListing::of(self.path, self.text, &|path| self.world.included(self.path, path))?;
        let folder = process::folder()?;
        let written = fs::write(folder.path().join(SOURCE), &listing.text);
        written.map_err(|error| VerilogError::NoFolder(io_words(&error)))?;
        match process::run(folder.path(), &script(modules), Limits::default(), self.cancel)? {
            Ok(()) => Ok(folder),
            Err(said) => {
                let processed = result(&folder, PROCESSED).unwrap_or_default();
                Err(asynchronous(&processed, &listing).unwrap_or_else(|| rejected(&said, &listing)))
            }
        }
    }
}

/// The script, with the names above.
fn script(modules: &str) -> String {
    format!(
        "read_verilog -sv source.v; {modules}; proc; write_rtlil processed.il; \
         flatten; opt; memory; opt; techmap; \
         dfflegalize -cell $_DFF_P_ 01 -cell $_DFF_N_ 01 -cell $_DLATCH_P_ 01 -cell $_DLATCH_N_ 01; simplemap; \
         opt_clean; setattr -unset src; write_blif -attr flat.blif"
    )
}

fn result(folder: &tempfile::TempDir, name: &str) -> Result<String, VerilogError> {
    disk::read_text(&folder.path().join(name), disk::MAX_CIRCUIT_BYTES).map_err(|_| VerilogError::NoResult)
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
fn asynchronous(rtlil: &str, listing: &VerilogListing) -> Option<VerilogError> {
    let mut source = "";
    for line in rtlil.lines().map(str::trim_start) {
        if let Some(place) = line.strip_prefix("attribute \\src \"") {
            source = place;
        }
        let cell = line.strip_prefix("cell ").and_then(|cell| cell.split(' ').next());
        if cell.is_some_and(|cell| ASYNCHRONOUS.contains(&cell)) {
            let number = source.strip_prefix(SOURCE).and_then(|place| place.strip_prefix(':')?.split('.').next());
            let line = number.and_then(|number| number.parse().ok());
            return Some(VerilogError::Asynchronous { place: line.and_then(|line| listing.place(line)) });
        }
    }
    None
}

/// The error message of Yosys, with its place in the user's file.
fn rejected(said: &str, listing: &VerilogListing) -> VerilogError {
    let said = said.lines().find(|line| line.contains("ERROR")).unwrap_or("no reason given").trim();
    match place(said) {
        Some((line, reason)) => VerilogError::Rejected { reason: reason.to_owned(), place: listing.place(line) },
        None => VerilogError::Rejected { reason: said.trim_start_matches("ERROR: ").to_owned(), place: None },
    }
}

/// The line of the source and the reason of a message such as `source.v:3: ERROR: syntax error`.
fn place(said: &str) -> Option<(usize, &str)> {
    let (number, reason) = said.strip_prefix(SOURCE)?.strip_prefix(':')?.split_once(": ")?;
    let line = number.split(['.', '-']).next()?;
    Some((line.parse().ok()?, reason.trim_start_matches("ERROR: ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::VerilogPlace;

    fn listing(text: &str) -> VerilogListing {
        VerilogListing::of("my file.v", text, &|_| Err(FileError::NotFound)).unwrap()
    }

    #[test]
    fn the_scripts_have_the_names_of_the_folder_and_no_others() {
        for name in [SOURCE, PROCESSED, FLAT] {
            assert!([TOP, ALL].iter().all(|modules| script(modules).contains(name)));
        }
        assert!(script(ALL).contains(WRITTEN));
    }

    #[test]
    fn errors_of_yosys_have_the_line_of_the_users_file() {
        let said = "\nsource.v:2: ERROR: syntax error, unexpected TOK_ENDMODULE\n";
        let reason = "syntax error, unexpected TOK_ENDMODULE".to_owned();
        let place = Some(VerilogPlace { file: "my file.v".to_owned(), line: 4 });
        assert_eq!(rejected(said, &listing("a\n\n\nb\n")), VerilogError::Rejected { reason, place });
    }

    #[test]
    fn the_folder_is_for_this_user_only() {
        let folder = process::folder().unwrap();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            assert_eq!(folder.path().metadata().unwrap().permissions().mode() & 0o777, 0o700);
        }
        let path = folder.path().to_owned();
        drop(folder);
        assert!(!path.exists());
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
        let cell = "  attribute \\src \"source.v:2.1-12.35\"\n  cell $adff $procdff$15\n";
        let listing = listing("a\n\n\nb\n");
        let place = Some(VerilogPlace { file: "my file.v".to_owned(), line: 4 });
        assert_eq!(asynchronous(cell, &listing), Some(VerilogError::Asynchronous { place }));
        assert_eq!(asynchronous(&cell.replace("$adff", "$dff"), &listing), None);
    }
}
