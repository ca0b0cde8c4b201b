//! Modules of Verilog, in the BLIF that their translator wrote.

use crate::formats::blif;
use crate::formats::design::Design;
use nbc_base::diag::Diagnostic;
use nbc_base::source::{FileId, SourceFile, VerilogModule};

/// Reads a translated module of Verilog files.
pub fn verilog_module(
    module: &VerilogModule,
    files: &[&SourceFile],
    clock: Option<&str>,
) -> Result<Design, Vec<Diagnostic>> {
    let design = verilog_design(module, files[0].id, clock);
    design.map_err(|faults| faults.into_iter().map(|fault| fault.moved_to_verilog(files, module)).collect())
}

/// The same with the errors at places of the translation, which is the text of `file`.
pub fn verilog_design(module: &VerilogModule, file: FileId, clock: Option<&str>) -> Result<Design, Vec<Diagnostic>> {
    let design = blif::read_model(&module.blif, file, clock, Some(&module.name))?;
    Ok(Design { ascending: module.ascending.clone(), ..design })
}
