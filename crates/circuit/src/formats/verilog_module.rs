//! Modules of Verilog, in the BLIF that their translator wrote.

use crate::formats::blif;
use crate::formats::design::Design;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, SourceFile, VerilogModules};

/// Reads a translated module of Verilog files.
///
/// # Errors
/// The errors of the translation, at the lines of the Verilog file.
pub fn verilog_module(
    modules: &VerilogModules,
    module: &str,
    files: &[&SourceFile],
    clock: Option<&str>,
) -> Result<Design, Vec<Diagnostic>> {
    let moved = |fault: Diagnostic| {
        let at = fault.labels.first().map(|label| label.span.start as usize);
        let place = at.and_then(|at| modules.place(module, at));
        fault.of_verilog(files, place)
    };
    let design = verilog_design(modules, module, files[0].id, clock);
    design.map_err(|faults| faults.into_iter().map(moved).collect())
}

/// The same with the errors at places of the translation, which is the text of `file`.
///
/// # Errors
/// As [`verilog_module`].
pub fn verilog_design(
    modules: &VerilogModules,
    module: &str,
    file: FileId,
    clock: Option<&str>,
) -> Result<Design, Vec<Diagnostic>> {
    let design = blif::read_model(&modules.blif, file, clock, Some(module))?;
    let ascending = modules.ascending.iter().filter(|(of, _)| of == module).map(|(_, net)| net.clone()).collect();
    Ok(Design { ascending, ..design })
}
