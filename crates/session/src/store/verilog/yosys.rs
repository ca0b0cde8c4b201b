//! The script that Yosys runs. It translates Verilog to gates, latches and flip-flops.
//!
//! The script is fixed, and so are the names of its files. No name chosen by a user becomes part of the script or of a
//! shell command.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;

use crate::store::disk;
use crate::store::verilog::icarus;
use crate::store::verilog::listing::VerilogListing;
use crate::store::verilog::process::{self, Limits};
use crate::store::verilog::rtlil::{RtlilLines, tops, undriven};
use nbc_base::diag::io_words;
use nbc_base::source::{
    FileError, SourceWorld, VERILOG_SOURCE, VerilogError, VerilogModules, VerilogName, verilog_line,
};
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::blif::is_register_cell;

/// The names in the temporary folder, beside that of the source.
const POWER: &str = "power.v";
/// The modules as written, and flat.
const WRITTEN: &str = "written.il";
const FLAT: &str = "flat.il";
const UNDRIVEN: &str = "undriven.txt";
const BLIF: &str = "flat.blif";

/// The commands before the modules become gates, for the top module that Yosys finds.
const TOP: &str = "hierarchy -check -auto-top";
/// The same for all modules.
const ALL: &str = "hierarchy -check";

/// How Yosys makes powers of products.
const POWER_TEXT: &str = include_str!("power.v");

/// A world whose Verilog may include files.
pub trait VerilogFiles: SourceWorld {
    /// The text of a file that the Verilog file at `main` includes.
    fn included(&self, main: &str, path: &str) -> Result<String, FileError>;
}

/// The module to translate, and its parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TopModule {
    /// Its name, or the one that contains most.
    pub name: Option<String>,
    /// Values for parameters.
    pub parameters: BTreeMap<String, u32>,
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
    /// The top module.
    ///
    /// # Errors
    /// When Yosys is missing, or the text is refused.
    pub(in crate::store) fn top(&self, top: &TopModule) -> Result<VerilogModules, VerilogError> {
        let listing = self.listing(top.name.as_deref())?;
        let name = match (&top.name, &listing.tops[..]) {
            (None, _) if top.parameters.is_empty() => None,
            (None, [only]) => Some(only),
            (None, tops) => return Err(VerilogError::SeveralModules { known: tops.to_vec() }),
            (Some(name), _) => Some(name),
        };
        let mut command = match name {
            None => TOP.to_owned(),
            Some(name) if is_plain(name) => format!("hierarchy -check -top {name}"),
            Some(name) => return Err(VerilogError::NoModule { module: name.clone(), known: Vec::new() }),
        };
        for (parameter, value) in &top.parameters {
            if !is_plain(parameter) {
                return Err(VerilogError::NoParameter { parameter: parameter.clone(), known: listing.parameters });
            }
            let _ = write!(command, " -chparam {parameter} {value}");
        }
        let folder = self.run(&listing, &command)?;
        let blif = result(&folder, BLIF)?;
        // Yosys writes the top module first.
        let model = blif.lines().find_map(|line| line.strip_prefix(".model ")).ok_or(VerilogError::NoResult)?;
        let written = listing.text.clone();
        let modules = translated(&folder, vec![model.trim().to_owned()], blif, listing)?;
        icarus::simulated(folder.path(), &written, modules, &top.parameters, self.cancel)
    }

    /// All modules that no other module contains.
    ///
    /// # Errors
    /// As [`Verilog::top`].
    pub(in crate::store) fn modules(&self) -> Result<VerilogModules, VerilogError> {
        let listing = self.listing(None)?;
        let folder = self.run(&listing, ALL)?;
        let tops = tops(&result(&folder, WRITTEN)?);
        let written = listing.text.clone();
        let modules = translated(&folder, tops, result(&folder, BLIF)?, listing)?;
        icarus::simulated(folder.path(), &written, modules, &BTreeMap::new(), self.cancel)
    }

    fn listing(&self, top: Option<&str>) -> Result<VerilogListing, VerilogError> {
        VerilogListing::of(self.path, self.text, top, &|path| self.world.included(self.path, path))
    }

    /// The folder in which Yosys ran the script.
    fn run(&self, listing: &VerilogListing, modules: &str) -> Result<tempfile::TempDir, VerilogError> {
        let folder = process::folder()?;
        for (name, text) in [(VERILOG_SOURCE, listing.text.as_str()), (POWER, POWER_TEXT)] {
            let written = fs::write(folder.path().join(name), text);
            written.map_err(|error| VerilogError::NoFolder(io_words(&error)))?;
        }
        match process::run(folder.path(), &["yosys", "-q", "-p", &script(modules)], Limits::default(), self.cancel)? {
            Ok(()) => Ok(folder),
            Err(said) => Err(rejected(&said, listing)),
        }
    }
}

/// The script, with the names above.
fn script(modules: &str) -> String {
    format!(
        "read_verilog -sv source.v; write_rtlil written.il; {modules}; proc; flatten; \
         write_rtlil flat.il; tee -q -o undriven.txt check; chformal -remove; opt_expr; techmap -map power.v; \
         opt; memory; opt; techmap; \
         dfflegalize -cell $_DFF_P_ 01 -cell $_DFF_N_ 01 -cell $_DLATCH_P_ 01 -cell $_DLATCH_N_ 01 \
         -cell $_DFF_?P0_ r -cell $_DFF_?P1_ r -cell $_DLATCH_?P0_ r -cell $_DLATCH_?P1_ r \
         -cell $_DFFSR_?PP_ 0 -cell $_DLATCHSR_?PP_ 0; simplemap; \
         setundef -undriven -zero; opt_clean; setattr -unset src; write_blif -attr flat.blif"
    )
}

/// Whether a name can be part of the script.
fn is_plain(name: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.chars().all(is_letter) && name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

fn result(folder: &tempfile::TempDir, name: &str) -> Result<String, VerilogError> {
    disk::read_text(&folder.path().join(name), disk::MAX_CIRCUIT_BYTES).map_err(|_| VerilogError::NoResult)
}

/// The result for some modules, if all their cells are gates and registers.
fn translated(
    folder: &tempfile::TempDir,
    tops: Vec<String>,
    blif: String,
    listing: VerilogListing,
) -> Result<VerilogModules, VerilogError> {
    let flat = result(folder, FLAT)?;
    let RtlilLines { nets, ascending, cells } = RtlilLines::of(&flat, &tops);
    let place = |line: Option<usize>| listing.place(line?);
    let models: BTreeSet<&str> = blif.lines().filter_map(|line| line.strip_prefix(".model ")).collect();
    let mut kinds = blif.lines().filter_map(|line| line.strip_prefix(".subckt ")?.split(' ').next());
    if let Some(kind) = kinds.find(|kind| kind.starts_with('$') && !models.contains(kind) && !is_register_cell(kind)) {
        // Of several, the one that is left is not known.
        let line = cells.get(kind).filter(|lines| lines.len() == 1).and_then(|lines| lines.first().copied());
        let place = place(line);
        return Err(match kind {
            "$pow" => VerilogError::WideExponent { place },
            _ => VerilogError::NotLogic { cell: kind.to_owned(), place },
        });
    }
    let of_top = |(module, net): (String, String)| {
        let line = nets.get(&(module.clone(), net.clone())).copied();
        tops.contains(&module).then(|| VerilogName { name: net, place: place(line) })
    };
    let undriven = undriven(&result(folder, UNDRIVEN)?).into_iter().filter_map(of_top).collect();
    Ok(VerilogModules {
        undriven,
        blif,
        tops,
        nets,
        ascending,
        left_out: listing.left_out,
        lines: listing.lines,
        simulated: BTreeMap::new(),
    })
}

/// The error message of Yosys, with its place in the user's file.
fn rejected(said: &str, listing: &VerilogListing) -> VerilogError {
    let said = said.lines().find(|line| line.contains("ERROR")).unwrap_or("no reason given").trim();
    let parameter = said.split_once("Can't find object for defparam `").and_then(|(_, name)| name.split('`').next());
    if let Some(parameter) = parameter {
        let known = listing.parameters.clone();
        return VerilogError::NoParameter { parameter: parameter.to_owned(), known };
    }
    match place(said) {
        Some((line, reason)) => VerilogError::Rejected { reason: reason.to_owned(), place: listing.place(line) },
        None => VerilogError::Rejected { reason: said.trim_start_matches("ERROR: ").to_owned(), place: None },
    }
}

/// The line of the source and the reason of a message such as `source.v:3: ERROR: syntax error`.
fn place(said: &str) -> Option<(usize, &str)> {
    let (place, reason) = said.strip_prefix(VERILOG_SOURCE)?.split_once(": ")?;
    Some((verilog_line(place)?, reason.trim_start_matches("ERROR: ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nbc_base::source::VerilogPlace;

    fn listing(text: &str) -> VerilogListing {
        VerilogListing::of("my file.v", text, None, &|_| Err(FileError::NotFound)).unwrap()
    }

    #[test]
    fn the_scripts_have_the_names_of_the_folder_and_no_others() {
        for name in [VERILOG_SOURCE, POWER, WRITTEN, FLAT, UNDRIVEN, BLIF] {
            assert!([TOP, ALL].iter().all(|modules| script(modules).contains(name)));
        }
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
    fn names_of_the_script_are_plain() {
        assert!(is_plain("top_1") && is_plain("_a"));
        for name in ["", "1", "a;b", "a b", "a\n", "-x", "a$b", "\\a"] {
            assert!(!is_plain(name), "{name}");
        }
    }
}
