//! Circuit files, read and written in the format of their extension.

use std::path::Path;

use crate::store::verilog::{TopModule, Verilog};
use crate::store::wording::StoreError;
use crate::store::{DiskWorld, disk};
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::source::{FileError, FileId, Sources, VerilogModules};
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::{CircuitFormat, CircuitSource, Design, aiger, bench, blif, verilog_module};
use nbc_lang::syntax;

/// A circuit file to be read.
#[derive(Clone, Copy, Debug)]
pub struct CircuitFile<'a> {
    /// Its path.
    pub path: &'a Path,
    /// The clock of registers for which the file names none.
    pub clock: Option<&'a str>,
    /// The module or model to read.
    pub top: &'a TopModule,
}

/// Reads a circuit, with warnings about it.
///
/// # Errors
/// A file that cannot be read, of an unknown format, or damaged; or a module that it does not have.
pub fn read_circuit(from: &CircuitFile<'_>) -> Result<(Design, Diagnostics), Diagnostics> {
    let &CircuitFile { path, clock, top } = from;
    let name = path.display().to_string();
    let format = CircuitSource::of_path(&name);
    let has_modules = matches!(format, Some(CircuitSource::Verilog | CircuitSource::Blif));
    if format.is_some() && top.name.is_some() && !has_modules {
        return Err(Diagnostic::from(StoreError::NoModules { file: name }).into());
    }
    if format.is_some() && !top.parameters.is_empty() && format != Some(CircuitSource::Verilog) {
        return Err(Diagnostic::from(StoreError::NoParameters { file: name }).into());
    }
    let design = match format {
        Some(CircuitSource::Aiger) => {
            let bytes = disk::read(path, disk::MAX_CIRCUIT_BYTES).map_err(|error| unreadable(path, &error))?;
            aiger::read(&bytes, clock)?
        }
        Some(CircuitSource::Bench) => parse(name, text(path)?, |text, file| bench::read(text, file, clock))?,
        Some(CircuitSource::Blif) => {
            let model = top.name.as_deref();
            parse(name, text(path)?, |text, file| blif::read_model(text, file, clock, model))?
        }
        Some(CircuitSource::Verilog) => return verilog(name, text(path)?, from),
        None => return Err(Diagnostic::from(StoreError::CircuitFormat { file: name }).into()),
    };
    Ok((design, Diagnostics::default()))
}

/// The top module of a Verilog text.
fn verilog(name: String, text: String, from: &CircuitFile<'_>) -> Result<(Design, Diagnostics), Diagnostics> {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let (source, cancel) = (sources.file(file), &CancelFlag::default());
    let modules = Verilog { world: &DiskWorld, path: &source.name, text: &source.text, cancel }.top(from.top);
    let read = modules.map_err(|error| vec![Diagnostic::untranslated(source, &error)]).and_then(|modules| {
        let VerilogModules { undriven, left_out, .. } = &modules;
        let left_out = left_out.iter().map(|module| Diagnostic::left_out(source, module));
        let warnings = left_out.chain(undriven.iter().map(|wire| Diagnostic::undriven_wire(source, wire))).collect();
        Ok((verilog_module(&modules, &modules.tops[0], source, from.clock)?, warnings))
    });
    match read {
        Ok((design, list)) => Ok((design, Diagnostics { list, sources })),
        Err(list) => Err(Diagnostics { list, sources }),
    }
}

/// A design as the bytes of a file; a program of the language is written as the formatter writes it.
///
/// # Errors
/// The reason why the format cannot express the design.
pub fn encode_circuit(design: &Design, format: CircuitFormat) -> Result<Vec<u8>, Diagnostic> {
    let bytes = format.encode(design)?;
    if format != CircuitFormat::Nb {
        return Ok(bytes);
    }
    Ok(canonical(String::from_utf8(bytes).expect("a program is text"))?.into_bytes())
}

/// A program of ours as the formatter writes it, unless it is too large to be read again.
fn canonical(text: String) -> Result<String, Diagnostic> {
    if text.len() as u64 > syntax::MAX_SOURCE_BYTES {
        return Err(StoreError::NbTooLarge { bytes: text.len(), most: syntax::MAX_SOURCE_BYTES }.into());
    }
    let mut sources = Sources::default();
    let file = sources.add("the circuit as a .nb file", text);
    let parsed = syntax::parse(&sources, file);
    assert!(parsed.errors.is_empty(), "a program that was written can be parsed: {:?}", parsed.errors.first());
    Ok(syntax::format(&sources, file, &parsed.tree))
}

fn unreadable(path: &Path, error: &FileError) -> Diagnostics {
    Diagnostic::unreadable(&path.display().to_string(), error).into()
}

fn text(path: &Path) -> Result<String, Diagnostics> {
    disk::read_text(path, disk::MAX_CIRCUIT_BYTES).map_err(|error| unreadable(path, &error))
}

/// Reads a text under a name for messages.
fn parse(
    name: String,
    text: String,
    read: impl FnOnce(&str, FileId) -> Result<Design, Vec<Diagnostic>>,
) -> Result<Design, Diagnostics> {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let read = read(&sources.file(file).text, file);
    read.map_err(|diagnostics| Diagnostics { list: diagnostics, sources })
}
